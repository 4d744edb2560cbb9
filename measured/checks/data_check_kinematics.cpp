#include "measured/checks/data_check_kinematics.hpp"

#include "measured/spectra/robust.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {

namespace {

using arm::SensorKind;

constexpr double kFlat = 0.1;       // log10 of a gain that is one for all frequencies
constexpr double kAgreement = 0.9;  // cosine of the phase that a sign and a delay leave
constexpr double kUnity = 0.1;      // log10 of a gain of 1
constexpr double kNoDelay_periods = 1.5;
// An exchange is claimed where it makes the identity hold more narrowly than chance would.
constexpr double kExactGain = 0.05;  // log10
constexpr std::size_t kFewestBlocks = 2;
constexpr double kClearlySmaller = 0.5;  // of the misfit as recorded

/// The signal that stands in the column of `at` when columns a and b are exchanged.
std::size_t exchanged(std::size_t at, std::size_t a, std::size_t b) {
  if (at == a) return b;
  return at == b ? a : at;
}

GainFit fit_of(const Comparison& comparison, const Identity& identity, std::size_t a,
               std::size_t b) {
  return fit_gain(comparison.transforms, {exchanged(identity.x.signal, a, b), identity.x.order},
                  {exchanged(identity.y.signal, a, b), identity.y.order});
}

/// How far gains and phases are from one gain, one sign and one delay. One wrong sign or one wrong
/// unit is no misfit; any other gain is: at a single resonance every pair of channels has one.
double misfit_of(const GainFit& fit) {
  const bool is_unity = std::abs(fit.log10_gain) <= kUnity;
  const bool one_slip = is_unity || (fit.sign > 0 && !unit_slip(fit.log10_gain).empty());
  return fit.blocks == 0 || !one_slip ? 1.0 : fit.spread + (1.0 - fit.agreement);
}

bool is_identity(const Comparison& comparison, const GainFit& fit) {
  return holds(fit) && std::abs(fit.log10_gain) <= kUnity && fit.sign > 0 &&
         std::abs(fit.delay_s) <= kNoDelay_periods * comparison.transforms.period_s;
}

DataFinding swap_finding(const Comparison& comparison, std::size_t a, std::size_t b,
                         const std::string& why) {
  const auto& first = comparison.signals[a].name;
  const auto& second = comparison.signals[b].name;
  return {Fault::swapped_channels,
          first,
          0,
          0.0,
          0.0,
          fmt::format("{} and {} are swapped: {}", first, second, why)};
}

/// Whether an exchange makes the two less plausible than they are.
bool is_stranger(const Comparison& comparison, std::size_t a, std::size_t b) {
  const auto& first = comparison.signals[a];
  const auto& second = comparison.signals[b];
  return implausibility(first, second.deviation) + implausibility(second, first.deviation) >
         implausibility(first, first.deviation) + implausibility(second, second.deviation);
}

/// What the exchange of two columns makes of the identities that it touches.
struct Exchange {
  bool restores = false;  ///< identities that do not hold as recorded, all of them narrowly
  double misfit = 0.0;
  double recorded_misfit = 0.0;
};

Exchange exchange_of(const Comparison& comparison, const std::vector<Identity>& identities,
                     const std::vector<GainFit>& recorded, std::size_t a, std::size_t b) {
  std::vector<std::size_t> touched;
  for (std::size_t i = 0; i < identities.size(); ++i) {
    const auto& [x, y] = identities[i];
    if (x.signal == a || x.signal == b || y.signal == a || y.signal == b) touched.push_back(i);
  }
  Exchange exchange;
  if (std::ranges::all_of(touched,
                          [&](std::size_t i) { return is_identity(comparison, recorded[i]); })) {
    return exchange;
  }
  exchange.restores = true;
  for (const std::size_t i : touched) {
    const GainFit fit = fit_of(comparison, identities[i], a, b);
    exchange.restores = exchange.restores && is_identity(comparison, fit) &&
                        fit.blocks >= kFewestBlocks && fit.spread <= kExactGain &&
                        std::abs(fit.log10_gain) <= kExactGain;
    exchange.misfit += misfit_of(fit);
    exchange.recorded_misfit += misfit_of(recorded[i]);
  }
  return exchange;
}

std::optional<DataFinding> implausible_pair(const Comparison& comparison) {
  const auto& signals = comparison.signals;
  for (std::size_t a = 1; a < signals.size(); ++a) {
    for (std::size_t b = a + 1; b < signals.size(); ++b) {
      if (!comparison.usable[a] || !comparison.usable[b]) continue;
      if (implausibility(signals[a], signals[a].deviation) == 0.0 ||
          implausibility(signals[b], signals[b].deviation) == 0.0 ||
          implausibility(signals[a], signals[b].deviation) > 0.0 ||
          implausibility(signals[b], signals[a].deviation) > 0.0) {
        continue;
      }
      return swap_finding(comparison, a, b,
                          fmt::format("standard deviations {:.3g} {} and {:.3g} {} are implausible "
                                      "as assigned and plausible when swapped",
                                      signals[a].deviation, arm::unit(*signals[a].sensor),
                                      signals[b].deviation, arm::unit(*signals[b].sensor)));
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::size_t> Comparison::find(SensorKind kind) const {
  for (std::size_t i = 0; i < signals.size(); ++i) {
    if (usable[i] && signals[i].is(kind)) return i;
  }
  return std::nullopt;
}

std::vector<DescribedRelation> Comparison::described_and_held() const {
  std::vector<DescribedRelation> relations;
  for (const auto& relation : described) {
    const bool counts = usable[relation.a] && usable[relation.b] && holds(relation.fit) &&
                        relation.fit.blocks >= kFewestBlocks;
    if (counts) relations.push_back(relation);
  }
  return relations;
}

std::vector<Identity> identities_of(const Comparison& comparison) {
  std::vector<Identity> identities;
  const auto angle = comparison.find(SensorKind::hub_angle);
  const auto velocity = comparison.find(SensorKind::hub_velocity);
  const auto displacement = comparison.find(SensorKind::tip_displacement);
  const auto acceleration = comparison.find(SensorKind::tip_acceleration);
  if (angle && velocity) identities.push_back({{*velocity, 0}, {*angle, 1}});
  if (displacement && acceleration) identities.push_back({{*acceleration, 0}, {*displacement, 2}});
  return identities;
}

std::optional<TipFit> fit_tip(const Comparison& comparison) {
  const auto displacement = comparison.find(SensorKind::tip_displacement);
  const auto angle = comparison.find(SensorKind::hub_angle);
  const auto deflection = comparison.find(SensorKind::tip_deflection);
  if (!displacement || !angle || !deflection) return std::nullopt;
  const auto standard = [&](std::size_t i) {
    const auto& signal = comparison.signals[i];
    const auto map = Eigen::Map<const Eigen::VectorXd>(
        signal.values.data(), static_cast<Eigen::Index>(signal.values.size()));
    return Eigen::VectorXd((map.array() - mean(signal.values)) / signal.deviation);
  };
  const Eigen::VectorXd target = standard(*displacement);
  Eigen::MatrixXd columns(target.size(), 2);
  columns.col(0) = standard(*angle);
  columns.col(1) = standard(*deflection);
  const Eigen::Matrix2d normal = columns.transpose() * columns;
  const Eigen::LDLT<Eigen::Matrix2d> factors(normal);
  const Eigen::Vector2d gain = factors.solve(columns.transpose() * target);
  const double variance =
      (target - columns * gain).squaredNorm() / static_cast<double>(target.size());
  const auto term = [&](std::size_t signal, Eigen::Index i) {
    const double error = std::sqrt(variance * factors.solve(Eigen::Vector2d::Unit(i))[i]);
    const double scale =
        comparison.signals[*displacement].deviation / comparison.signals[signal].deviation;
    return TipTerm{signal, gain[i] * scale, error > 0.0 ? gain[i] / error : 0.0};
  };
  return TipFit{*displacement, term(*angle, 0), term(*deflection, 1)};
}

bool holds(const GainFit& fit) {
  return fit.blocks >= 1 && fit.spread <= kFlat && fit.agreement >= kAgreement;
}

double rigid_band_Hz(const Transforms& transforms) {
  constexpr double kRigid_Hz = 0.4;
  constexpr double kLines = 1.25;
  return std::max(kRigid_Hz, kLines / transforms.duration_s);
}

bool shows_rigid_motion(const Transforms& transforms) {
  // A stretch that does not begin at rest holds vibrations that were there before; with few lines
  // in the band they pass for rigid motion.
  constexpr double kHighest_Hz = 0.65;
  constexpr double kFewestLines = 2.5;
  const double band_Hz = rigid_band_Hz(transforms);
  return band_Hz <= kHighest_Hz &&
         (transforms.from_rest || band_Hz * transforms.duration_s >= kFewestLines);
}

std::string unit_slip(double log10_factor) {
  struct Slip {
    const char* meaning;
    double factor;
  };
  constexpr double kPi = std::numbers::pi;
  constexpr Slip kSlips[] = {{"degrees instead of radians", 180.0 / kPi},
                             {"radians instead of degrees", kPi / 180.0},
                             {"rev/min instead of rad/s", 30.0 / kPi},
                             {"revolutions instead of radians", 0.5 / kPi}};
  constexpr double kNear = 0.08;  // log10: 20 %
  const double power = std::round(log10_factor);
  // 9.81 and 9.55 are told from 10 by nothing but the least noise.
  if (power != 0.0 && std::abs(log10_factor - power) <= kNear) {
    return fmt::format("a factor of 1e{:.0f}{}", power,
                       std::abs(power) == 1.0 ? ", or g instead of m/s^2" : "");
  }
  for (const auto& [meaning, factor] : kSlips) {
    if (std::abs(log10_factor - std::log10(factor)) <= kNear) return meaning;
  }
  return "";
}

double implausibility(const CheckedSignal& signal, double deviation) {
  struct Reach {
    double least;
    double most;
  };
  Reach reach{1e-5, 1e3};  // torque
  if (signal.is(SensorKind::hub_angle)) reach = {1e-5, 30.0};
  if (signal.is(SensorKind::hub_velocity)) reach = {1e-4, 100.0};
  if (signal.is(SensorKind::tip_acceleration)) reach = {2e-2, 1e4};
  if (signal.is(SensorKind::tip_displacement)) reach = {1e-5, 30.0};
  if (signal.is(SensorKind::tip_deflection)) reach = {1e-6, 1.0};
  if (signal.is(SensorKind::strain)) reach = {1e-9, 1e-2};
  if (deviation <= 0.0) return 0.0;
  return std::max({0.0, std::log10(deviation / reach.most), std::log10(reach.least / deviation)});
}

std::vector<DataFinding> check_swaps(const Comparison& comparison) {
  const auto identities = identities_of(comparison);
  std::vector<GainFit> recorded;
  for (const auto& [x, y] : identities) recorded.push_back(fit_gain(comparison.transforms, x, y));
  std::optional<DataFinding> found;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < comparison.signals.size(); ++a) {
    for (std::size_t b = a + 1; b < comparison.signals.size(); ++b) {
      if (!comparison.usable[a] || !comparison.usable[b] || is_stranger(comparison, a, b)) continue;
      const Exchange exchange = exchange_of(comparison, identities, recorded, a, b);
      if (!exchange.restores || exchange.misfit >= kClearlySmaller * exchange.recorded_misfit ||
          exchange.misfit >= least) {
        continue;
      }
      least = exchange.misfit;
      found = swap_finding(comparison, a, b, "when swapped, one is the derivative of the other");
    }
  }
  if (!found) found = implausible_pair(comparison);
  return found ? std::vector{*found} : std::vector<DataFinding>{};
}

}  // namespace flexarm::measured
