#include "report/tables/diagnosis_tables.hpp"

#include "arm/unit_suffix.hpp"
#include "report/tables/evidence_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace flexarm::report {

namespace {

/// Of a cause that is named by itself.
constexpr double kLeastProbability = 0.5;

/// "coulomb_friction (probability 0.98)"; of a class "one of time_delay, actuator_lag (...)".
std::string headline(const diagnose::Cause& cause) {
  if (cause.confidence >= kLeastProbability) {
    return fmt::format("{} (probability {:.2f})", cause.label(), cause.confidence);
  }
  return fmt::format("one of {}, {} (probability {:.2f} together)", cause.label(),
                     fmt::join(cause.confusable_with, ", "), cause.class_confidence);
}

std::string headlines(const std::vector<diagnose::Cause>& causes) {
  std::vector<std::string> all;
  for (const auto& cause : causes) all.push_back(headline(cause));
  return fmt::format("{}", fmt::join(all, " and "));
}

/// "beam.length = 0.51 +- 0.0002 m"; the uncertain numbers that the data moved, all if none.
std::string numbers_text(const std::vector<diagnose::RefittedNumber>& numbers) {
  std::vector<std::string> moved;
  std::vector<std::string> all;
  for (const auto& number : numbers) {
    const std::string text = fmt::format("{} = {:.5g} +- {:.2g} {}", number.key, number.value,
                                         number.std_error, number.unit);
    all.push_back(text);
    if (number.has_moved()) moved.push_back(text);
  }
  return fmt::format("{}", fmt::join(moved.empty() ? all : moved, " and "));
}

std::string explanation_of(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.causes.empty()) return numbers_text(diagnosis.refitted);
  std::string text = headlines(diagnosis.causes);
  if (std::ranges::any_of(diagnosis.refitted, &diagnose::RefittedNumber::has_moved)) {
    text += ", with " + numbers_text(diagnosis.refitted);
  }
  return text;
}

/// Which part of the residual test fails.
std::string failure(const diagnose::ResidualTest& test, const char* runs) {
  std::vector<std::string> parts;
  const auto add = [&](double p_value, const char* name) {
    if (p_value < diagnose::kResidualLevel) {
      parts.push_back(fmt::format("{} p = {:.1g}", name, p_value));
    }
  };
  add(test.level_p_value, "level");
  add(test.whiteness_p_value, "whiteness");
  add(test.nuisance_p_value, "uncertain numbers");
  return parts.empty() ? "" : fmt::format("{} ({})", runs, fmt::join(parts, ", "));
}

/// "The residuals of the estimation runs (whiteness p = 1e-9) are not noise."
std::string not_noise(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> failed;
  for (auto text : {failure(diagnosis.estimation_test, "estimation"),
                    failure(diagnosis.validation_test, "validation")}) {
    if (!text.empty()) failed.push_back(std::move(text));
  }
  std::string text;
  if (!failed.empty()) {
    text = fmt::format(" The residuals of the {} runs are not noise.", fmt::join(failed, " and "));
  }
  if (!diagnosis.converged) text += " The fit did not converge.";
  return text;
}

/// What may be there beside the named causes.
std::string beyond_causes(const diagnose::Diagnosis& diagnosis) {
  const bool is_noise = diagnosis.estimation_test.is_noise() &&
                        (!diagnosis.validation || diagnosis.validation_test.is_noise());
  if (!diagnosis.search_end || !is_noise) return " Something else is present.";
  return " The residuals are noise, but the search is incomplete: other causes may explain the "
         "data "
         "as well.";
}

/// Whether residuals at the floor are of the simulation, not of the sensors.
bool is_numerical(const diagnose::Gain& gain) {
  return gain.numerical_error > gain.noise_floor;
}

/// "the noise floor is 0.1 %, the numerical error of the simulation 0.5 %".
std::string floor_of(const diagnose::Gain& gain) {
  std::string text = fmt::format("the noise floor is {:.3g} %", 100.0 * gain.noise_floor);
  if (is_numerical(gain)) {
    text += fmt::format(", the numerical error of the simulation {:.3g} %",
                        100.0 * gain.numerical_error);
  }
  return text;
}

/// Why no effect is named.
std::string no_name_reason(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.near_misses.empty() ||
      diagnosis.near_misses.front().probability < kLeastProbability) {
    return fmt::format("no effect that was tried has a probability of {:g} or more",
                       kLeastProbability);
  }
  const diagnose::NearMiss& best = diagnosis.near_misses.front();
  return fmt::format(
      "no effect is identified. The most probable set, {} ({:.2g}), does not predict the "
      "validation "
      "runs better than the arm as filed",
      best.effects, best.probability);
}

std::vector<Cell> gain_row(const std::string& runs, const diagnose::Gain& gain) {
  return {runs, 100.0 * gain.before, 100.0 * gain.after, 100.0 * gain.noise_floor};
}

