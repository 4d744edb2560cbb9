#include "measured/checks/time_unit_check.hpp"

#include "measured/files/sample_clock.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace flexarm::measured {

namespace {

constexpr std::size_t kWindow = 10;         // samples over which angle and velocity are compared
constexpr double kLeastLikeness = 0.7;      // of the two
constexpr double kPowerFactor = 1.5;        // off a power of 1000
constexpr double kCertainFactor = 3.0;      // off 1
constexpr double kLongestPeriod_s = 0.25;   // half a cycle of 2 Hz
constexpr double kShortestPeriod_s = 1e-6;  // of any log of an arm
constexpr double kThousand = 1000.0;
constexpr double kNano = 1.5e-9;  // the smallest unit of logs, with room for rounding

/// Change of the angle over the integral of the velocity, by least squares; empty where the two are
/// not alike.
std::optional<double> angle_per_integral(const TimeRecord& record) {
  const auto* angle = values_of(record, arm::SensorKind::hub_angle);
  const auto* velocity = values_of(record, arm::SensorKind::hub_velocity);
  if (angle == nullptr || velocity == nullptr) return std::nullopt;
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t k = 0; k + kWindow < angle->size(); k += kWindow) {
    double integral = 0.0;
    for (std::size_t j = k; j < k + kWindow; ++j) {
      integral +=
          ((*velocity)[j] + (*velocity)[j + 1]) / 2.0 * (record.time_s[j + 1] - record.time_s[j]);
    }
    const double change = (*angle)[k + kWindow] - (*angle)[k];
    xx += integral * integral;
    xy += integral * change;
    yy += change * change;
  }
  if (xx == 0.0 || yy == 0.0 || xy * xy <= kLeastLikeness * kLeastLikeness * xx * yy) {
    return std::nullopt;
  }
  return std::abs(xy / xx);
}

}  // namespace

std::optional<TimeUnitDoubt> doubt_time_unit(const TimeRecord& record) {
  if (const auto ratio = angle_per_integral(record)) {
    if (*ratio > 1.0 / kCertainFactor && *ratio < kCertainFactor) return std::nullopt;
    const double power = std::round(std::log(*ratio) / std::log(kThousand));
    const double factor = std::pow(kThousand, power);
    const double off = *ratio / factor;
    if (power != 0.0 && off < kPowerFactor && off > 1.0 / kPowerFactor) {
      return TimeUnitDoubt{factor, fmt::format("the hub angle changes by {:.3g} of the integral of "
                                               "the hub velocity over these times",
                                               *ratio)};
    }
  }
  const double period_s = clock_steps(record.time_s).period_s;
  if (period_s > kLongestPeriod_s) {
    double factor = 1.0 / kThousand;
    while (factor > kNano && period_s * factor > kLongestPeriod_s) factor /= kThousand;
    return TimeUnitDoubt{factor,
                         fmt::format("at one sample every {:.6g} s no flexible mode above {:.3g} "
                                     "Hz is seen",
                                     period_s, 1.0 / (2.0 * period_s))};
  }
  if (period_s > 0.0 && period_s < kShortestPeriod_s) {
    double factor = kThousand;
    while (factor < 1.0 / kNano && period_s * factor < kShortestPeriod_s) factor *= kThousand;
    return TimeUnitDoubt{factor, fmt::format("one sample every {:.3g} s is faster than an arm "
                                             "is measured",
                                             period_s)};
  }
  return std::nullopt;
}

}  // namespace flexarm::measured
