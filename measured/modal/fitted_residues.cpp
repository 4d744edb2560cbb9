#include "measured/modal/fitted_residues.hpp"

#include "measured/modal/fitted_transfer.hpp"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

/// A delay explains a turn that it makes smaller by this factor.
constexpr double kExplained = 3.0;
/// Delays tried in a period of the highest pole.
constexpr double kTrialsInPeriod = 40.0;

double weight_of(const BlockFit& fit, std::size_t j, std::size_t block) {
  double weight = 0.0;
  for (Index i = 0; i < fit.models[j].shared; ++i) {
    const SensorColumn& column = fit.models[j].columns[static_cast<std::size_t>(i)];
    if (column.kind != SensorColumn::Kind::forced || column.block != block) continue;
    const double variance = fit.sensors[j].variance * fit.sensors[j].unit_inverse(i, i);
    const double beta = fit.sensors[j].beta(i);
    if (variance > 0.0) weight = std::max(weight, beta * beta / variance);
  }
  return weight;
}

struct Mode {
  Complex pole;
  std::vector<FittedResidue> residues;
};

double mean_turn_squared(const Mode& mode, double delay_s) {
  const Complex back = std::exp(mode.pole * delay_s);
  double squares = 0.0;
  double weights = 0.0;
  for (const FittedResidue& residue : mode.residues) {
    squares += residue.weight * turn_squared(residue.value * back, residue.hub);
    weights += residue.weight;
  }
  return weights > 0.0 ? squares / weights : 0.0;
}

double turn_of(const std::vector<Mode>& modes, double delay_s) {
  double sum = 0.0;
  for (const Mode& mode : modes) sum += mean_turn_squared(mode, delay_s);
  return std::sqrt(sum / static_cast<double>(modes.size()));
}

Mode mode_of(const BlockFit& fit, std::size_t block) {
  const Complex pole = fit.blocks.blocks[block].poles_rad_per_s()[0];
  if (pole.imag() <= 0.0) return {pole, {}};
  return {pole, fitted_residues(fit, block, pole)};
}

}  // namespace

std::vector<FittedResidue> fitted_residues(const BlockFit& fit, std::size_t block, Complex pole) {
  std::vector<FittedResidue> all;
  for (std::size_t j = 0; j < fit.models.size(); ++j) {
    const FittedTransfer transfer(fit.blocks, fit.models[j],
                                  fit.sensors[j].beta.head(fit.models[j].shared));
    const auto [b1, b0] = transfer.numerator(block);
    all.push_back({(b1 * pole + b0) / Complex(0.0, 2.0 * pole.imag()), weight_of(fit, j, block),
                   arm::derivative_order(fit.models[j].sensor),
                   arm::is_collocated(fit.models[j].sensor)});
  }
  return all;
}

double turn_squared(Complex residue, bool hub) {
  // b0 above 0: the residue b0/(2 i omega) has a negative imaginary part.
  if (hub && residue.imag() > 0.0) return 1.0;
  const double size = std::norm(residue);
  return size > 0.0 ? residue.real() * residue.real() / size : 0.0;
}

double residue_turn(const BlockFit& fit, std::size_t block, double delay_s) {
  return turn_of({mode_of(fit, block)}, delay_s);
}

double residue_delay_s(const BlockFit& fit, const std::vector<std::size_t>& blocks) {
  if (blocks.size() < 2) return 0.0;
  std::vector<Mode> modes;
  double highest_rad_per_s = 0.0;
  for (const std::size_t block : blocks) {
    modes.push_back(mode_of(fit, block));
    highest_rad_per_s = std::max(highest_rad_per_s, modes.back().pole.imag());
  }
  const double now = turn_of(modes, 0.0);
  if (now < kTurnOfDelay || highest_rad_per_s == 0.0) return 0.0;
  const double step_s = 2.0 * std::numbers::pi / highest_rad_per_s / kTrialsInPeriod;
  const double least = std::min(kTurnOfDelay, now / kExplained);
  for (double delay_s = step_s; delay_s <= kLongestDelay_s; delay_s += step_s) {
    const double here = turn_of(modes, delay_s);
    if (here > least || here > turn_of(modes, delay_s + step_s)) continue;
    constexpr int kHalfOfDigits = std::numeric_limits<double>::digits / 2;
    return boost::math::tools::brent_find_minima(
               [&](double trial_s) { return turn_of(modes, trial_s); }, delay_s - step_s,
               delay_s + step_s, kHalfOfDigits)
        .first;
  }
  return 0.0;
}

}  // namespace flexarm::measured