std::string_view name_of(diagnose::PredictorKind predictor) {
  switch (predictor) {
    case diagnose::PredictorKind::output_error:
      return "output error";
    case diagnose::PredictorKind::closed_loop:
      return "output error in closed loop";
    case diagnose::PredictorKind::grey_box:
      return "stochastic grey box";
    case diagnose::PredictorKind::torque_balance:
      return "torque balance at the hub";
    case diagnose::PredictorKind::driven_by_motion:
      return "driven by motion";
    case diagnose::PredictorKind::frequency_response:
      return "frequency response";
  }
  return "";
}

}  // namespace

std::string implausible_numbers_text(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> numbers;
  for (const auto& number : diagnosis.refitted) {
    if (std::abs(number.deviation) <= diagnose::kPlausibleDeviation) continue;
    numbers.push_back(fmt::format("{} = {:.5g} {} ({:.2g} standard deviations from {:.5g} {})",
                                  number.key, number.value, number.unit, std::abs(number.deviation),
                                  number.file_value, number.unit));
  }
  if (numbers.empty()) return "";
  return fmt::format("Implausible after the fit: {}. Check the arm file first.",
                     fmt::join(numbers, ", "));
}

std::string verdict_text(const diagnose::Diagnosis& diagnosis) {
  if (has_grades(diagnosis)) return graded_verdict_text(diagnosis);
  const double before = 100.0 * diagnosis.estimation.before;
  const double after = 100.0 * diagnosis.estimation.after;
  const std::string floor = floor_of(diagnosis.estimation);
  const std::string fall =
      fmt::format("NRMSE {} from {:.3g} to {:.3g} %{}; {}.", after <= before ? "falls" : "rises",
                  before, after, diagnosis.empirical_law ? " with the empirical law" : "", floor);
  switch (diagnosis.verdict) {
    case diagnose::Verdict::adequate:
      return fmt::format("Adequate: the residuals are {}. NRMSE is {:.3g} %; {}.",
                         is_numerical(diagnosis.estimation)
                             ? "within the numerical error of the simulation"
                             : "noise",
                         before, floor);
    case diagnose::Verdict::explained:
      return fmt::format("Explained by {}: the residuals are noise. {}", explanation_of(diagnosis),
                         fall);
    case diagnose::Verdict::partly_explained:
      return fmt::format("Partly explained by {}. {}{}{}", explanation_of(diagnosis), fall,
                         not_noise(diagnosis), beyond_causes(diagnosis));
    case diagnose::Verdict::unexplained:
      return fmt::format(
          "Unexplained: {}. {}{}", no_name_reason(diagnosis),
          diagnosis.empirical_law ? fall : fmt::format("NRMSE is {:.3g} %; {}.", after, floor),
          not_noise(diagnosis));
  }
  return "";
}

std::string search_text(const diagnose::Diagnosis& diagnosis) {
  std::string text;
  if (const auto& end = diagnosis.search_end) {
    text = "The search is incomplete: the time limit";
    if (diagnosis.time_limit_s) text += fmt::format(" of {:g} s", *diagnosis.time_limit_s);
    text += fmt::format(" ended it at the stage \"{}\".", end->stage);
    if (!end->untried.empty()) {
      constexpr std::size_t kListed = 6;
      const std::size_t listed = std::min(kListed, end->untried.size());
      text += fmt::format(" Not tried at this stage: {}",
                          fmt::join(std::span(end->untried).first(listed), ", "));
      const std::size_t others = end->untried.size() - listed;
      text += others > 0 ? fmt::format(", and {} others.", others) : ".";
    }
    text += " Probabilities are relative to the sets of effects that were tried.";
  }
  if (!diagnosis.excluded.empty()) {
    text += fmt::format("{}Excluded from the search: {}.", text.empty() ? "" : " ",
                        fmt::join(diagnosis.excluded, ", "));
  }
  return text;
}

std::vector<std::string> accepted_texts(const diagnose::Diagnosis& diagnosis) {
  std::vector<std::string> texts;
  for (const auto& [run, finding] : diagnosis.accepted) {
    texts.push_back(fmt::format("accepted: run {}: {}: {} ({})", run, finding.channel, finding.text,
                                measured::check_name(finding.fault)));
  }
  return texts;
}

