#include "diagnose/unknown/balanced_motion.hpp"

#include "diagnose/search/misfit.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <variant>

namespace flexarm::diagnose {

namespace {

void append(std::vector<double>& all, const std::vector<double>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

BalancedMotion balanced_motion(const Problem& balance, const arm::Arm& arm,
                               const std::vector<bool>& runs) {
  BalancedMotion motion;
  bool has_angle = true;
  const auto filtered = balance.predictor().innovations(arm, runs, *balance.predictor().noise());
  for (std::size_t r = 0; r < filtered.size(); ++r) {
    const response::FilteredRun& run = filtered[r].filtered;
    if (run.disturbance_N_m.empty()) continue;
    append(motion.disturbance_N_m, run.disturbance_N_m);
    append(motion.velocity_rad_per_s, run.hub_velocity_rad_per_s);
    const auto& record = std::get<measured::TimeRecord>(balance.experiment().runs[r].data);
    const auto* angle = values_of(record, arm::SensorKind::hub_angle);
    has_angle = has_angle && angle != nullptr;
    if (has_angle) append(motion.angle_rad, *angle);
  }
  if (!has_angle) motion.angle_rad.clear();
  return motion;
}

Dependence dependence_on(const std::vector<double>& values,
                         const std::vector<double>& disturbance_N_m) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t k) { return std::isnan(values[k]); });
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k]; });
  const std::size_t n = order.size();
  if (n < std::size_t{2} * kIntervals) return {};
  Eigen::VectorXd left(std::ssize(disturbance_N_m));
  std::ranges::copy(disturbance_N_m, left.begin());
  const double all = left.squaredNorm();
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const std::size_t first = i * n / kIntervals;
    const std::size_t end = (i + 1) * n / kIntervals;
    double mean = 0.0;
    for (std::size_t k = first; k < end; ++k) mean += disturbance_N_m[order[k]];
    mean /= static_cast<double>(end - first);
    for (std::size_t k = first; k < end; ++k) left(static_cast<Eigen::Index>(order[k])) -= mean;
  }
  Dependence made{.share = all > 0.0 ? 1.0 - left.squaredNorm() / all : 0.0};
  const double rest = independent(left, measured::RunKind::time) - kIntervals;
  if (rest < 1.0 || !(made.share < 1.0)) return made;
  const double ratio = made.share / (1.0 - made.share) * rest / kIntervals;
  made.probability = measured::f_tail(ratio, kIntervals, rest);
  return made;
}

Symptom balance_symptom(const Problem& balance) {
  const std::vector<bool> all(balance.experiment().runs.size(), true);
  const BalancedMotion motion = balanced_motion(balance, balance.experiment().arm, all);
  double squares = 0.0;
  for (const double torque : motion.disturbance_N_m) squares += torque * torque;
  const double rms_N_m = std::sqrt(squares / static_cast<double>(motion.disturbance_N_m.size()));
  const Dependence on_velocity = dependence_on(motion.velocity_rad_per_s, motion.disturbance_N_m);
  std::string text = fmt::format(
      "Residual hub torque by torque balance: {:.3g} N m rms with the arm file. Its mean at each "
      "hub velocity is {} of its mean square",
      rms_N_m, percent(on_velocity.share));
  double probability = on_velocity.probability;
  std::size_t tests = 1;
  if (!motion.angle_rad.empty()) {
    const Dependence on_angle = dependence_on(motion.angle_rad, motion.disturbance_N_m);
    text += fmt::format(", at each hub angle {}", percent(on_angle.share));
    probability = std::min(probability, on_angle.probability);
    ++tests;
  }
  return symptom(SymptomKind::hub_torque, text + ".", probability, tests);
}

}  // namespace flexarm::diagnose
