#include "measured/checks/data_check_hum.hpp"

#include "measured/checks/data_check_transform.hpp"
#include "measured/checks/data_check_values.hpp"
#include "measured/spectra/robust.hpp"

#include <Eigen/Core>
#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using BandLines = Eigen::MatrixXcd;  // a row a line of the band

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kMains_Hz[] = {50.0, 60.0};
constexpr double kMainsTolerance_Hz = 0.1;
constexpr Index kBandSide = 12;  // lines on either side
constexpr Index kFewestBandSide = 8;
constexpr double kGridLines = 0.5;  // by which frequencies are tried
constexpr int kGainDegree = 3;
constexpr int kTransientDegree = 2;
constexpr double kLeastHumScore = 8.0;
constexpr double kCandidateScore = 4.0;
constexpr double kLeastAmplitude = 0.03;  // standard deviations
constexpr double kLeastBesideSteps = 0.12;
constexpr double kLeastAlone = 0.15;  // of the only channel, beside pulses
constexpr double kMostChange = 0.25;  // of the amplitude, over half the record
constexpr double kChangeErrors = 3.0;
constexpr int kRefinements = 4;
constexpr double kNoTorque = 1e-9;  // of its power, in a line
/// BandLines of a torque that stand out as much as its hum does; it is made of lines then.
constexpr double kOtherLine = 0.3;

/// The lines about a frequency, and what makes them.
class HumBand {
 public:
  HumBand(std::size_t samples, double period_s, double centre_Hz)
      : samples_(static_cast<Index>(samples)), period_s_(period_s), centre_Hz_(centre_Hz) {
    const double duration_s = static_cast<double>(samples) * period_s;
    const double room = std::min(centre_Hz, 0.5 / period_s - centre_Hz) * duration_s - 2.0;
    side_ = std::min(kBandSide, static_cast<Index>(std::max(0.0, room)));
    if (!is_usable()) return;
    const Eigen::ArrayXd at =
        Eigen::ArrayXd::LinSpaced(samples_, 0.0, static_cast<double>(samples_ - 1));
    const Eigen::ArrayXd window =
        0.5 - 0.5 * (kTurn_rad * (at + 0.5) / static_cast<double>(samples_)).cos();
    exponentials_.resize(2 * side_ + 1, samples_);
    for (Index k = 0; k < samples_; ++k) {
      const auto time = static_cast<double>(k);
      Complex turn = std::polar(window[k], -kTurn_rad * (centre_Hz * period_s * time -
                                                         static_cast<double>(side_) * time /
                                                             static_cast<double>(samples_)));
      const Complex next = std::polar(1.0, -kTurn_rad * time / static_cast<double>(samples_));
      for (Index line = 0; line < exponentials_.rows(); ++line) {
        exponentials_(line, k) = turn;
        turn *= next;
      }
    }
  }

  bool is_usable() const { return side_ >= kFewestBandSide; }
  Index lines() const { return 2 * side_ + 1; }
  double centre_Hz() const { return centre_Hz_; }
  double duration_s() const { return static_cast<double>(samples_) * period_s_; }

  BandLines of(const Eigen::MatrixXd& values) const { return exponentials_ * values; }

  /// BandLines of half of t^p exp(i 2 pi f t), p = 0 to `most`, with t from -1 to 1 over the
  /// record.
  BandLines of_wave(double frequency_Hz, int most) const {
    BandLines waves(samples_, most + 1);
    for (Index k = 0; k < samples_; ++k) {
      const double t = 2.0 * (static_cast<double>(k) + 0.5) / static_cast<double>(samples_) - 1.0;
      Complex wave = std::polar(0.5, kTurn_rad * frequency_Hz * period_s_ * static_cast<double>(k));
      for (int power = 0; power <= most; ++power) {
        waves(k, power) = wave;
        wave *= t;
      }
    }
    return exponentials_ * waves;
  }

