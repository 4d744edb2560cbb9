#include "report/time_left.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flexarm::report {
namespace {

constexpr double kMinute_s = 60.0;
constexpr double kLongest_h = 999.0;

int rounded_up(double value, int step) {
  return step * static_cast<int>(std::ceil(value / step));
}

}  // namespace

void TimeLeft::update(double elapsed_s, double fraction) {
  const double step_s = elapsed_s - elapsed_s_;
  elapsed_s_ = elapsed_s;
  if (elapsed_s < options_.quiet_for_s || fraction < options_.least_fraction) return;
  const double end_s = elapsed_s / std::min(fraction, 1.0);
  if (!end_s_) {
    end_s_ = end_s;
    return;
  }
  const double weight = 1.0 - std::exp(-step_s / (options_.smoothing * elapsed_s));
  *end_s_ += weight * (end_s - *end_s_);
}

std::optional<double> TimeLeft::seconds() const {
  if (!end_s_) return std::nullopt;
  return std::max(*end_s_ - elapsed_s_, 0.0);
}

std::string time_left_text(double seconds) {
  if (seconds < 10.0) return fmt::format("{} s left", std::max(rounded_up(seconds, 1), 1));
  if (seconds < 1.5 * kMinute_s) return fmt::format("{} s left", rounded_up(seconds, 5));
  const double minutes = seconds / kMinute_s;
  if (minutes < 60.0) return fmt::format("{} min left", rounded_up(minutes, 1));
  if (minutes > 60.0 * kLongest_h) return fmt::format("over {:.0f} h left", kLongest_h);
  const int tens = rounded_up(minutes, 10);
  return fmt::format("{} h {} min left", tens / 60, tens % 60);
}

}  // namespace flexarm::report
