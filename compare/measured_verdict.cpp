#include "compare/measured_verdict.hpp"

#include "measured/spectra/tail_probability.hpp"

#include <fmt/format.h>

#include <cmath>

namespace flexarm::compare {

namespace {

std::string name_of(const MeasuredRow& row) {
  const bool is_zero = row.measured.feature == measured::Feature::zero;
  return fmt::format("{}{}{}", is_zero ? arm::to_string(*row.measured.sensor) + " zero" : "pole",
                     row.order ? " " : "", row.order ? fmt::to_string(*row.order) : "");
}

void keep_largest(double difference, const std::string& of, LargestDifference& largest) {
  if (!largest.of.empty() && std::abs(difference) <= largest.size) return;
  largest = {std::abs(difference), of};
}

void add_deviation(double deviation, const std::string& of, MeasuredVerdict& verdict) {
  if (!std::isfinite(deviation)) return;
  ++verdict.judged_by_std;
  verdict.chi_square += deviation * deviation;
  keep_largest(deviation, of, verdict.in_std);
}

void add_percent(double percent, const std::string& of, MeasuredVerdict& verdict) {
  if (!std::isfinite(percent)) return;
  ++verdict.judged_by_percent;
  keep_largest(percent, of, verdict.in_percent);
}

}  // namespace

MeasuredVerdict judge(const MeasuredComparison& measured) {
  MeasuredVerdict verdict;
  verdict.tolerance_percent = measured.tolerance_percent;
  for (const auto& row : measured.rows) {
    const std::string frequency = name_of(row) + " frequency";
    if (std::isfinite(row.combined_deviation)) {
      add_deviation(row.combined_deviation, frequency, verdict);
    } else {
      add_percent(row.error_percent, frequency, verdict);
    }
    add_deviation(row.damping_deviation, name_of(row) + " damping ratio", verdict);
  }
  for (const auto& response : measured.responses) {
    const std::string run = response.run.empty() ? "" : " of run " + response.run;
    add_percent(response.relative_error_percent.front(),
                arm::to_string(response.measured.sensor) + " response" + run, verdict);
  }
  for (const auto& run : measured.runs) {
    for (const auto& signal : run.signals) {
      add_percent(signal.nrmse_percent, fmt::format("{} of run {}", signal.sensor, run.run),
                  verdict);
    }
  }
  if (verdict.judged_by_std > 0) {
    verdict.p_value =
        measured::chi_squared_tail(verdict.chi_square, static_cast<double>(verdict.judged_by_std));
  }
  if (verdict.judged_by_std + verdict.judged_by_percent > 0) {
    verdict.agreement = verdict.agrees_by_std() && verdict.agrees_by_percent()
                            ? MeasuredAgreement::agrees
                            : MeasuredAgreement::differs;
  }
  return verdict;
}

}  // namespace flexarm::compare
