#include "measured/checks/data_check_sign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

/// Says that two signals are of like (sign 1) or unlike sign.
struct Vote {
  std::size_t a = 0;
  std::size_t b = 0;
  int sign = 1;  ///< as recorded, over what it must be
  double weight = 0.0;
};

constexpr double kIdentityWeight = 10.0;
constexpr double kRigidWeight = 3.0;
constexpr double kEnergyWeight = 4.0;
constexpr double kTorqueWeight = 1.5;
constexpr double kDescribedWeight = 5.0;    // to the torque; between sensors as an identity
constexpr double kLeastScore = 8.0;         // standard deviations
constexpr double kLeastCorrelation = 0.85;  // of what moves as if rigid
constexpr double kClearly = 4.0;            // more than one relation of rigid motion
constexpr double kFlipCost = 0.5;           // below any weight: facts before the number of flips
constexpr std::size_t kMostSignals = 12;    // whose signs are tried in all combinations

void add_identities(const Comparison& comparison, std::vector<Vote>& votes) {
  for (const auto& [x, y] : identities_of(comparison)) {
    const GainFit fit = fit_gain(comparison.transforms, x, y);
    if (holds(fit)) votes.push_back({x.signal, y.signal, fit.sign, kIdentityWeight});
  }
}

void add_rigid(const Comparison& comparison, Quantity x, Quantity y, int expected, double weight,
               std::vector<Vote>& votes) {
  const auto fit =
      fit_low_frequencies(comparison.transforms, x, y, rigid_band_Hz(comparison.transforms));
  if (std::abs(fit.score) < kLeastScore || std::abs(fit.correlation) < kLeastCorrelation) return;
  votes.push_back({x.signal, y.signal, fit.score > 0.0 ? expected : -expected, weight});
}

/// Quantities that are in proportion while the arm moves as if rigid, each with the sign of its
/// factor to the hub's acceleration.
struct RigidQuantity {
  Quantity quantity;
  int sign = 1;
};

std::vector<RigidQuantity> rigid_quantities(const Comparison& comparison) {
  std::vector<RigidQuantity> all;
  for (std::size_t i = 1; i < comparison.signals.size(); ++i) {
    const auto& signal = comparison.signals[i];
    if (!comparison.usable[i]) continue;
    const bool bends = signal.is(SensorKind::strain) || signal.is(SensorKind::tip_deflection);
    all.push_back({{i, bends ? 0 : 2 - arm::derivative_order(*signal.sensor)}, bends ? -1 : 1});
  }
  return all;
}

/// `votes` has those of identities. A signal whose relation to another contradicts an identity of
/// the two, as one that friction shakes may, has no rigid motion: it says nothing here.
void add_rigid_motion(const Comparison& comparison, std::vector<Vote>& votes) {
  const auto all = rigid_quantities(comparison);
  std::vector<Vote> rigid;
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      add_rigid(comparison, all[i].quantity, all[j].quantity, all[i].sign * all[j].sign,
                kRigidWeight, rigid);
    }
    if (comparison.usable[0]) {
      add_rigid(comparison, all[i].quantity, {0, 0}, all[i].sign, kTorqueWeight, rigid);
    }
  }
  std::vector<bool> contradicts(comparison.signals.size(), false);
  for (const Vote& vote : rigid) {
    for (const Vote& identity : votes) {
      if (std::minmax(vote.a, vote.b) != std::minmax(identity.a, identity.b)) continue;
      if (vote.sign != identity.sign) contradicts[vote.a] = contradicts[vote.b] = true;
    }
  }
  std::ranges::copy_if(rigid, std::back_inserter(votes), [&](const Vote& vote) {
    return !contradicts[vote.a] && !contradicts[vote.b];
  });
}

/// Extremes of the energy taken up since the first sample: sum of torque times turn, exact for an
/// angle and a torque that is held between samples.
struct Energy {
  double most = 0.0;
  double least = 0.0;
};

Energy energy_of(const CheckedSignal& torque, const CheckedSignal& hub, double period_s) {
  const bool is_angle = hub.is(SensorKind::hub_angle);
  Energy energy;
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < torque.values.size(); ++k) {
    const double turn = is_angle ? hub.values[k + 1] - hub.values[k]
                                 : 0.5 * period_s * (hub.values[k] + hub.values[k + 1]);
    sum += torque.values[k] * turn;
    energy.most = std::max(energy.most, sum);
    energy.least = std::min(energy.least, sum);
  }
  return energy;
}

