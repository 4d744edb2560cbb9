#include "measured/checks/run_check_signals.hpp"

#include <algorithm>

namespace flexarm::measured {

RunSignals signals_of(const CheckedRun& run, std::size_t most_samples) {
  const TimeRecord& record = *run.record;
  const std::size_t count = std::min(record.time_s.size(), most_samples);
  RunSignals made{signals_of(record, 0, count), {}, {}};
  for (const auto& signal : made.signals) {
    made.usable.push_back(signal.deviation > 0.0 && !has_finding(run, signal.name));
  }
  const double period_s =
      (record.time_s[count - 1] - record.time_s[0]) / static_cast<double>(count - 1);
  made.transforms = transform(made.signals, period_s, run.starts_at_rest);
  return made;
}

bool has_finding(const CheckedRun& run, std::string_view channel) {
  return std::ranges::count(run.findings, channel, &DataFinding::channel) > 0;
}

}  // namespace flexarm::measured
