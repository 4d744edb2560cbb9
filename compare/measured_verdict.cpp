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

void add_deviation(double deviation, const std::string& what, MeasuredVerdict& verdict) {
  if (!std::isfinite(deviation)) return;
  ++verdict.judged;
  verdict.chi_square += deviation * deviation;
  if (verdict.worst_std_of.empty() || std::abs(deviation) > verdict.worst_std) {
    verdict.worst_std = std::abs(deviation);
    verdict.worst_std_of = what;
  }
}

void add_percent(double percent, const std::string& what, MeasuredVerdict& verdict) {
  if (!std::isfinite(percent)) return;
  if (verdict.worst_percent_of.empty() || std::abs(percent) > verdict.worst_percent) {
    verdict.worst_percent = std::abs(percent);
    verdict.worst_percent_of = what;
  }
}

}  // namespace

MeasuredVerdict judge(const MeasuredComparison& measured) {
  MeasuredVerdict verdict;
  for (const auto& row : measured.rows) {
    add_deviation(row.combined_deviation, name_of(row) + " frequency", verdict);
    add_deviation(row.damping_deviation, name_of(row) + " damping ratio", verdict);
    add_percent(row.error_percent, name_of(row) + " frequency", verdict);
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
  if (verdict.judged > 0) {
    verdict.p_value =
        measured::chi_squared_tail(verdict.chi_square, static_cast<double>(verdict.judged));
    verdict.agreement = verdict.p_value >= kLeastProbability ? MeasuredAgreement::agrees
                                                             : MeasuredAgreement::differs;
  } else if (!verdict.worst_percent_of.empty()) {
    verdict.agreement = MeasuredAgreement::not_judged;
  }
  return verdict;
}

}  // namespace flexarm::compare
