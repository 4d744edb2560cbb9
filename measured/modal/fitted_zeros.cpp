#include "measured/modal/fitted_zeros.hpp"

#include "measured/modal/propagated_error.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXd;
using Kind = SensorColumn::Kind;

/// Eigenvalues beyond this many times the highest pole are what rounding makes of infinite ones.
constexpr double kInfinite = 1e4;
/// Below this share of the highest pole a zero is at 0.
constexpr double kOrigin = 1e-9;
constexpr int kZeroSteps = 6;
/// Imaginary parts below this share of |s| are rounding of a real zero.
constexpr double kReal = 1e-9;
/// Points around a disc; |G| changes little between them, with no other zero and no pole near.
constexpr int kOnCircle = 16;
/// Standard errors of G that a disc withstands.
constexpr double kSure = 2.0;

struct Pencil {
  MatrixXd a;  ///< [A B; C D]
  MatrixXd e;  ///< [E 0; 0 0]
};

/// In units of `omega`: s = omega s'.
Pencil pencil_of(const FittedTransfer& transfer, double omega) {
  const BlockSet& set = transfer.blocks();
  const int lowest = transfer.zeros_at_origin();
  const int remainder_power = transfer.remainder_power() - lowest;
  // Coefficient of s'^k over each block, and of the remainder.
  MatrixXd c = MatrixXd::Zero(static_cast<Index>(set.blocks.size()), 2);
  double d = 0.0;
  for (Index i = 0; i < transfer.beta().size(); ++i) {
    const SensorColumn& column = transfer.model().columns[static_cast<std::size_t>(i)];
    if (column.kind == Kind::remainder) {
      d = transfer.beta()(i) * std::pow(omega, remainder_power);
    } else {
      const int power = column.power - lowest;
      c(static_cast<Index>(column.block), power) = transfer.beta()(i) * std::pow(omega, power - 2);
    }
  }
  const double size = std::max(c.cwiseAbs().maxCoeff(), std::abs(d));
  if (size > 0.0) {
    c /= size;
    d /= size;
  }
  const Index most = 2 * static_cast<Index>(set.blocks.size()) + 3;
  Pencil pencil{MatrixXd::Zero(most, most), MatrixXd::Zero(most, most)};
  std::vector<std::pair<Index, double>> to_input;  // rows that the torque enters
  std::vector<std::pair<Index, double>> to_output;
  Index n = 0;
  for (std::size_t m = 0; m < set.blocks.size(); ++m) {
    const double a1 = set.blocks[m].a1_rad_per_s / omega;
    const double a0 = set.blocks[m].a0_rad2_per_s2 / (omega * omega);
    const double c0 = c(static_cast<Index>(m), 0);
    const double c1 = c(static_cast<Index>(m), 1);
    if (set.is_rigid(m) && c0 == 0.0) {
      // s over s (s + a1): the pole at 0 is not there.
      if (c1 == 0.0) continue;
      pencil.a(n, n) = -a1;
      pencil.e(n, n) = 1.0;
      to_input.emplace_back(n, 1.0);
      to_output.emplace_back(n, c1);
      ++n;
      continue;
    }
    pencil.a(n, n + 1) = 1.0;
    pencil.a(n + 1, n) = -a0;
    pencil.a(n + 1, n + 1) = -a1;
    pencil.e(n, n) = pencil.e(n + 1, n + 1) = 1.0;
    to_input.emplace_back(n + 1, 1.0);
    to_output.emplace_back(n, c0);
    to_output.emplace_back(n + 1, c1);
    n += 2;
  }
  double direct = d;
  if (remainder_power == 1 && d != 0.0) {
    // d s u: w1' = w2, 0 = u - w1.
    pencil.e(n, n) = 1.0;
    pencil.a(n, n + 1) = 1.0;
    pencil.a(n + 1, n) = -1.0;
    to_input.emplace_back(n + 1, 1.0);
    to_output.emplace_back(n + 1, d);
    direct = 0.0;
    n += 2;
  }
  for (const auto& [row, value] : to_input) pencil.a(row, n) = value;
  for (const auto& [column, value] : to_output) pencil.a(n, column) = value;
  pencil.a(n, n) = direct;
  pencil.a.conservativeResize(n + 1, n + 1);
  pencil.e.conservativeResize(n + 1, n + 1);
  return pencil;
}

double highest_pole(const BlockSet& set) {
  double highest = 0.0;
  for (const SecondOrderBlock& block : set.blocks) {
    for (const Complex s : block.poles_rad_per_s()) highest = std::max(highest, std::abs(s));
  }
  return highest > 0.0 ? highest : 1.0;
}

