#include "report/page/diagnose_page.hpp"

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
#include "report/tables/missing_force_table.hpp"
#include "report/tables/plan_tables.hpp"
#include "report/tables/prediction_error_table.hpp"
#include "report/tables/symptom_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
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

std::vector<Fact> headline_facts(const Diagnosis& diagnosis) {
  std::vector<Fact> facts;
  const diagnose::Gain& gain = diagnosis.estimation;
  facts.push_back({"NRMSE, arm file", percent_of(gain.before)});
  if (has_after(diagnosis)) facts.push_back({"NRMSE, extended arm", percent_of(gain.after)});
  facts.push_back({"noise floor", percent_of(gain.noise_floor)});
  if (diagnosis.validation) {
    facts.push_back({"NRMSE of validation runs", has_after(diagnosis)
                                                     ? percent_of(diagnosis.validation->after)
                                                     : percent_of(diagnosis.validation->before)});
  }
  if (!diagnosis.causes.empty()) {
    const diagnose::Cause& leading = diagnosis.causes.front();
    facts.push_back({"probability of " + text_in_words(leading.effect),
                     fmt::format("{:.2f}", leading.confidence)});
    if (!leading.parameters.empty()) {
      const auto& parameter = leading.parameters.front();
      facts.push_back({text_in_words(leading.effect) + ": " + text_in_words(parameter.name),
                       fmt::format("{} ± {} {}", number_of(parameter.value, 5),
                                   number_of(parameter.std_error, 2), unit_text(parameter.unit))});
    }
  }
  return facts;
}

void add_text(Section& section, const std::string& text) {
  if (!text.empty()) section.text.push_back(text_in_words(text));
}

Section causes_section(const Diagnosis& diagnosis, const std::string& rest_of_verdict) {
  Section section{"causes", diagnosis.causes.empty() ? "Candidates" : "Causes"};
  const bool is_open = diagnosis.verdict == diagnose::Verdict::partly_explained ||
                       diagnosis.verdict == diagnose::Verdict::unexplained;
  if (is_open) add_text(section, rest_of_verdict);  // else facts say it
  add_text(section, implausible_numbers_text(diagnosis));
  add_text(section, search_text(diagnosis));
  const bool has_candidates = !diagnosis.causes.empty() || !diagnosis.near_misses.empty();
  if (has_candidates) section.blocks.emplace_back(cause_ranking(diagnosis));
  Table parameters = cause_table(diagnosis);
  parameters.caption = "Estimated parameters";
  add_table(section, parameters, "cause-table");
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

Section signals_section(const Diagnosis& diagnosis, const std::vector<DiagnosedChannel>& channels) {
  Section section{"signals", "Measured and simulated"};
  section.text.push_back(
      "NRMSE is the root mean square of measured minus simulated over that of the measured signal "
      "about its mean. The fit, as compare of MATLAB's System Identification Toolbox shows it, is "
      "100 % − NRMSE.");
  if (!channels.empty()) section.blocks.emplace_back(overlay_block(channels, has_after(diagnosis)));
  add_table(section, gain_table(diagnosis), "nrmse");
  add_table(section, channel_gain_table(diagnosis), "nrmse-by-channel");
  add_table(section, band_table(diagnosis.symptoms), "nrmse-by-band");
  add_table(section, distortion_table(diagnosis.symptoms), "distortion");
  return section;
}

std::string test_text(const char* runs, const diagnose::ResidualTest& test) {
  return fmt::format(
      "Residual test of the {} runs, extended arm: the residuals are {}noise (p-value of the level "
      "{:.2g}, of the whiteness {:.2g}; below {:g} they are not).",
      runs, test.is_noise() ? "" : "not ", test.level_p_value, test.whiteness_p_value,
      diagnose::kResidualLevel);
}

Section residuals_section(const Experiment& experiment, const Diagnosis& diagnosis,
                          const std::vector<DiagnosedChannel>& channels) {
  Section section{"residuals", "Residuals"};
  if (channels.empty()) return section;
  section.text.push_back(test_text("estimation", diagnosis.estimation_test));
  if (diagnosis.validation) {
    section.text.push_back(test_text("validation", diagnosis.validation_test));
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

Section responses_section(const Diagnosis& diagnosis,
                          const std::vector<DiagnosedChannel>& frequency_channels,
                          const std::vector<DiagnosedChannel>& time_channels) {
  Section section{"responses", "Frequency responses"};
  auto block = diagnosed_responses(frequency_channels, time_channels, has_after(diagnosis));
  section.add(std::move(block));
  return section;
}

Section roots_section(const Diagnosis& diagnosis, std::vector<MapBlock> maps) {
  Section section{"roots", "Poles and zeros"};
  if (!maps.empty()) {
    section.text.push_back(
        "Poles have the damping of the arm; zeros are those of the undamped arm. A zero in the "
        "right half plane is non-minimum-phase. Friction, backlash and other nonlinear effects are "
        "in none of them.");
  }
  for (MapBlock& map : maps) section.blocks.emplace_back(std::move(map));
  Table shifts = root_shift_table(diagnosis.symptoms);
  shifts.caption = "Measured and simulated poles and zeros";
  add_table(section, shifts, "root-table");
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
  add_table(section, prediction_error_table(diagnosis.prediction_errors), "prediction-errors");
  add_table(section, channel_prediction_error_table(diagnosis.prediction_errors),
            "prediction-errors-by-channel");
  return section;
}

Section method_section(const Diagnosis& diagnosis) {
  Section section{"method", "Model and data"};
  add_text(section, predictor_text(diagnosis));
  add_text(section, formulations_text(diagnosis.formulations));
  for (const std::string& notice : diagnosis.notices) section.text.push_back(sentence_of(notice));
  for (const std::string& text : accepted_texts(diagnosis)) {
    section.text.push_back(sentence_of(text));
  }
  add_table(section, refitted_table(diagnosis), "refitted");
  return section;
}

std::optional<Block> headline_of(const std::vector<DiagnosedChannel>& time_channels,
                                 const std::vector<DiagnosedChannel>& frequency_channels,
                                 std::vector<MapBlock>& maps, bool has_simulation_after) {
  if (auto block = worst_overlay(time_channels, has_simulation_after)) return *std::move(block);
  if (auto block = worst_response(frequency_channels, has_simulation_after)) {
    return *std::move(block);
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
      headline_facts(diagnosis),
      {}};
  document.headline = headline_of(time_channels, frequency_channels, maps, has_after(diagnosis));
  document.add(causes_section(diagnosis, rest));
  document.add(further_runs_section(diagnosis));
  document.add(findings_section(diagnosis));
  document.add(signals_section(diagnosis, time_channels));
  document.add(residuals_section(experiment, diagnosis, time_channels));
  document.add(responses_section(diagnosis, frequency_channels, time_channels));
  document.add(roots_section(diagnosis, std::move(maps)));
  document.add(hub_torque_section(diagnosis));
  document.add(missing_force_section(diagnosis));
  document.add(prediction_section(diagnosis));
  document.add(method_section(diagnosis));
  return document;
}

}  // namespace flexarm::report::page