  /// Columns of a polynomial in the line times `factor`.
  void add_polynomial(int degree, const Eigen::VectorXcd& factor, BandLines& columns) const {
    const Eigen::ArrayXcd at = Eigen::ArrayXd::LinSpaced(lines(), -1.0, 1.0).cast<Complex>();
    Eigen::ArrayXcd column = factor.array();
    for (int power = 0; power <= degree; ++power) {
      columns.conservativeResize(lines(), columns.cols() + 1);
      columns.col(columns.cols() - 1) = column;
      column *= at;
    }
  }

 private:
  Index samples_;
  double period_s_;
  double centre_Hz_;
  Index side_ = 0;
  BandLines exponentials_;
};

/// A line in a signal.
struct HumLine {
  double frequency_Hz = 0.0;
  Complex amplitude;
  double error = 0.0;  ///< standard error of the amplitude
  Complex slope;       ///< of the amplitude, over half the record
  Complex bend;
  double change_error = 0.0;

  double score() const { return error > 0.0 ? std::abs(amplitude) / error : 0.0; }
  bool is_constant() const {
    const double most = kMostChange * std::abs(amplitude) + kChangeErrors * change_error;
    return std::abs((slope / amplitude).real()) * std::abs(amplitude) <= most &&
           std::abs(bend) <= most;
  }
};

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
  const BandLines gram = columns.adjoint() * columns;
  const BandLines inverse = gram.completeOrthogonalDecomposition().pseudoInverse();
  const auto error = [&](Index j) {
    return std::sqrt(variance * std::abs(inverse(j, j))) / scale[j];
  };
  HumLine line{frequency_Hz, shares[0] / scale[0], error(0), {}, {}, 0.0};
  if (wave.cols() == 3) {
    line.slope = shares[1] / scale[1];
    line.bend = shares[2] / scale[2];
    line.change_error = std::max(error(1), error(2));
  }
  return line;
}

/// What a mains frequency looks like at this sampling.
double alias_Hz(double frequency_Hz, double period_s) {
  const double rate_Hz = 1.0 / period_s;
  return std::abs(frequency_Hz - rate_Hz * std::round(frequency_Hz / rate_Hz));
}

