#include "measured/alias_placement.hpp"

#include "measured/fitted_transfer.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;
using Eigen::Index;

constexpr double kPi = std::numbers::pi;
constexpr int kFarthestAlias = 2;
/// Poles this many turns apart are one; far above rounding.
constexpr double kWholeTurn = 1e-6;
/// A place is better when residues are closer to the imaginary axis by this factor, squared.
constexpr double kClearlyBetter = 4.0;

/// The alias between 0 and half the sampling frequency.
Complex folded(Complex pole, double period_s) {
  const double turn = 2.0 * kPi / period_s;
  return {pole.real(), std::abs(std::remainder(pole.imag(), turn))};
}

/// A sensor's residue at the pole, and the square of its signal-to-noise ratio.
struct Residue {
  Complex value;
  double weight = 0.0;
  int derivatives = 0;
  bool hub = false;
};

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

std::vector<Residue> residues(const BlockFit& fit, std::size_t block, Complex pole) {
  std::vector<Residue> all;
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

/// Weighted mean square of the sine of the residues' angles to the imaginary axis, at an alias of
/// the pole; 1 for a hub's residue of the wrong sign.
double misfit(const std::vector<Residue>& all, Complex pole, Complex alias, int exponent) {
  double sum = 0.0;
  double weights = 0.0;
  for (const Residue& residue : all) {
    Complex there = residue.value * std::pow(alias / pole, exponent - residue.derivatives);
    if (alias.imag() < 0.0) there = std::conj(there);
    const double sine = std::abs(there) > 0.0 ? there.real() / std::abs(there) : 0.0;
    // b0 above 0: the residue b0/(2 i omega) has a negative imaginary part.
    sum += residue.weight * (residue.hub && there.imag() > 0.0 ? 1.0 : sine * sine);
    weights += residue.weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace

double residue_turn(const BlockFit& fit, std::size_t block) {
  const Complex pole = fit.blocks.blocks[block].poles_rad_per_s()[0];
  return pole.imag() > 0.0 ? std::sqrt(misfit(residues(fit, block, pole), pole, pole, 0)) : 0.0;
}

std::vector<MovedBlock> place_aliases(const BlockFit& fit, double period_s, TorqueHold hold,
                                      BlockSet& blocks) {
  blocks = fit.blocks;
  std::vector<MovedBlock> moved;
  const int exponent = hold == TorqueHold::zero ? 1 : 2;
  for (std::size_t m = 0; m < blocks.blocks.size(); ++m) {
    if (blocks.is_rigid(m)) continue;
    const Complex pole = blocks.blocks[m].poles_rad_per_s()[0];
    if (pole.imag() <= 0.0) continue;
    const auto all = residues(fit, m, pole);
    const Complex lowest = folded(pole, period_s);
    // The residues' angles at an alias, which the pole or its conjugate differs from by turns.
    const auto misfit_at = [&](Complex alias) {
      const double turns = (alias.imag() - pole.imag()) * period_s / (2.0 * kPi);
      const bool same = std::abs(turns - std::round(turns)) < kWholeTurn;
      return misfit(all, pole, same ? alias : std::conj(alias), exponent);
    };
    const double here = misfit_at(lowest);
    double best = here / kClearlyBetter;
    Complex place = lowest;
    for (int k = 1; here > kTurned * kTurned && k <= kFarthestAlias; ++k) {
      for (const int sign : {-1, 1}) {
        const Complex alias(lowest.real(), 2.0 * kPi * k / period_s + sign * lowest.imag());
        const double there = misfit_at(alias);
        if (there >= best) continue;
        best = there;
        place = alias;
      }
    }
    if (std::abs(place - pole) < kWholeTurn / period_s) continue;
    blocks.blocks[m] = block_of(std::abs(place), -place.real() / std::abs(place));
    moved.push_back({m, std::abs(pole) / (2.0 * kPi), std::abs(place) / (2.0 * kPi)});
  }
  return moved;
}

}  // namespace flexarm::measured
