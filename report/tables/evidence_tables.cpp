#include "report/tables/evidence_tables.hpp"

#include "arm/unit_suffix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::report {

namespace {

/// Returns "0.021 N m", "1.05", "0.031 s".
std::string value_text(const diagnose::ParameterEstimate& parameter) {
  return fmt::format("{:.3g}{}", parameter.value, arm::unit_suffix(parameter.unit));
}

/// Returns "coulomb_friction 0.021 N m (established)"; with effects that do as well "... 0.021 N m,
/// or torque_dead_zone (supported)", behind the name of the family where all are of one: "dry
/// friction of the hub: ..."; parameters behind the first with their names.
std::string cause_text(const diagnose::Cause& cause) {
  std::vector<std::string> values;
  for (const auto& parameter : cause.parameters) {
    values.push_back(values.empty() ? value_text(parameter)
                                    : parameter.name + " " + value_text(parameter));
  }
  std::string text = cause.names_family ? cause.family + ": " : "";
  text += fmt::format("{} {}", cause.label(), fmt::join(values, ", "));
  if (!cause.confusable_with.empty()) {
    text += fmt::format(", or {}", fmt::join(cause.confusable_with, " or "));
  }
  return fmt::format("{} ({}{})", text, to_string(cause.grade),
                     cause.is_at_end_of_range ? ", at the end of its range" : "");
}

std::string causes_text(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> all;
  for (const auto& cause : diagnosis.causes) all.push_back(cause_text(cause));
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string error_text(const diagnose::Diagnosis& diagnosis) {
  const diagnose::Gain& gain =
      diagnosis.torque ? *diagnosis.torque : diagnosis.validation.value_or(diagnosis.estimation);
  return fmt::format("{} NRMSE{} {} from {:.3g} to {:.3g} %; the noise floor is {:.3g} %.",
                     diagnosis.validation ? "Held-out" : "Fitted",
                     diagnosis.torque ? " of the hub torque" : "",
                     gain.after <= gain.before ? "falls" : "rises", 100.0 * gain.before,
                     100.0 * gain.after, 100.0 * gain.noise_floor);
}

/// Returns where the largest excess residual is: "The residuals are not noise: largest from 2 to 9
/// Hz at hub_angle (run low)".
std::string left_text(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.torque) return "The residuals are not noise.";
  const auto& bands = diagnosis.symptoms.bands;
  const auto beyond = [](const diagnose::BandError& band) {
    return band.after * band.after - band.noise * band.noise;
  };
  const auto largest = std::ranges::max_element(bands, {}, beyond);
  if (largest == bands.end() || beyond(*largest) <= 0.0) return "The residuals are not noise.";
  return fmt::format(
      "The residuals are not noise: largest from {:.2g} to {:.2g} Hz at {} (run {}), {:.3g} % of "
      "its signal.",
      largest->band.from_Hz, largest->band.to_Hz, largest->sensor, largest->run_id,
      100.0 * largest->after);
}

/// Returns the least and the largest estimate of the first parameter by a run: "0.0198 to 0.0205".
std::string range_text(const std::vector<diagnose::RunEstimate>& runs) {
  if (runs.empty()) return "";
  const auto first = [](const diagnose::RunEstimate& run) { return run.values.front(); };
  const auto [least, most] = std::ranges::minmax(runs, {}, first);
  return fmt::format("{:.3g} to {:.3g}", first(least), first(most));
}

}  // namespace

bool has_grades(const diagnose::Diagnosis& diagnosis) {
  return std::ranges::any_of(diagnosis.causes,
                             [](const auto& cause) { return cause.figures.has_value(); });
}

std::string graded_verdict_text(const diagnose::Diagnosis& diagnosis) {
  const bool is_explained = diagnosis.verdict == diagnose::Verdict::explained;
  return fmt::format("{}: {}. {} {}", is_explained ? "Explained" : "Partly explained",
                     causes_text(diagnosis), error_text(diagnosis),
                     is_explained ? "The residuals are noise." : left_text(diagnosis));
}

Table loss_table(const diagnose::Diagnosis& diagnosis) {
  const bool is_held_out = diagnosis.validation.has_value();
  Table table{"Evidence: what is lost without each effect",
              {{.name = "effect"},
               {.name = "grade"},
               {.name = "-2 ln L, estimation", .significant_digits = 3},
               {.name = "-2 ln L, validation", .significant_digits = 3},
               {.name = is_held_out ? "held-out NRMSE without it" : "NRMSE without it",
                .unit = "%",
                .significant_digits = 3},
               {.name = "increase", .unit = "%", .significant_digits = 2},
               {.name = "std error", .unit = "%", .significant_digits = 2},
               {.name = "estimates of the runs"},
               {.name = "agreement p", .significant_digits = 2}}};
  for (const auto& cause : diagnosis.causes) {
    if (!cause.figures) continue;
    const diagnose::EffectEvidence& figures = *cause.figures;
    table.add_row({cause.label(), std::string(to_string(cause.grade)), figures.estimation,
                   figures.held_out ? Cell(*figures.held_out) : Cell(),
                   100.0 * figures.error_without, 100.0 * figures.error_increase,
                   100.0 * figures.error_increase_std_error, range_text(figures.runs),
                   figures.runs.size() > 1 ? Cell(figures.agreement) : Cell()});
  }
  return table;
}

}  // namespace flexarm::report