/// The line of most evidence near the band's centre; its amplitude may change over the record.
std::optional<HumLine> strongest_line(const HumBand& band, const Eigen::VectorXcd& target,
                                      const BandLines& others, const std::vector<double>& grid_Hz,
                                      const std::vector<BandLines>& waves) {
  HumLine best;
  for (std::size_t i = 0; i < grid_Hz.size(); ++i) {
    const HumLine line = fit_line(target, others, waves[i], grid_Hz[i]);
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

/// Whether the torque is made of lines: another one, away from the mains, stands out of the twelve
/// lines on either side and is of 0.3 of this amplitude or more.
bool is_of_lines(const CheckedSignal& torque, double amplitude, double period_s) {
  constexpr double kStandsOut = 8.0;
  constexpr Index kPeak = 2;  // lines of the window's lobe
  const auto samples = static_cast<Index>(torque.values.size());
  const Transforms transforms = transform(std::span(&torque, 1), period_s, false);
  const auto& spectrum = transforms.of[0].plain;
  const auto width = static_cast<std::size_t>(
      std::ceil(static_cast<double>(kBandSide) * transforms.bins_per_line));
  const auto lobe =
      static_cast<std::size_t>(std::ceil(static_cast<double>(kPeak) * transforms.bins_per_line));
  const double full = 0.5 * amplitude * static_cast<double>(samples);
  for (std::size_t bin = width; bin + width < spectrum.size(); ++bin) {
    const double here = std::abs(spectrum[bin]);
    if (here < kOtherLine * full) continue;
    const double frequency_Hz = transforms.omega_rad_per_s(bin) / kTurn_rad;
    const bool is_mains = std::ranges::any_of(kMains_Hz, [&](double mains_Hz) {
      return std::abs(frequency_Hz - alias_Hz(mains_Hz, period_s)) <
             static_cast<double>(kPeak + 1) / transforms.duration_s + kMainsTolerance_Hz;
    });
    if (is_mains) continue;
    // A band's edge stands out on one side.
    std::vector<double> below;
    std::vector<double> above;
    for (std::size_t j = lobe + 1; j <= width; ++j) {
      below.push_back(std::abs(spectrum[bin - j]));
      above.push_back(std::abs(spectrum[bin + j]));
    }
    if (here > kStandsOut * std::max(median(std::move(below)), median(std::move(above))))
      return true;
  }
  return false;
}

DataFinding hum_finding(const CheckedSignal& signal, const HumLine& line, double mains_Hz,
                        double alias) {
  const double amplitude = std::abs(line.amplitude);
  const std::string_view unit = signal.sensor ? arm::unit(*signal.sensor) : "N m";
  const std::string shown =
      alias == mains_Hz ? "" : fmt::format(", which shows as {:.4g} Hz", line.frequency_Hz);
  return {Fault::hum,
          signal.name,
          0,
          0.0,
          amplitude,
          fmt::format("{} has hum of {:.0f} Hz{}: amplitude {:.3g} {} ({:.2g} of its standard "
                      "deviation)",
                      signal.name, mains_Hz, shown, amplitude, unit, amplitude / signal.deviation)};
}

/// Looks for one mains frequency in all signals.
class HumSearch {
 public:
  HumSearch(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
            double period_s, double mains_Hz)
      : signals_(signals),
        usable_(usable),
        period_s_(period_s),
        mains_Hz_(mains_Hz),
        has_pulses_(has_few_levels(signals[0].values)),
        band_(signals[0].values.size(), period_s, alias_Hz(mains_Hz, period_s)) {}

  void search(Hum& hum) {
    if (!band_.is_usable()) return;
    transform_all();
    const Eigen::VectorXcd torque = lines_.col(0);
    auto torque_line = candidate_of(0, torque);
    // Friction answers a torque with a line here by others.
    const bool is_given = torque_line && !may_hum(*torque_line);
    if (is_given && (!has_pulses_ || is_clear(*torque_line))) return;
    if (is_given) torque_line.reset();
    auto found = lines_of_channels(torque);
    if (torque_line) {
      const auto without = lines_of_channels(
          torque - torque_line->amplitude * band_.of_wave(torque_line->frequency_Hz, 0));
      bool is_answered = false;
      bool is_missed = false;
      bool is_other = false;
      for (std::size_t i = 1; i < found.size(); ++i) {
        is_answered |= without[i] && !found[i];
        is_missed |= found[i] && !without[i];
        is_other |= found[i] && without[i];
      }
      // Channels that the line explains answer it: the torque was given. Where they all miss it,
      // it need not stand out of the torque.
      const bool is_there = is_hum(0, *torque_line) || (is_missed && !is_other);
      if (is_there && !is_answered) {
        found = without;
        found[0] = torque_line;
      }
    }
    if (has_pulses_ && is_shared(found)) return;
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      if (!found[i]) continue;
      hum.findings.push_back(hum_finding(signals_[i], *found[i], mains_Hz_, band_.centre_Hz()));
      subtract(*found[i], hum.values[i]);
    }
  }

 private:
  void transform_all() {
    const auto samples = static_cast<Index>(signals_[0].values.size());
    Eigen::MatrixXd values(samples, std::ssize(signals_));
    for (std::size_t i = 0; i < signals_.size(); ++i) {
      const Eigen::Map<const Eigen::ArrayXd> column(signals_[i].values.data(), samples);
      values.col(static_cast<Index>(i)) = column - column.mean();
    }
    lines_ = band_.of(values);
    const double reach_Hz = std::max(kMainsTolerance_Hz, kGridLines / band_.duration_s());
    const auto steps = static_cast<int>(std::ceil(reach_Hz * band_.duration_s() / kGridLines));
    for (int i = -steps; i <= steps; ++i) {
      grid_Hz_.push_back(band_.centre_Hz() + reach_Hz * i / steps);
      waves_.push_back(band_.of_wave(grid_Hz_.back(), 0));
    }
  }

  /// A line of a signal beside a torque of these lines, which is none of its own.
  std::optional<HumLine> candidate_of(std::size_t signal, const Eigen::VectorXcd& torque) const {
    if (!usable_[signal] || signals_[signal].deviation == 0.0) return std::nullopt;
    BandLines others(band_.lines(), 0);
    band_.add_polynomial(kTransientDegree, Eigen::VectorXcd::Ones(band_.lines()), others);
    const double torque_power =
        signals_[0].deviation * static_cast<double>(signals_[0].values.size());
    if (signal != 0 && torque.cwiseAbs().maxCoeff() > kNoTorque * torque_power) {
      band_.add_polynomial(kGainDegree, torque, others);
    }
    return strongest_line(band_, lines_.col(static_cast<Index>(signal)), others, grid_Hz_, waves_);
  }

  std::vector<std::optional<HumLine>> lines_of_channels(const Eigen::VectorXcd& torque) const {
    std::vector<std::optional<HumLine>> found(signals_.size());
    for (std::size_t i = 1; i < signals_.size(); ++i) {
      found[i] = candidate_of(i, torque);
      if (found[i] && !is_hum(i, *found[i])) found[i].reset();
    }
    return found;
  }

  static bool is_clear(const HumLine& line) { return line.score() > kLeastHumScore; }

  bool is_hum(std::size_t signal, const HumLine& line) const {
    const double reach_Hz = std::max(kMainsTolerance_Hz, kGridLines / band_.duration_s());
    // Steps of a torque excite modes of the tip's acceleration beyond the smooth gain.
    const bool is_shaken = signals_[signal].is(arm::SensorKind::tip_acceleration) && has_pulses_;
    const double least = is_shaken ? kLeastBesideSteps : kLeastAmplitude;
    return is_clear(line) && std::abs(line.amplitude) > least * signals_[signal].deviation &&
           std::abs(line.frequency_Hz - band_.centre_Hz()) <= reach_Hz && line.is_constant();
  }

  /// Whether several channels have the line, or a small one in the only channel: pulses that repeat
  /// have lines, and what they excite is shared.
  bool is_shared(const std::vector<std::optional<HumLine>>& found) const {
    const auto lines = std::count_if(found.begin() + 1, found.end(),
                                     [](const auto& line) { return line.has_value(); });
    if (lines > 1) return true;
    if (std::count(usable_.begin() + 1, usable_.end(), true) > 1) return false;
    for (std::size_t i = 1; i < found.size(); ++i) {
      if (found[i] && std::abs(found[i]->amplitude) < kLeastAlone * signals_[i].deviation) {
        return true;
      }
    }
    return false;
  }

  bool may_hum(const HumLine& line) const {
    return !has_pulses_ && !is_of_lines(signals_[0], std::abs(line.amplitude), period_s_);
  }

  void subtract(const HumLine& line, std::vector<double>& values) const {
    for (std::size_t k = 0; k < values.size(); ++k) {
      const double phase = kTurn_rad * line.frequency_Hz * period_s_ * static_cast<double>(k);
      values[k] -= (line.amplitude * std::polar(1.0, phase)).real();
    }
  }

  std::span<const CheckedSignal> signals_;
  const std::vector<bool>& usable_;
  double period_s_;
  double mains_Hz_;
  bool has_pulses_;  ///< the torque is made of levels
  HumBand band_;
  BandLines lines_;
  std::vector<double> grid_Hz_;
  std::vector<BandLines> waves_;
};

}  // namespace

Hum check_hum(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
              double period_s) {
  Hum hum;
  for (const auto& signal : signals) {
    hum.values.emplace_back(signal.values.begin(), signal.values.end());
  }
  for (const double mains_Hz : kMains_Hz) {
    HumSearch(signals, usable, period_s, mains_Hz).search(hum);
  }
  return hum;
}

}  // namespace flexarm::measured
