#include "measured/checks/data_check_hum_line.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kLineTurn_rad = 2.0 * std::numbers::pi;
constexpr Index kFewestBandSide = 8;
constexpr double kGridLines = 0.5;
constexpr int kTransientDegree = 2;
constexpr double kCandidateScore = 4.0;
constexpr double kMostChange = 0.25;
constexpr double kChangeErrors = 3.0;
constexpr int kRefinements = 4;
constexpr double kWholeCycles = 1e-13;  // sine of a turn: whole cycles but for rounding

}  // namespace

HumBand::HumBand(std::size_t samples, double period_s, double centre_Hz)
    : samples_(static_cast<Index>(samples)), period_s_(period_s), centre_Hz_(centre_Hz) {
  const double room = std::min(centre_Hz, 0.5 / period_s - centre_Hz) * duration_s() - 2.0;
  side_ = std::min(kBandSide, static_cast<Index>(std::max(0.0, room)));
  if (!is_usable()) return;
  const auto count = static_cast<double>(samples_);
  const Eigen::ArrayXd at = Eigen::ArrayXd::LinSpaced(samples_, 0.0, count - 1.0);
  const Eigen::ArrayXd window = 0.5 - 0.5 * (kLineTurn_rad * (at + 0.5) / count).cos();
  exponentials_.resize(lines(), samples_);
  for (Index k = 0; k < samples_; ++k) {
    const double lowest = lowest_line() / count;
    Complex turn = std::polar(window[k], -kLineTurn_rad * lowest * at[k]);
    const Complex next = std::polar(1.0, -kLineTurn_rad * at[k] / count);
    for (Index line = 0; line < lines(); ++line) {
      exponentials_(line, k) = turn;
      turn *= next;
    }
  }
}

bool HumBand::is_usable() const {
  return side_ >= kFewestBandSide;
}

Complex HumBand::windowed_wave(double frequency_Hz, Index line) const {
  const auto count = static_cast<double>(samples_);
  const double cycles =
      frequency_Hz * period_s_ * count - lowest_line() - static_cast<double>(line);
  // The sum of exp(i 2 pi c k/n) over k from 0 to n - 1.
  const auto sum = [count](double c) {
    const double half = 0.5 * kLineTurn_rad * c;
    const double step = std::sin(half / count);
    const double size = std::abs(step) < kWholeCycles ? count : std::sin(half) / step;
    return std::polar(1.0, half * (count - 1.0) / count) * size;
  };
  const Complex half_sample = std::polar(1.0, 0.5 * kLineTurn_rad / count);
  return 0.5 * (0.5 * sum(cycles) - 0.25 * (half_sample * sum(cycles + 1.0) +
                                            std::conj(half_sample) * sum(cycles - 1.0)));
}

BandLines HumBand::of_wave(double frequency_Hz, int most) const {
  if (most == 0) {
    BandLines wave(lines(), 1);
    for (Index line = 0; line < lines(); ++line) wave(line, 0) = windowed_wave(frequency_Hz, line);
    return wave;
  }
  BandLines waves(samples_, most + 1);
  for (Index k = 0; k < samples_; ++k) {
    const double t = 2.0 * (static_cast<double>(k) + 0.5) / static_cast<double>(samples_) - 1.0;
    Complex wave =
        std::polar(0.5, kLineTurn_rad * frequency_Hz * period_s_ * static_cast<double>(k));
    for (int power = 0; power <= most; ++power) {
      waves(k, power) = wave;
      wave *= t;
    }
  }
  return exponentials_ * waves;
}

void HumBand::add_polynomial(int degree, const Eigen::VectorXcd& factor, BandLines& columns) const {
  const Eigen::ArrayXcd at = Eigen::ArrayXd::LinSpaced(lines(), -1.0, 1.0).cast<Complex>();
  Eigen::ArrayXcd column = factor.array();
  for (int power = 0; power <= degree; ++power) {
    columns.conservativeResize(lines(), columns.cols() + 1);
    columns.col(columns.cols() - 1) = column;
    column *= at;
  }
}

BandLines HumBand::transient() const {
  BandLines columns(lines(), 0);
  add_polynomial(kTransientDegree, Eigen::VectorXcd::Ones(lines()), columns);
  return columns;
}

bool HumLine::is_constant() const {
  const double most = kMostChange * std::abs(amplitude) + kChangeErrors * change_error;
  return std::abs((slope / amplitude).real()) * std::abs(amplitude) <= most &&
         std::abs(bend) <= most;
}

HumLine fit_line(const Eigen::VectorXcd& target, const BandLines& others, const BandLines& wave,
                 double frequency_Hz) {
  BandLines columns(target.size(), others.cols() + wave.cols());
  columns << wave, others;
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseMax(1e-300);
  for (Index j = 0; j < columns.cols(); ++j) columns.col(j) /= scale[j];
  const Eigen::ColPivHouseholderQR<BandLines> factors(columns);
  const Eigen::VectorXcd shares = factors.solve(target);
  const auto freedom = static_cast<double>(target.size() - columns.cols());
  const double variance = (target - columns * shares).squaredNorm() / freedom;
  // The covariance is P R^-1 R^-H P^T: A^H A would lose half the digits where a signal is nearly a
  // line by itself.
  const auto triangle = factors.matrixR().topRows(columns.cols()).triangularView<Eigen::Upper>();
  const BandLines identity = BandLines::Identity(columns.cols(), columns.cols());
  const BandLines inverse = factors.colsPermutation() * BandLines(triangle.solve(identity));
  const auto error = [&](Index j) {
    return std::sqrt(variance) * inverse.row(j).norm() / scale[j];
  };
  HumLine line{frequency_Hz, shares[0] / scale[0], error(0), {}, {}, 0.0, {}};
  if (wave.cols() == 3) {
    line.slope = shares[1] / scale[1];
    line.bend = shares[2] / scale[2];
    line.change_error = std::max(error(1), error(2));
  }
  const Index gain = wave.cols() + kTransientDegree + 1;
  if (gain < columns.cols()) line.gain = shares[gain] / scale[gain];
  return line;
}

HumGrid hum_grid(const HumBand& band) {
  HumGrid grid;
  grid.reach_Hz = std::max(kMainsTolerance_Hz, kGridLines / band.duration_s());
  const auto steps = static_cast<int>(std::ceil(grid.reach_Hz * band.duration_s() / kGridLines));
  for (int i = -steps; i <= steps; ++i) {
    grid.frequencies_Hz.push_back(band.centre_Hz() + grid.reach_Hz * i / steps);
    grid.waves.push_back(band.of_wave(grid.frequencies_Hz.back(), 0));
  }
  return grid;
}

std::optional<HumLine> strongest_line(const HumBand& band, const HumGrid& grid,
                                      const Eigen::VectorXcd& target, const BandLines& others) {
  HumLine best;
  for (std::size_t i = 0; i < grid.waves.size(); ++i) {
    const HumLine line = fit_line(target, others, grid.waves[i], grid.frequencies_Hz[i]);
    if (line.score() > best.score()) best = line;
  }
  if (best.score() < kCandidateScore) return std::nullopt;
  double frequency_Hz = best.frequency_Hz;
  for (int i = 0; i < kRefinements; ++i) {
    best = fit_line(target, others, band.of_wave(frequency_Hz, 2), frequency_Hz);
    // A phase that grows with t from -1 to 1 is a frequency.
    const double turn = (best.slope / best.amplitude).imag();
    frequency_Hz += std::clamp(turn, -1.0, 1.0) / (std::numbers::pi * band.duration_s());
  }
  return best;
}

}  // namespace flexarm::measured
