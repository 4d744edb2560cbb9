#include "assumed_modes/basis_report.hpp"

#include "arm/linear_arm.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace flexarm::assumed_modes {

namespace {

constexpr std::array kSeries = {12, 16, 20, 24, 32, 40, 48, 64};
constexpr int kLargestRoot = 8;
/// Legendre functions that give the first eight roots to rounding, payload or none.
constexpr int kReferenceFunctions = 44;
/// Errors below this are rounding of omega to double, 1e-16, to more than a percent.
constexpr double kRoundingFloor = 1e-14;
constexpr double kInfiniteOrder = std::numeric_limits<double>::infinity();
/// Orders up to this make a basis slow: ten times the functions gain three digits at most.
constexpr double kSlowOrder = 3.0;

/// p of c_i ~ lambda_i^-p for what the functions lack.
int coefficient_decay(UnmetCondition condition) {
  switch (condition) {
    case UnmetCondition::root_moment:
    case UnmetCondition::tip_moment:
      return 1;
    case UnmetCondition::tip_shear:
      return 2;
    case UnmetCondition::root_displacement:
      return 3;
    case UnmetCondition::root_rotation:
      return 4;
  }
  throw std::logic_error("condition outside its enumeration");
}

std::string_view reason(UnmetCondition condition) {
  switch (condition) {
    case UnmetCondition::root_moment:
      return "the moment at the hub is zero in every function, but the hub needs "
             "EI y'' = Ih y'_tt - tau";
    case UnmetCondition::tip_moment:
      return "the moment at the tip is zero in every function, but the payload needs "
             "EI y'' = -Ip y'_tt";
    case UnmetCondition::tip_shear:
      return "shear at the tip is zero in every function, but the payload needs EI y''' = Mp y_tt";
    case UnmetCondition::root_displacement:
      return "y'''' at the hub is zero in every function, but a moving clamp or axial tension "
             "needs EI y'''' = (P y')' - m y_tt";
    case UnmetCondition::root_rotation:
      return "y''''' at the hub is zero in every function, but a rotating hub needs EI y''''' = -m "
             "y'_tt";
  }
  throw std::logic_error("condition outside its enumeration");
}

enum class RootKind { pole, hub_zero };

/// Slowest first.
std::vector<UnmetCondition> unmet_conditions(const arm::LinearArm& arm, Basis basis,
                                             RootKind root) {
  if (basis == Basis::legendre) return {};
  std::vector<UnmetCondition> unmet;
  const bool root_is_loaded = root == RootKind::hub_zero || arm.hub_inertia_kg_m2 > 0.0 ||
                              arm.hub_spring_N_m_per_rad > 0.0 || arm.hub_radius_m > 0.0;
  if (basis == Basis::pinned_free && root_is_loaded) unmet.push_back(UnmetCondition::root_moment);
  const bool carries_payload = basis == Basis::clamped_with_payload;
  if (!carries_payload && arm.payload_tip_inertia_kg_m2 > 0.0) {
    unmet.push_back(UnmetCondition::tip_moment);
  }
  if (!carries_payload && arm.payload_mass_kg > 0.0) unmet.push_back(UnmetCondition::tip_shear);
  const bool root_moves = root == RootKind::pole && arm.hub_radius_m > 0.0;
  if (root_moves || arm.gravity_m_per_s2 != 0.0 ||
      (carries_payload && arm.payload_first_moment_kg_m != 0.0)) {
    unmet.push_back(UnmetCondition::root_displacement);
  }
  if (basis != Basis::pinned_free && root == RootKind::pole) {
    unmet.push_back(UnmetCondition::root_rotation);
  }
  return unmet;
}

double frequency_rad_per_s(const AssumedModesArm& model, RootKind kind, int root) {
  const auto index = static_cast<std::size_t>(root) - 1;
  return kind == RootKind::pole
             ? model.poles(root).omega_rad_per_s[index]
             : model.zeros({arm::SensorKind::hub_angle}, root).s_rad_per_s[index].imag();
}

/// -slope of log error over log n, by least squares on the errors above rounding.
double fitted_order(const RootConvergence& series) {
  double count = 0.0;
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  for (std::size_t i = 0; i < series.functions.size(); ++i) {
    if (series.relative_error[i] <= kRoundingFloor) continue;
    const double x = std::log(series.functions[i]);
    const double y = std::log(series.relative_error[i]);
    count += 1.0;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  if (count < 3.0) return std::numeric_limits<double>::quiet_NaN();
  return -(count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x);
}

std::string sentence(Basis basis, const RootConvergence& series) {
  const auto at = [&](std::size_t i) {
    return fmt::format("{:.1e} with {} functions", series.relative_error[i], series.functions[i]);
  };
  const std::size_t last = series.functions.size() - 1;
  const std::string subject = fmt::format("{}: error of {}", to_string(basis), series.root);
  if (series.unmet.empty()) {
    return basis == Basis::legendre
               ? fmt::format(
                     "{} converges exponentially ({}, {}): the functions satisfy no end condition "
                     "a priori",
                     subject, at(0), at(1))
               : fmt::format(
                     "{} at the rounding level ({}): the functions are the exact mode shapes",
                     subject, at(0));
  }
  const std::string measured = std::isnan(series.measured_order)
                                   ? "too small to measure"
                                   : fmt::format("measured n^-{:.1f}", series.measured_order);
  return fmt::format(
      "{} decreases as n^-{:.0f} ({}, {}): {}{}", subject, series.predicted_order, measured,
      at(last), reason(series.unmet.front()),
      series.predicted_order <= kSlowOrder ? "; use legendre or clamped_with_payload" : "");
}

RootConvergence convergence(const std::vector<AssumedModesArm>& models,
                            const AssumedModesArm& reference, RootKind kind, int root) {
  const Basis basis = models.front().options().basis;
  RootConvergence result;
  result.root = fmt::format("{} {}", kind == RootKind::pole ? "pole" : "hub zero", root);
  result.unmet = unmet_conditions(arm::linear_arm(reference.arm()), basis, kind);
  result.predicted_order =
      result.unmet.empty() ? kInfiniteOrder : 2.0 * coefficient_decay(result.unmet.front()) - 1.0;
  const double exact = frequency_rad_per_s(reference, kind, root);
  for (const AssumedModesArm& model : models) {
    result.functions.push_back(model.degrees_of_freedom());
    result.relative_error.push_back(std::abs(frequency_rad_per_s(model, kind, root) / exact - 1.0));
  }
  result.measured_order = fitted_order(result);
  result.sentence = sentence(basis, result);
  return result;
}

}  // namespace

BasisReport describe_convergence(const arm::Arm& arm, Basis basis, int root) {
  if (root < 1 || root > kLargestRoot) {
    throw std::invalid_argument(fmt::format("root must be from 1 to {}", kLargestRoot));
  }
  const AssumedModesArm reference(arm, {Basis::legendre, kReferenceFunctions});
  std::vector<AssumedModesArm> models;
  for (const int functions : kSeries)
    models.emplace_back(arm, AssumedModesOptions{basis, functions});
  return {basis, convergence(models, reference, RootKind::pole, root),
          convergence(models, reference, RootKind::hub_zero, root)};
}

}  // namespace flexarm::assumed_modes
