#include "report/page/compare_page.hpp"

#include "compare/measured_verdict.hpp"
#include "report/page/comparison_blocks.hpp"
#include "report/page/measured_blocks.hpp"
#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/page/payload_sweep.hpp"
#include "report/tables/comparison_tables.hpp"
#include "report/tables/measured_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>

namespace flexarm::report::page {

namespace {

/// The arm whose worst difference is largest beside its tolerance, a missing value before all.
const ComparedArm& worst_of(const std::vector<ComparedArm>& arms) {
  return *std::ranges::max_element(arms, {}, [](const ComparedArm& arm) {
    const auto& worst = arm.comparison.verdict.worst;
    return std::isnan(worst.distance) ? INFINITY : worst.distance / worst.tolerance;
  });
}

/// Of the arm that the measurement is farthest from.
compare::MeasuredVerdict worst_measured(const std::vector<ComparedArm>& arms) {
  compare::MeasuredVerdict worst;
  const auto order = [](const compare::MeasuredVerdict& verdict) {
    return std::tuple(verdict.agreement, verdict.in_std.size, verdict.in_percent.size);
  };
  for (const ComparedArm& arm : arms) {
    const auto verdict = compare::judge(arm.measured);
    if (order(verdict) > order(worst)) worst = verdict;
  }
  return worst;
}

/// "agrees with exact_tf ..." of "Measurement: agrees with exact_tf ...".
std::string behind_colon(const std::string& line) {
  return line.substr(line.find(": ") + 2);
}

Verdict formulations_verdict(const std::vector<ComparedArm>& arms) {
  const auto agreeing = std::ranges::count_if(
      arms, [](const ComparedArm& arm) { return arm.comparison.verdict.agree; });
  const bool agree = agreeing == std::ssize(arms);
  // "Verdict: agree. Largest difference relative to its tolerance: ..."
  const std::string line = verdict_line(worst_of(arms).comparison);
  std::string sentence = text_in_words(line.substr(line.find(". ") + 2));
  if (arms.size() > 1) {
    sentence = fmt::format("{} of {} arms agree. {}", agreeing, arms.size(), sentence);
  }
  return {agree ? Status::good : Status::bad,
          agree ? "formulations agree" : "formulations disagree", std::move(sentence)};
}

/// Of a measurement before that of the formulations.
Verdict comparison_verdict(const std::vector<ComparedArm>& arms) {
  const Verdict formulations = formulations_verdict(arms);
  const auto measured = worst_measured(arms);
  if (measured.agreement == compare::MeasuredAgreement::none) return formulations;
  const bool agrees = measured.agreement == compare::MeasuredAgreement::agrees;
  const std::string sentence = text_in_words(behind_colon(measured_verdict_line(measured)));
  return {agrees ? formulations.status : Status::bad,
          (agrees ? "measurement agrees, " : "measurement differs, ") + formulations.word,
          "Measurement: " + sentence + " Formulations: " + formulations.sentence};
}

bool is_measured(const std::vector<ComparedArm>& arms) {
  return worst_measured(arms).agreement != compare::MeasuredAgreement::none;
}

std::string largest(const std::vector<ComparedArm>& arms, std::string_view part) {
  double worst = 0.0;
  bool is_any = false;
  for (const ComparedArm& arm : arms) {
    for (const auto& finding : arm.comparison.findings) {
      if (finding.quantity.find(part) == std::string::npos || std::isnan(finding.distance))
        continue;
      worst = std::max(worst, finding.distance);
      is_any = true;
    }
  }
  return is_any ? fmt::format("{:.1e}", worst) : "";
}

std::vector<Fact> comparison_facts(const std::vector<ComparedArm>& arms) {
  std::vector<Fact> facts;
  for (const ComparedArm& arm : arms) {
    std::string out_of_time = out_of_time_text(arm.comparison, arm.measured);
    if (!out_of_time.empty()) facts.push_back({"incomplete", std::move(out_of_time)});
  }
  const auto add = [&](const char* label, std::string_view part) {
    if (std::string text = largest(arms, part); !text.empty()) {
      facts.push_back({label, std::move(text)});
    }
  };
  double error = 0.0;
  std::size_t measured = 0;
  for (const ComparedArm& arm : arms) {
    for (const auto& row : arm.measured.rows) {
      if (std::isnan(row.error_percent)) continue;
      error = std::max(error, std::abs(row.error_percent));
      ++measured;
    }
  }
  double nrmse = 0.0;
  for (const ComparedArm& arm : arms) {
    for (const auto& run : arm.measured.runs) {
      for (const auto& signal : run.signals) nrmse = std::fmax(nrmse, signal.nrmse_percent);
    }
  }
  if (nrmse > 0.0) facts.push_back({"largest NRMSE of a signal", number_of(nrmse, 3) + " %"});
  if (measured > 0) {
    facts.push_back({"measured poles and zeros", fmt::format("{}", measured)});
    facts.push_back({"largest error of the model", number_of(error, 3) + " %"});
  }
  add("largest difference, poles", "pole");
  add("largest difference, zeros", "zero");
  add("largest difference, mode shapes", "mode shape");
  add("largest difference, responses", "response");
  return facts;
}

std::vector<NamedArm> named(const std::vector<ComparedArm>& arms) {
  std::vector<NamedArm> made;
  for (const ComparedArm& arm : arms) {
    made.push_back({&arm, arms.size() == 1
                              ? ""
                              : fmt::format("payload {} kg",
                                            number_of(arm.comparison.arm.payload.mass_kg, 5))});
  }
  return made;
}

/// The title of a section of one arm.
std::string titled(const std::string& title, const NamedArm& arm) {
  return arm.name.empty() ? title : title + ", " + arm.name;
}

void add_roots(PageDocument& document, const NamedArm& arm) {
  const compare::Comparison& comparison = arm.arm->comparison;
  Section section{"roots", titled("Poles and zeros", arm)};
  section.text.push_back(
      "Maps have the damping of the arm. A zero in the right half plane is non-minimum-phase: the "
      "response to a step begins in the wrong direction.");
  for (MapBlock& map : comparison_maps(arm)) section.blocks.emplace_back(std::move(map));
  std::size_t number = 0;
  for (const Table& table : root_tables(comparison)) {
    add_table(section, table, fmt::format("root-table-{}", ++number));
  }
  add_table(section, notes_table(comparison), "root-counts",
            "Roots found beside the number that an independent count expects.");
  document.add(std::move(section));
}

void add_measured(PageDocument& document, const NamedArm& arm) {
  Section section{"measured", titled("Measured and computed", arm)};
  add_measured_tables(section, arm);
  document.add(std::move(section));
}

void add_agreement(PageDocument& document, const NamedArm& arm) {
  const compare::Comparison& comparison = arm.arm->comparison;
  Section section{"agreement", titled("Agreement in shapes and responses", arm)};
  add_table(section, shapes_table(comparison), "shape-table");
  add_table(section, responses_table(comparison), "response-table");
  add_table(section, subjects_table(comparison), "models");
  document.add(std::move(section));
}

void add_convergence(PageDocument& document, const std::vector<NamedArm>& arms) {
  Section section{"convergence", "Convergence"};
  if (auto block = comparison_convergence(arms); !block.views.empty()) {
    section.text.push_back(text_in_words(convergence_legend(arms.front().arm->comparison)));
    section.blocks.emplace_back(std::move(block));
  }
  for (const NamedArm& arm : arms) {
    for (Table table : convergence_tables(arm.arm->comparison)) {
      table.caption = titled(table.caption, arm);
      add_table(section, table, "convergence-table");
    }
    for (const std::string& note : arm.arm->comparison.basis_notes) {
      section.text.push_back(sentence_of(note));
    }
  }
  document.add(std::move(section));
}

Section payload_section(const std::vector<ComparedArm>& arms) {
  Section section{"payload", "Poles and zeros over the payload"};
  const compare::Comparison& first = arms.front().comparison;
  std::vector<double> masses_kg;
  for (const ComparedArm& arm : arms) masses_kg.push_back(arm.comparison.arm.payload.mass_kg);
  std::vector<arm::Sensor> sensors;
  for (const auto& response : first.responses) sensors.push_back(response.sensor);
  for (SweepBlock& block : payload_sweep(first.arm, masses_kg, sensors)) {
    section.blocks.emplace_back(std::move(block));
  }
  return section;
}

}  // namespace

PageDocument compare_page(const std::vector<ComparedArm>& arms, const PageOrigin& origin) {
  PageDocument document{origin.program,
                        origin.command,
                        (is_measured(arms) ? "Comparison with the measurement: "
                                           : "Comparison of the formulations: ") +
                            origin.subject,
                        comparison_verdict(arms),
                        {},
                        comparison_facts(arms),
                        {}};
  const auto names = named(arms);
  auto runs = measured_runs(names);
  auto measured = measured_responses(names);
  auto responses = comparison_responses(names);
  // What was measured comes first; the rest in sections.
  Section further{"responses", "Frequency responses"};
  for (CurvesBlock* block : {&runs, &measured, &responses}) {
    if (block->views.empty()) continue;
    if (document.headline) {
      further.add(std::move(*block));
    } else {
      document.headline = std::move(*block);
    }
  }
  document.add(std::move(further));
  for (const NamedArm& arm : names) add_measured(document, arm);
  if (arms.front().comparison.subjects.empty()) return document;
  for (const NamedArm& arm : names) add_roots(document, arm);
  document.add(payload_section(arms));
  Section shapes{"shapes", "Mode shapes"};
  shapes.add(comparison_shapes(names));
  document.add(std::move(shapes));
  add_convergence(document, names);
  for (const NamedArm& arm : names) add_agreement(document, arm);
  return document;
}

}  // namespace flexarm::report::page
