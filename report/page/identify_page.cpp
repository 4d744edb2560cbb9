#include "report/page/identify_page.hpp"

#include "report/page/identification_blocks.hpp"
#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/best_roots.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/identified_root_tables.hpp"
#include "report/tables/method_differences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace flexarm::report::page {

namespace {

using measured::Identification;

/// Counts the poles and zeros that are identified, each once, by its best method.
struct IdentifiedSummary {
  std::size_t poles = 0;
  std::size_t zeros = 0;
  bool has_others = false;  ///< that have no number: unmatched, or aliases
  double largest_error_percent = 0.0;
  std::string furthest;  ///< "pole 2"; empty where nothing has a place in the arm file
};

std::string name_of_root(const ReadRoot& one) {
  if (one.is_pole()) {
    return fmt::format("pole {}{}", *one.root->order, one.hub_held ? ", hub held" : "");
  }
  return fmt::format("zero {} of the {}", *one.root->order, text_in_words(one.sensor));
}

IdentifiedSummary summary_of(const IdentifiedRuns& runs) {
  IdentifiedSummary summary;
  for (const auto& condition : runs.conditions) {
    const auto roots = read_roots(runs.identification, condition);
    summary.has_others |= std::ranges::any_of(roots, [](const auto& o) { return !o.root->order; });
    std::set<std::string> seen;  // tables have poles sensor by sensor
    for (const ReadRoot& one : best_roots(roots)) {
      if (!one.root->order) continue;
      const std::string name = name_of_root(one);
      if (seen.insert(name).second) ++(one.is_pole() ? summary.poles : summary.zeros);
      const double error = std::abs(one.root->error_percent());
      if (std::isnan(error) || error <= summary.largest_error_percent) continue;
      summary.largest_error_percent = error;
      summary.furthest = name;
    }
  }
  return summary;
}

std::size_t faults_of(const Identification& identification) {
  std::size_t count = 0;
  for (const auto& run : identification.runs) count += run.findings.size();
  return count;
}

Verdict identification_verdict(const Identification& identification,
                               const IdentifiedSummary& summary) {
  const auto doubtful = doubts(identification);
  const std::size_t faults = faults_of(identification);
  const bool is_refused = std::ranges::any_of(identification.runs,
                                              [](const auto& run) { return !run.refusal.empty(); });
  Verdict verdict;
  if (summary.poles + summary.zeros == 0) {
    verdict = {Status::bad, "nothing identified",
               summary.has_others ? "No pole or zero of the arm file was identified: what was read "
                                    "corresponds to none of them."
                                  : "No pole or zero was identified in these data."};
  } else {
    const bool is_good = faults == 0 && !is_refused && doubtful.empty();
    verdict = {
        is_good ? Status::good : Status::partial, doubtful.empty() ? "identified" : "doubtful",
        fmt::format("{} pole{} and {} zero{} identified.", summary.poles,
                    summary.poles == 1 ? "" : "s", summary.zeros, summary.zeros == 1 ? "" : "s")};
    if (!summary.furthest.empty()) {
      verdict.sentence +=
          fmt::format(" The largest difference from the arm file is {:.3g} %, in {}.",
                      summary.largest_error_percent, summary.furthest);
    }
  }
  std::string first;
  for (const auto& doubt : doubtful) first += text_in_words(doubt) + ". ";
  verdict.sentence = first + verdict.sentence;
  if (faults > 0) {
    verdict.sentence +=
        fmt::format(" The recordings have {} fault{}.", faults, faults == 1 ? "" : "s");
  }
  return verdict;
}

Section roots_of_runs(const IdentifiedRuns& runs) {
  Section section{"roots", "Poles and zeros"};
  for (MapBlock& map : identified_maps(runs)) section.blocks.emplace_back(std::move(map));
  for (const auto& condition : runs.conditions) {
    for (const auto& name : sources(runs.identification, condition)) {
      const IdentifiedData data{runs.identification, condition, name};
      const std::array tables = {
          std::pair(pole_table(data), "poles"), std::pair(held_pole_table(data), "held-poles"),
          std::pair(zero_table(data), "zeros"), std::pair(damping_table(data), "damping"),
          std::pair(real_zero_table(data), "real-zeros")};
      for (const auto& [table, id] : tables) add_table(section, table, id);
    }
  }
  for (const auto& text : all_method_differences(runs.identification, runs.conditions)) {
    section.text.push_back(text_in_words(text) + ".");
  }
  return section;
}

Section fit_section(const IdentifiedRuns& runs) {
  Section section{"fit", "Modal fit"};
  section.add(stabilisation_charts(runs));
  for (const auto& condition : runs.conditions) {
    for (const std::size_t f : condition.fits) {
      const auto& fit = runs.identification.fits[f];
      if (!fit.refusal.empty()) continue;
      const std::string name = joined(ids_of(fit, runs.identification));
      section.text.push_back(fmt::format(
          "{}: {} to {} Hz, {} second-order sections, {} of them modes; {}{}.", name,
          number_of(fit.fit.band.from_Hz, 4), number_of(fit.fit.band.to_Hz, 4),
          fit.fit.poles.size(),
          std::ranges::count(fit.fit.poles, true, &measured::FittedPole::is_mode),
          text_in_words(fit.fit.order_reason), fit.fit.converged ? "" : "; not converged"));
      add_table(section, residual_table(fit), "residuals");
      add_table(section, gain_table(fit, condition), "gains");
    }
  }
  return section;
}

Section spectra_section(const IdentifiedRuns& runs) {
  Section section{"spectra", "Spectra"};
  section.add(autopower_spectra(runs));
  TableBlock settings{{"settings", "Settings of the spectra", ""},
                      {{"run"}, {"setting"}, {"value"}, {"reason"}},
                      {}};
  for (const auto& run : runs.identification.runs) {
    if (!run.estimate) continue;
    for (const auto& [name, value, reason] : run.estimate->settings.reports) {
      settings.rows.push_back(
          {run.run.id, text_in_words(name), text_in_words(value), text_in_words(reason)});
    }
  }
  section.add(std::move(settings));
  for (const auto& run : runs.identification.runs) {
    add_table(section, distortion_table(run), "distortion");
  }
  return section;
}

Section circles_section(const IdentifiedRuns& runs) {
  Section section{"circles", "Nyquist circles"};
  section.add(nyquist_circles_block(runs));
  return section;
}

Section recordings_section(const IdentifiedRuns& runs) {
  Section section{"recordings", "Recordings"};
  const auto notes = data_notes(runs.identification);
  for (const auto& note : notes) section.text.push_back(text_in_words(note));
  if (notes.empty()) section.text.emplace_back("The checks of the recordings found no fault.");
  section.add(recorded_signals(runs));
  return section;
}

}  // namespace