/// Newton's method on G(s); stays on the real axis where it begins there.
Complex polished(const FittedTransfer& transfer, Complex s) {
  for (int i = 0; i < kZeroSteps; ++i) {
    const Complex step = transfer.value(s) / transfer.s_derivative(s);
    if (!std::isfinite(std::abs(step)) || std::abs(step) > 0.1 * std::abs(s)) break;
    s -= step;
  }
  return s;
}

FittedZero zero_at(Complex s, const FittedTransfer& transfer, const MatrixXd& covariance) {
  const double size = std::abs(s);
  FittedZero zero{.s_rad_per_s = s,
                  .frequency_Hz = size / (2.0 * std::numbers::pi),
                  .damping_ratio = -s.real() / size};
  const Eigen::RowVectorXcd ds = -transfer.gradient(s) / transfer.s_derivative(s);
  const Eigen::RowVectorXd d_size = (std::conj(s) * ds).real() / size;
  const Eigen::RowVectorXd d_damping = -ds.real() / size + s.real() / (size * size) * d_size;
  zero.frequency_std_Hz = propagated_error(d_size, covariance) / (2.0 * std::numbers::pi);
  // A real zero stays real: its damping ratio is 1 or -1.
  if (s.imag() != 0.0) zero.damping_ratio_std = propagated_error(d_damping, covariance);
  return zero;
}

/// From the nearest pole and the nearest other zero, its own conjugate included.
double distance_to_others(std::size_t at, const std::vector<FittedZero>& zeros,
                          const BlockSet& set) {
  const Complex s = zeros[at].s_rad_per_s;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < set.free_blocks(); ++m) {
    for (const Complex pole : set.blocks[m].poles_rad_per_s()) {
      distance = std::min(distance, std::abs(s - pole));
    }
  }
  for (std::size_t k = 0; k < zeros.size(); ++k) {
    const Complex other = zeros[k].s_rad_per_s;
    if (k != at) distance = std::min(distance, std::abs(s - other));
    if (other.imag() != 0.0) distance = std::min(distance, std::abs(s - std::conj(other)));
  }
  return distance;
}

/// Rouche's theorem: where an error of G is smaller than |G| all around a disc, the disc holds as
/// many zeros of the one as of the other.
bool is_held_by_disc(Complex middle, double radius, const FittedTransfer& transfer,
                     const MatrixXd& covariance) {
  for (int i = 0; i < kOnCircle; ++i) {
    const Complex s = middle + std::polar(radius, 2.0 * std::numbers::pi * i / kOnCircle);
    const Eigen::RowVectorXcd gradient = transfer.gradient(s);
    const double error = std::hypot(propagated_error(gradient.real(), covariance),
                                    propagated_error(gradient.imag(), covariance));
    if (!(kSure * error < std::abs(transfer.value(s)))) return false;
  }
  return true;
}

}  // namespace

std::vector<FittedZero> fitted_zeros(const FittedTransfer& transfer, const MatrixXd& covariance,
                                     double from_Hz, double to_Hz) {
  if (transfer.blocks().blocks.empty() || transfer.beta().isZero(0.0)) return {};
  const double highest = highest_pole(transfer.blocks());
  const Pencil pencil = pencil_of(transfer, highest);
  Eigen::GeneralizedEigenSolver<MatrixXd> solver(pencil.a, pencil.e, false);
  std::vector<FittedZero> zeros;
  for (Index i = 0; i < pencil.a.rows(); ++i) {
    const double beta = solver.betas()(i);
    const Complex alpha = solver.alphas()(i);
    if (std::abs(alpha) >= kInfinite * std::abs(beta)) continue;
    Complex s = alpha / beta * highest;
    if (std::abs(s) <= kOrigin * highest) continue;
    if (std::abs(s.imag()) <= kReal * std::abs(s)) s = s.real();
    if (s.imag() < 0.0) continue;
    zeros.push_back(zero_at(polished(transfer, s), transfer, covariance));
    FittedZero& zero = zeros.back();
    zero.in_band = zero.frequency_Hz >= from_Hz && zero.frequency_Hz <= to_Hz;
  }
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const double radius = kTold * distance_to_others(i, zeros, transfer.blocks());
    zeros[i].is_told = is_held_by_disc(zeros[i].s_rad_per_s, radius, transfer, covariance);
  }
  std::ranges::sort(zeros, {}, &FittedZero::frequency_Hz);
  return zeros;
}

}  // namespace flexarm::measured