std::string predictor_text(const diagnose::Diagnosis& diagnosis) {
  if (diagnosis.predictor_reason.empty()) return "";
  const std::string named =
      fmt::format("Predictor: {} ({}).", name_of(diagnosis.predictor), diagnosis.predictor_reason);
  if (diagnosis.predictor == diagnose::PredictorKind::closed_loop) {
    return named +
           " The reference drives the simulation; the torque is the controller's, and is "
           "compared with the data like a sensor.";
  }
  if (diagnosis.predictor == diagnose::PredictorKind::driven_by_motion) {
    return named +
           " The measured motion of the hub drives the simulation; torque and hub are not judged.";
  }
  if (diagnosis.torque) {
    return named +
           " The measured motion of the hub says which torque it takes, and the recorded torque is "
           "compared with that. NRMSE below is that of a simulation.";
  }
  if (!diagnosis.disturbance) return named;
  const diagnose::DisturbanceGain& left = *diagnosis.disturbance;
  const std::string on_modes =
      left.modal_force_N_m > 0.0
          ? fmt::format(
                " White forces of {:.2g} N m on the flexible modes make the data more "
                "likely: on the beam, too, the model lacks a force.",
                left.modal_force_N_m)
          : "";
  return named + on_modes +
         fmt::format(
             " The unrecorded hub torque, as the filter estimates it, is {:.3g} N m rms with the "
             "arm "
             "file{}; the commanded torque is {:.3g} N m rms. Its correlation time is {:.2g} s. "
             "NRMSE below is that of a simulation.",
             left.before_N_m,
             diagnosis.causes.empty()
                 ? ""
                 : fmt::format(" and {:.3g} N m rms with the extended arm", left.after_N_m),
             left.torque_rms_N_m, left.correlation_time_s);
}

Table cause_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Causes",
              {{.name = "effect"},
               {.name = "parameter"},
               {.name = "value"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"},
               {.name = "explains", .unit = "%", .significant_digits = 4},
               {.name = "probability", .significant_digits = 3}}};
  const bool has_classes = std::ranges::any_of(
      diagnosis.causes, [](const auto& cause) { return !cause.confusable_with.empty(); });
  if (has_classes) table.columns.push_back({.name = "indistinguishable from"});
  for (const auto& cause : diagnosis.causes) {
    for (std::size_t i = 0; i < cause.parameters.size(); ++i) {
      const auto& parameter = cause.parameters[i];
      const bool first = i == 0;
      std::vector<Cell> row = {first ? Cell(cause.label()) : Cell(std::string()),
                               parameter.name,
                               parameter.value,
                               parameter.std_error,
                               parameter.unit,
                               first ? Cell(explained_percent(cause.share)) : Cell(std::string()),
                               first ? Cell(cause.confidence) : Cell(std::string())};
      if (has_classes) {
        row.push_back(first ? fmt::format("{}", fmt::join(cause.confusable_with, ", "))
                            : std::string());
      }
      table.add_row(row);
    }
  }
  return table;
}

Table channel_gain_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"NRMSE by channel",
              {{.name = "run"},
               {.name = "sensor"},
               {.name = "arm file", .unit = "%", .significant_digits = 3},
               {.name = "extended arm", .unit = "%", .significant_digits = 3},
               {.name = "noise floor", .unit = "%", .significant_digits = 3}}};
  for (const auto& channel : diagnosis.channels) {
    auto row = gain_row(channel.run, channel.error);
    row.insert(row.begin() + 1, channel.sensor);
    table.add_row(row);
  }
  return table;
}

Table near_miss_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Candidates that were not named",
              {{.name = "effects"},
               {.name = "probability", .significant_digits = 2},
               {.name = "explains", .unit = "%", .significant_digits = 3},
               {.name = "delta BIC", .significant_digits = 3},
               {.name = "NRMSE", .unit = "%", .significant_digits = 3}}};
  for (const auto& miss : diagnosis.near_misses) {
    table.add_row({miss.effects, miss.probability, explained_percent(miss.share), miss.information,
                   100.0 * miss.error});
  }
  return table;
}

Table refitted_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"Uncertain numbers of the arm, refitted",
              {{.name = "key"},
               {.name = "nominal"},
               {.name = "uncertainty", .unit = "%", .significant_digits = 3},
               {.name = "value"},
               {.name = "std error", .significant_digits = 2},
               {.name = "unit"}}};
  for (const auto& number : diagnosis.refitted) {
    table.add_row({number.key, number.file_value, 100.0 * number.uncertainty, number.value,
                   number.std_error, number.unit});
  }
  return table;
}

std::string formulations_text(const diagnose::FormulationCheck& check) {
  if (!check.refused.empty()) {
    return fmt::format("The extended arm was not checked in three formulations: {}.",
                       check.refused);
  }
  return fmt::format(
      "Finite elements, assumed modes and the exact transfer function {} on the linear part of the "
      "extended arm: largest relative difference {:.1e}, in {}.",
      check.agree ? "agree" : "do not agree", check.largest_distance, check.quantity);
}

Table gain_table(const diagnose::Diagnosis& diagnosis) {
  Table table{"NRMSE, mean of the channels",
              {{.name = "runs"},
               {.name = "arm file", .unit = "%", .significant_digits = 3},
               {.name = "extended arm", .unit = "%", .significant_digits = 3},
               {.name = "noise floor", .unit = "%", .significant_digits = 3}}};
  table.add_row(gain_row("estimation", diagnosis.estimation));
  if (diagnosis.validation) table.add_row(gain_row("validation", *diagnosis.validation));
  return table;
}

}  // namespace flexarm::report
