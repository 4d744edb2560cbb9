#include "measured/modal/alias_placement.hpp"

#include "measured/modal/fitted_residues.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace flexarm::measured {
namespace {

using Complex = std::complex<double>;

constexpr int kFarthestAlias = 2;
/// Poles this many turns apart are one; far above rounding.
constexpr double kWholeTurn = 1e-6;
/// A place is better when residues are closer to the imaginary axis by this factor, squared.
constexpr double kClearlyBetter = 4.0;

/// The alias between 0 and half the sampling frequency.
Complex folded(Complex pole, double period_s) {
  const double turn = 2.0 * std::numbers::pi / period_s;
  return {pole.real(), std::abs(std::remainder(pole.imag(), turn))};
}

/// Weighted mean square of the sine of the residues' angles to the imaginary axis, at an alias of
/// the pole; 1 for a hub's residue of the wrong sign.
double misfit(const std::vector<FittedResidue>& all, Complex pole, Complex alias, int exponent) {
  double sum = 0.0;
  double weights = 0.0;
  for (const FittedResidue& residue : all) {
    Complex there = residue.value * std::pow(alias / pole, exponent - residue.derivatives);
    if (alias.imag() < 0.0) there = std::conj(there);
    sum += residue.weight * turn_squared(there, residue.hub);
    weights += residue.weight;
  }
  return weights > 0.0 ? sum / weights : 0.0;
}

}  // namespace

std::vector<MovedBlock> place_aliases(const BlockFit& fit, double period_s, TorqueHold hold,
                                      BlockSet& blocks) {
  blocks = fit.blocks;
  std::vector<MovedBlock> moved;
  const int exponent = hold == TorqueHold::zero ? 1 : 2;
  for (std::size_t m = 0; m < blocks.blocks.size(); ++m) {
    if (blocks.is_rigid(m)) continue;
    const Complex pole = blocks.blocks[m].poles_rad_per_s()[0];
    if (pole.imag() <= 0.0) continue;
    const auto all = fitted_residues(fit, m, pole);
    const Complex lowest = folded(pole, period_s);
    // The residues' angles at an alias, which the pole or its conjugate differs from by turns.
    const auto misfit_at = [&](Complex alias) {
      const double turns = (alias.imag() - pole.imag()) * period_s / (2.0 * std::numbers::pi);
      const bool same = std::abs(turns - std::round(turns)) < kWholeTurn;
      return misfit(all, pole, same ? alias : std::conj(alias), exponent);
    };
    const double here = misfit_at(lowest);
    double best = here / kClearlyBetter;
    Complex place = lowest;
    for (int k = 1; here > kTurned * kTurned && k <= kFarthestAlias; ++k) {
      for (const int sign : {-1, 1}) {
        const Complex alias(lowest.real(),
                            2.0 * std::numbers::pi * k / period_s + sign * lowest.imag());
        const double there = misfit_at(alias);
        if (there >= best) continue;
        best = there;
        place = alias;
      }
    }
    if (std::abs(place - pole) < kWholeTurn / period_s) continue;
    blocks.blocks[m] = block_of(std::abs(place), -place.real() / std::abs(place));
    moved.push_back(
        {m, std::abs(pole) / (2.0 * std::numbers::pi), std::abs(place) / (2.0 * std::numbers::pi)});
  }
  return moved;
}

}  // namespace flexarm::measured
