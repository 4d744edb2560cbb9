#include "measured/checks/data_check_clock_rate.hpp"

#include "measured/checks/data_check_described.hpp"
#include "measured/checks/data_check_kinematics.hpp"
#include "measured/spectra/robust.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::measured {

namespace {

/// Misfit below which a clock is not doubted, and above which it is not believed.
constexpr double kFits = 0.12;
/// Of the misfit as recorded.
constexpr double kClearlyLess = 0.4;
/// log10 of the gain of a sensor over the torque that friction and the like leave.
constexpr double kLikely = 0.2;
/// Samples from the first one on that are compared: a clock is wrong throughout.
constexpr std::size_t kMostCompared = 65536;

/// How far the record is from what the described arm reads at a period: of its relations to the
/// torque, the median distance from one gain near 1 and one phase.
double misfit_at(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
                 double period_s, bool from_rest, const DescribedArm& arm) {
  const Transforms transforms = transform(signals, period_s, from_rest);
  const DescribedStretch described(signals, transforms, arm);
  std::vector<double> misfits;
  for (const auto& [a, b, fit] : described.relations) {
    if (!usable[a] || !usable[b]) continue;
    const double strange = std::max(0.0, std::abs(fit.log10_gain) - kLikely);
    misfits.push_back(fit.blocks == 0 ? 2.0 : fit.spread + (1.0 - fit.agreement) + strange);
  }
  return misfits.empty() ? 0.0 : median(std::move(misfits));
}

}  // namespace

std::vector<DataFinding> check_clock_rate(std::span<const CheckedSignal> signals,
                                          const std::vector<bool>& usable, double period_s,
                                          bool from_rest, const DataCheckOptions& options) {
  if (!options.described || !usable[0]) return {};
  std::vector<CheckedSignal> compared(signals.begin(), signals.end());
  for (CheckedSignal& signal : compared) {
    if (signal.values.size() <= kMostCompared) continue;
    signal.values = signal.values.first(kMostCompared);
    signal.deviation = standard_deviation(signal.values);
  }
  const auto misfit = [&](double factor) {
    return misfit_at(compared, usable, period_s / factor, from_rest, options.described);
  };
  const double recorded = misfit(1.0);
  if (recorded <= kFits) return {};
  double best = 1.0;
  double least = recorded;
  for (const double factor : {0.1, 0.25, 0.5, 2.0, 4.0, 10.0}) {
    const double now = misfit(factor);
    if (now >= least) continue;
    best = factor;
    least = now;
  }
  if (best == 1.0 || least > kFits || least > kClearlyLess * recorded) return {};
  return {{Fault::clock_rate, "time", 0, 0.0, best,
           fmt::format("the clock runs {:g} times too {}: period {:.6g} s as recorded, {:.6g} s by "
                       "the response of the arm to the torque",
                       best > 1.0 ? best : 1.0 / best, best > 1.0 ? "fast" : "slow", period_s,
                       period_s / best)}};
}

}  // namespace flexarm::measured