void add_energy(const Comparison& comparison, std::vector<Vote>& votes) {
  constexpr double kClear = 4.0;
  if (!comparison.usable[0] || !comparison.transforms.from_rest) return;
  for (const auto kind : {SensorKind::hub_angle, SensorKind::hub_velocity}) {
    const auto hub = comparison.find(kind);
    if (!hub) continue;
    const Energy energy =
        energy_of(comparison.signals[0], comparison.signals[*hub], comparison.transforms.period_s);
    if (energy.most > -kClear * energy.least) {
      votes.push_back({0, *hub, 1, kEnergyWeight});
    } else if (-energy.least > kClear * energy.most) {
      votes.push_back({0, *hub, -1, kEnergyWeight});
    }
  }
}

void add_tip(const Comparison& comparison, std::vector<Vote>& votes) {
  const auto fit = fit_tip(comparison);
  if (!fit) return;
  for (const auto& term : {fit->angle, fit->deflection}) {
    if (std::abs(term.score) < kLeastScore) continue;
    votes.push_back({fit->displacement, term.signal, term.gain > 0.0 ? 1 : -1, kIdentityWeight});
  }
}

void add_described(const Comparison& comparison, std::vector<Vote>& votes) {
  for (const auto& [a, b, fit] : comparison.described_and_held()) {
    votes.push_back({a, b, fit.sign, b == 0 ? kDescribedWeight : kIdentityWeight});
  }
}

double cost(const std::vector<Vote>& votes, unsigned flipped) {
  double sum = kFlipCost * std::popcount(flipped);
  for (const auto& vote : votes) {
    const bool unlike = ((flipped >> vote.a) & 1U) != ((flipped >> vote.b) & 1U);
    if ((vote.sign < 0) != unlike) sum += vote.weight;
  }
  return sum;
}

std::string names_of(const Comparison& comparison, unsigned flipped, const char* between) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < comparison.signals.size(); ++i) {
    if (((flipped >> i) & 1U) != 0U) names.push_back(comparison.signals[i].name);
  }
  return fmt::format("{}", fmt::join(names, between));
}

}  // namespace

std::vector<DataFinding> check_signs(const Comparison& comparison) {
  std::vector<Vote> votes;
  add_identities(comparison, votes);
  add_tip(comparison, votes);
  if (shows_rigid_motion(comparison.transforms)) add_rigid_motion(comparison, votes);
  add_energy(comparison, votes);
  add_described(comparison, votes);
  std::erase_if(votes, [](const Vote& vote) { return std::max(vote.a, vote.b) >= kMostSignals; });

  const auto signals = std::min(comparison.signals.size(), kMostSignals);
  unsigned best = 0;
  std::vector<unsigned> equal;
  for (unsigned flipped = 0; flipped < (1U << signals); ++flipped) {
    const double less = cost(votes, best) - cost(votes, flipped);
    if (less > 1e-9) {
      best = flipped;
      equal.clear();
    } else if (less > -1e-9 && flipped != best) {
      equal.push_back(flipped);
    }
  }
  if (cost(votes, 0) - cost(votes, best) < kClearly) return {};
  std::string alternatives;
  for (const unsigned other : equal) {
    alternatives += fmt::format(", or {}", names_of(comparison, other, " and "));
  }
  std::vector<DataFinding> findings;
  for (std::size_t i = 0; i < signals; ++i) {
    if (((best >> i) & 1U) == 0U) continue;
    std::vector<std::string> against;
    for (const auto& vote : votes) {
      const std::size_t other = vote.a == i ? vote.b : vote.a;
      if (vote.sign > 0 || (vote.a != i && vote.b != i) || ((best >> other) & 1U) != 0U) continue;
      if (std::ranges::count(against, comparison.signals[other].name) == 0) {
        against.push_back(comparison.signals[other].name);
      }
    }
    findings.push_back({Fault::sign_flipped, comparison.signals[i].name, 0, 0.0, -1.0,
                        fmt::format("{}: sign inconsistent with {}{}", comparison.signals[i].name,
                                    fmt::join(against, ", "), alternatives)});
  }
  return findings;
}

}  // namespace flexarm::measured
