#include "report/page/diagnose_page.hpp"

#include "report/figures/meaning.hpp"
#include "report/figures/overlay_figure.hpp"
#include "report/page/cause_blocks.hpp"
#include "report/page/diagnosed_channels.hpp"
#include "report/page/diagnosed_maps.hpp"
#include "report/page/hub_torque_block.hpp"
#include "report/page/overlay_blocks.hpp"
#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/page/response_blocks.hpp"
#include "report/tables/diagnosis_tables.hpp"
#include "report/tables/empirical_law_table.hpp"
#include "report/tables/evidence_tables.hpp"
#include "report/tables/missing_force_table.hpp"
#include "report/tables/plan_tables.hpp"
#include "report/tables/prediction_error_table.hpp"
#include "report/tables/symptom_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

namespace flexarm::report::page {

namespace {

using diagnose::Diagnosis;
using diagnose::Experiment;

Status status_of(diagnose::Verdict verdict) {
  switch (verdict) {
    case diagnose::Verdict::adequate:
    case diagnose::Verdict::explained:
      return Status::good;
    case diagnose::Verdict::partly_explained:
      return Status::partial;
    case diagnose::Verdict::unexplained:
      break;
  }
  return Status::bad;
}

/// The verdict's first sentence, and the others.
std::pair<std::string, std::string> verdict_sentences(const Diagnosis& diagnosis) {
  const std::string text = text_in_words(verdict_text(diagnosis));
  const std::size_t end = text.find(". ");
  if (end == std::string::npos) return {text, ""};
  return {text.substr(0, end + 1), text.substr(end + 2)};
}

/// Each cause and refitted number with its value.
std::vector<Fact> cause_results(const Diagnosis& diagnosis) {
  std::vector<Fact> results;
  for (const auto& cause : diagnosis.causes) {
    const std::string probability = ", probability " + probability_text(cause.confidence);
    for (const auto& parameter : cause.parameters) {
      const bool is_first = &parameter == &cause.parameters.front();
      results.push_back({cause_label(cause) + ", " + text_in_words(parameter.name),
                         estimate_of(parameter.value, parameter.std_error, parameter.unit) +
                             (is_first ? probability : "")});
    }
    if (cause.parameters.empty()) results.push_back({cause_label(cause), probability.substr(2)});
  }
  for (const auto& number : diagnosis.refitted) {
    if (!number.has_moved()) continue;
    results.push_back(
        {number.key + ", refitted", estimate_of(number.value, number.std_error, number.unit)});
  }
  return results;
}

/// "467 % → 0.504 %"; of a diagnosis without an extended arm the first alone.
std::string fall_text(double before, double after, bool has_simulation_after) {
  return has_simulation_after ? percent_of(before) + " → " + percent_of(after) : percent_of(before);
}

/// Residuals: NRMSE, the noise floor, and the band that is furthest above it.
std::vector<Fact> facts_of_what_is_left(const Diagnosis& diagnosis) {
  const bool has_simulation_after = has_after(diagnosis);
  const diagnose::Gain& gain = diagnosis.estimation;
  std::vector<Fact> facts = {
      {"NRMSE, estimation runs", fall_text(gain.before, gain.after, has_simulation_after)}};
  if (const auto& held_out = diagnosis.validation) {
    facts.push_back({"NRMSE, validation runs",
                     fall_text(held_out->before, held_out->after, has_simulation_after)});
  }
  facts.push_back({"noise floor", percent_of(gain.noise_floor)});
  const auto& bands = diagnosis.symptoms.bands;
  const auto excess = [&](const diagnose::BandError& band) {
    return (has_simulation_after ? band.after : band.before) - band.noise;
  };
  if (const auto worst = std::ranges::max_element(bands, {}, excess); worst != bands.end()) {
    facts.push_back(
        {fmt::format("largest error: {}, {} to {} Hz", text_in_words(worst->sensor),
                     number_of(worst->band.from_Hz, 3), number_of(worst->band.to_Hz, 3)),
         fmt::format("{} (noise {})",
                     percent_of(has_simulation_after ? worst->after : worst->before),
                     percent_of(worst->noise))});
  }
  if (diagnosis.verdict != diagnose::Verdict::adequate) {
    facts.push_back({"probability of something else", probability_text(diagnosis.something_else)});
  }
  return facts;
}

/// Next step: what restricts the verdict comes first.
std::string next_step_of(const Diagnosis& diagnosis) {
  if (!implausible_numbers_text(diagnosis).empty()) {
    return "Check the arm file: numbers are implausible after the fit.";
  }
  if (diagnosis.search_end) return "Search again with a longer time limit.";
  if (!diagnosis.next_experiments.empty()) {
    const auto& [further, leads, told, score] = diagnosis.next_experiments.front();
    return fmt::format("Measure again: {}{}. It would resolve {} of {} indistinguishable pairs.",
                       text_in_words(further.change),
                       further.like.empty() ? "" : ", as in run " + further.like, told,
                       leads.size());
  }
  switch (diagnosis.verdict) {
    case diagnose::Verdict::adequate:
      return "None: the arm file predicts these data.";
    case diagnose::Verdict::explained:
      return "Simulate with the extended arm, which --out writes as extended.toml.";
    case diagnose::Verdict::partly_explained:
    case diagnose::Verdict::unexplained:
      break;
  }
  return "Look at the residual analysis below: it shows where and how the simulation is off.";
}

void add_text(Section& section, const std::string& text) {
  if (!text.empty()) section.text.push_back(text_in_words(text));
}

Section causes_section(const Diagnosis& diagnosis, const std::string& rest_of_verdict) {
  Section section{"causes", diagnosis.causes.empty() ? "Candidates" : "Causes"};
  if (is_open(diagnosis.verdict)) add_text(section, rest_of_verdict);  // else facts say it
  add_text(section, implausible_numbers_text(diagnosis));
  add_text(section, search_text(diagnosis));
  if (!diagnosis.causes.empty()) section.blocks.emplace_back(cause_ranking(diagnosis));
  Table parameters = cause_table(diagnosis);
  parameters.caption = "Estimated parameters";
  add_table(section, parameters, "cause-table");
  add_table(section, loss_table(diagnosis), "losses");
  section.add(evidence_table(diagnosis));
  add_table(section, near_miss_table(diagnosis), "candidates");
  return section;
}

Section further_runs_section(const Diagnosis& diagnosis) {
  Section section{"further-runs", "What these data do not tell"};
  section.add(indistinguishable_table(diagnosis));
  if (!diagnosis.next_experiments.empty()) {
    add_table(section,
              further_run_table(diagnosis.next_experiments, diagnosis.next_experiments.size(),
                                "Runs that would distinguish them"),
              "next-runs", "The best first. A delta BIC of 10 or more distinguishes two effects.");
  }
  return section;
}

/// The statements of the residual analysis, the significant ones first.
TableBlock finding_table(const diagnose::Symptoms& symptoms) {
  TableBlock table{
      {"statements", "Findings", ""}, {{"finding"}, {"significant"}, {"p-value", "", true}}, {}};
  for (const auto& one : symptoms.statements) {
    table.rows.push_back(
        {sentence_of(one.text), one.is_significant ? "yes" : "no",
         one.probability > 0.0 ? fmt::format("{:.1e}", one.probability) : "below 1e-300"});
  }
  return table;
}

Section findings_section(const Diagnosis& diagnosis) {
  Section section{"findings", "Residual analysis of the baseline"};
  section.add(finding_table(diagnosis.symptoms));
  add_table(section, run_value_table(diagnosis.symptoms), "run-by-run");
  return section;
}

/// A table with columns of both arms. Without an extended arm there is none of it.
void add_errors(Section& section, Table table, const std::string& id, const Diagnosis& diagnosis) {
  const auto extended = std::ranges::find(table.columns, kExtendedName, &Column::name);
  if (!has_after(diagnosis) && extended != table.columns.end()) {
    const auto at = extended - table.columns.begin();
    table.columns.erase(extended);
    for (auto& row : table.rows) row.erase(row.begin() + at);
  }
  add_table(section, table, id);
}

Section signals_section(const Diagnosis& diagnosis) {
  Section section{"signals", "Errors of the simulation"};
  section.text.push_back(
      "NRMSE is the root mean square of measured minus simulated over that of the measured signal "
      "about its mean. The fit, as compare of MATLAB's System Identification Toolbox shows it, is "
      "100 % − NRMSE.");
  add_errors(section, gain_table(diagnosis), "nrmse", diagnosis);
  add_errors(section, channel_gain_table(diagnosis), "nrmse-by-channel", diagnosis);
  add_errors(section, band_table(diagnosis.symptoms), "nrmse-by-band", diagnosis);
  add_table(section, distortion_table(diagnosis.symptoms), "distortion");
  return section;
}

std::string test_text(const char* runs, const diagnose::ResidualTest& test,
                      const Diagnosis& diagnosis) {
  return fmt::format(
      "Residual test of the {} runs, {}{}: the residuals are {}noise (p-value of the level {:.2g}, "
      "of the whiteness {:.2g}; below {:g} they are not).",
      runs, has_after(diagnosis) ? kExtendedName : kBaselineName,
      diagnosis.is_tested_by_filter ? ", prediction errors of the Kalman filter" : "",
      test.is_noise() ? "" : "not ", test.level_p_value, test.whiteness_p_value,
      diagnose::kResidualLevel);
}

Section residuals_section(const Experiment& experiment, const Diagnosis& diagnosis,
                          const std::vector<DiagnosedChannel>& channels) {
  Section section{"residuals", "Residuals"};
  if (!diagnosis.symptoms.regimes.empty()) {
    section.text.push_back(
        "The error by regime is relative to the whole signal of each channel. Its ratios compare "
        "mean squares of the residual, and of its innovations, with those outside of the regime: "
        "the first shows where the error is large, the second where it arises.");
    add_errors(section, regime_table(diagnosis.symptoms), "error-by-regime", diagnosis);
  }
  if (channels.empty()) return section;
  section.text.push_back(test_text("estimation", diagnosis.estimation_test, diagnosis));
  if (diagnosis.validation) {
    section.text.push_back(test_text("validation", diagnosis.validation_test, diagnosis));
  }
  section.text.push_back(fmt::format(
      "The residual test grants a simulation an error of {:g} % of the signal, which the "
      "bounds of the correlations do not.",
      100.0 * diagnose::kSimulationError));
  const bool by_motion = diagnose::is_driven_by_motion(experiment) ||
                         diagnosis.predictor == diagnose::PredictorKind::driven_by_motion;
  section.blocks.emplace_back(correlation_block(channels, has_after(diagnosis), by_motion));
  return section;
}

Section roots_section(const Diagnosis& diagnosis, std::vector<MapBlock> maps) {
  Section section{"roots", "Poles and zeros"};
  if (!maps.empty()) {
    section.text.push_back(
        "Poles and zeros have the damping of the arm. A zero in the right half plane is "
        "non-minimum-phase. Friction, backlash and other nonlinear effects are in none of them.");
  }
  for (MapBlock& map : maps) section.blocks.emplace_back(std::move(map));
  Table shifts = root_shift_table(diagnosis.symptoms);
  shifts.caption = "Measured and simulated poles and zeros";
  add_errors(section, std::move(shifts), "root-table", diagnosis);
  return section;
}

Section hub_torque_section(const Diagnosis& diagnosis) {
  Section section{"hub-torque", "Residual hub torque"};
  auto block = hub_torque_block(diagnosis.symptoms.hub_torque);
  section.add(std::move(block));
  Table terms = hub_torque_table(diagnosis.symptoms);
  terms.caption = "Terms of the residual hub torque";
  add_table(section, terms, "hub-torque-terms");
  if (const auto& law = diagnosis.empirical_law) {
    add_text(section, empirical_law_text(*law));
    section.blocks.emplace_back(empirical_law_block(*law));
    add_table(section, empirical_law_table(*law), "empirical-law-table");
  }
  return section;
}

Section missing_force_section(const Diagnosis& diagnosis) {
  Section section{"missing-force", "Missing force"};
  if (const auto& force = diagnosis.missing_force) {
    add_text(section, missing_force_text(*force));
    if (!force->ports.empty()) section.blocks.emplace_back(missing_force_ranking(*force));
  }
  return section;
}

Section prediction_section(const Diagnosis& diagnosis) {
  Section section{"prediction", "Prediction errors"};
  if (diagnosis.prediction_errors.empty()) return section;
  section.text.push_back(
      "A Kalman filter estimates the state; from there a simulation predicts the samples that "
      "follow. Errors of a simulation of the whole run are above.");
  // The filter's own simulation of whole runs has other initial states than the one above.
  std::vector<diagnose::PredictionError> ahead = diagnosis.prediction_errors;
  std::erase_if(ahead, [](const auto& error) { return !error.samples_ahead; });
  add_errors(section, prediction_error_table(ahead), "prediction-errors", diagnosis);
  add_errors(section, channel_prediction_error_table(ahead), "prediction-errors-by-channel",
             diagnosis);
  return section;
}

Section method_section(const Diagnosis& diagnosis) {
  Section section{"method", "Model and data"};
  add_text(section, predictor_text(diagnosis));
  std::string formulations = formulations_text(diagnosis.formulations);
  if (const auto at = formulations.find(kExtendedName);
      !has_after(diagnosis) && at != std::string::npos) {
    formulations.replace(at, std::string_view(kExtendedName).size(), kBaselineName);
  }
  add_text(section, formulations);
  for (const std::string& notice : diagnosis.notices) section.text.push_back(sentence_of(notice));
  for (const std::string& text : accepted_texts(diagnosis)) {
    section.text.push_back(sentence_of(text));
  }
  add_table(section, refitted_table(diagnosis), "refitted");
  return section;
}

/// Takes the first block that there is: signals, else responses, else a map of poles and zeros.
std::optional<Block> take_headline(CurvesBlock& signals, CurvesBlock& responses,
                                   std::vector<MapBlock>& maps) {
  for (CurvesBlock* curves : {&signals, &responses}) {
    if (!curves->views.empty()) return std::exchange(*curves, {});
  }
  if (maps.empty()) return std::nullopt;
  Block first = std::move(maps.front());
  maps.erase(maps.begin());
  return first;
}

}  // namespace

PageDocument diagnose_page(const Experiment& experiment, const Diagnosis& diagnosis,
                           const PageOrigin& origin) {
  const auto time_channels = diagnosed_channels(experiment, diagnosis, measured::RunKind::time);
  const auto frequency_channels = diagnosed_channels(experiment, diagnosis, measured::RunKind::frf);
  auto maps = diagnosed_maps(experiment, diagnosis);
  auto [sentence, rest] = verdict_sentences(diagnosis);
  PageDocument document{
      origin.program,
      origin.command,
      "Diagnosis of " + origin.subject,
      {status_of(diagnosis.verdict), text_in_words(diagnose::to_string(diagnosis.verdict)),
       std::move(sentence)},
      {},
      facts_of_what_is_left(diagnosis),
      {},
      cause_results(diagnosis),
      next_step_of(diagnosis)};
  auto signals = overlay_block(time_channels, has_after(diagnosis));
  Section responses{"responses", "Frequency responses"};
  auto response = diagnosed_responses(frequency_channels, time_channels, has_after(diagnosis));
  document.headline = take_headline(signals, response, maps);
  responses.add(std::move(response));
  document.add(causes_section(diagnosis, rest));
  document.add(further_runs_section(diagnosis));
  document.add(findings_section(diagnosis));
  document.add(signals_section(diagnosis));
  document.add(residuals_section(experiment, diagnosis, time_channels));
  document.add(std::move(responses));
  document.add(roots_section(diagnosis, std::move(maps)));
  document.add(hub_torque_section(diagnosis));
  document.add(missing_force_section(diagnosis));
  document.add(prediction_section(diagnosis));
  document.add(method_section(diagnosis));
  return document;
}

}  // namespace flexarm::report::page
