#include "diagnose/unknown/balanced_motion.hpp"

#include "diagnose/search/misfit.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string>

namespace flexarm::diagnose {

namespace {

/// Samples of a mean. Noise of a motion that is differentiated twice is fast: over so many samples
/// little of it is left.
constexpr std::size_t kSamplesOfMean = 8;

/// Adds the means of blocks of values.
void append_means(std::vector<double>& all, const std::vector<double>& values) {
  for (std::size_t first = 0; first < values.size(); first += kSamplesOfMean) {
    const std::size_t count = std::min(kSamplesOfMean, values.size() - first);
    double sum = 0.0;
    for (std::size_t k = first; k < first + count; ++k) sum += values[k];
    all.push_back(sum / static_cast<double>(count));
  }
}

}  // namespace

BalancedMotion balanced_motion(const Problem& balance, const arm::Arm& arm,
                               const std::vector<bool>& runs) {
  BalancedMotion motion;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!runs[r]) continue;
    const BalancedRun run = balance.predictor().balanced(arm, r);
    append_means(motion.missing_N_m, run.missing_N_m);
    append_means(motion.velocity_rad_per_s, run.velocity_rad_per_s);
    append_means(motion.angle_rad, run.angle_rad);
  }
  return motion;
}

double BalancedMotion::mean_square_missing() const {
  return Eigen::VectorXd::Map(missing_N_m.data(), std::ssize(missing_N_m)).squaredNorm() /
         static_cast<double>(missing_N_m.size());
}

Dependence dependence_on(const std::vector<double>& values,
                         const std::vector<double>& missing_N_m) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return values[k]; });
  const std::size_t n = order.size();
  if (n < std::size_t{2} * kIntervals) return {};
  Eigen::VectorXd left(std::ssize(missing_N_m));
  std::ranges::copy(missing_N_m, left.begin());
  const double all = left.squaredNorm();
  for (std::size_t i = 0; i < kIntervals; ++i) {
    const std::size_t first = i * n / kIntervals;
    const std::size_t end = (i + 1) * n / kIntervals;
    double mean = 0.0;
    for (std::size_t k = first; k < end; ++k) mean += missing_N_m[order[k]];
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
  const Dependence on_velocity = dependence_on(motion.velocity_rad_per_s, motion.missing_N_m);
  std::string text = fmt::format(
      "Residual hub torque by torque balance: {:.3g} N m rms with the arm file. Its mean at each "
      "hub velocity is {} of its mean square",
      std::sqrt(motion.mean_square_missing()), percent(on_velocity.share));
  const Dependence on_angle = dependence_on(motion.angle_rad, motion.missing_N_m);
  text += fmt::format(", at each hub angle {}", percent(on_angle.share));
  const double probability = std::min(on_velocity.probability, on_angle.probability);
  return symptom(SymptomKind::hub_torque, text + ".", probability, 2);
}

}  // namespace flexarm::diagnose