PageDocument identify_page(const Identification& identification,
                           const std::vector<compare::IdentifiedCondition>& conditions,
                           const std::vector<measured::MeasuredRun>& recorded,
                           const PageOrigin& origin) {
  const IdentifiedRuns runs{identification, conditions, recorded};
  const IdentifiedSummary summary = summary_of(runs);
  PageDocument document{origin.program,
                        origin.command,
                        "Identification of " + origin.subject,
                        identification_verdict(identification, summary),
                        {},
                        {},
                        {}};
  document.facts = {{"runs", fmt::format("{}", identification.runs.size())},
                    {"poles", fmt::format("{}", summary.poles)},
                    {"zeros", fmt::format("{}", summary.zeros)},
                    {"faults of the recordings", fmt::format("{}", faults_of(identification))}};
  if (!summary.furthest.empty()) {
    document.facts.push_back({"largest difference, " + summary.furthest,
                              number_of(summary.largest_error_percent, 3) + " %"});
  }
  if (auto responses = identified_responses(runs); !responses.views.empty()) {
    document.headline = std::move(responses);
  }
  document.add(roots_of_runs(runs));
  document.add(fit_section(runs));
  document.add(spectra_section(runs));
  document.add(circles_section(runs));
  document.add(recordings_section(runs));
  return document;
}

}  // namespace flexarm::report::page
