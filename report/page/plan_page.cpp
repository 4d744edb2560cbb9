#include "report/page/plan_page.hpp"

#include "report/page/page_table.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/plan_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace flexarm::report::page {

namespace {

using diagnose::Plan;

/// Indistinguishable pairs on the first screen, the closest ones.
constexpr std::size_t kShownPairs = 6;

std::string effect_words(const Plan& plan, std::size_t effect) {
  return sentence_of(plan.effects[effect].hypothesis.label());
}

std::string lead_words(double lead) {
  return fmt::format("{}, delta BIC {:.0f}",
                     lead < diagnose::kToldLead ? "indistinguishable" : "distinguishable",
                     std::abs(lead) < 0.5 ? 0.0 : lead);
}

/// Bars are on a logarithmic scale: full from where an effect is clearly distinguishable.
RankingBlock distinguishability(const Plan& plan) {
  RankingBlock block{
      {"distinguishable", "How well each effect is distinguishable from its nearest alternative",
       fmt::format("Expected delta BIC if the effect is there; below {:g} two effects are "
                   "indistinguishable. Bars have a logarithmic scale that ends at {:g}.",
                   diagnose::kToldLead, 10.0 * kClearLead)},
      {}};
  const auto share_of = [](double lead) {
    return std::clamp(std::log10(std::max(lead, 1.0)) / std::log10(10.0 * kClearLead), 0.0, 1.0);
  };
  for (const std::size_t i : least_distinguishable_first(plan)) {
    RankingItem item{effect_words(plan, i), 0.0, "not detectable", false, {}};
    if (plan.effects[i].shows) {
      const auto nearest = nearest_rival(plan, i);
      item.share = share_of(nearest ? nearest->lead : std::numeric_limits<double>::infinity());
      item.value = nearest ? lead_words(nearest->lead) : "no alternative";
      item.details.push_back({"minimum detectable value",
                              unit_text(text_in_words(minimum_detectable(plan.effects[i])))});
      if (nearest) {
        item.details.push_back({"nearest alternative", effect_words(plan, nearest->effect)});
      }
    }
    block.items.push_back(std::move(item));
  }
  return block;
}

/// Effects that are there (rows) against others (columns), in the letters of the first column.
TableBlock separation_matrix_block(const Plan& plan) {
  TableBlock block{{"separations", "Distinguishability of pairs",
                    fmt::format("The effect of the row is there; the letters are those of the "
                                "rows. Numbers are the expected delta BIC, from {:g} on "
                                "distinguishable. A dot: not detectable, or a limiting case of the "
                                "other effect.",
                                diagnose::kToldLead)},
                   {{"effect that is there"}},
                   {}};
  for (std::size_t b = 0; b < plan.effects.size(); ++b) {
    block.columns.push_back({effect_letter(b), "", true});
  }
  for (std::size_t a = 0; a < plan.effects.size(); ++a) {
    std::vector<std::string> row = {effect_letter(a) + "  " + effect_words(plan, a)};
    for (std::size_t b = 0; b < plan.effects.size(); ++b) {
      const auto& separation = plan.separations[a][b];
      row.push_back(a == b ? "" : separation ? fmt::format("{:.0f}", separation->lead) : "·");
    }
    block.rows.push_back(std::move(row));
  }
  return block;
}

/// Of effects that have one parameter with a place where it does nothing: the change of the data in
/// standard deviations grows in proportion to its distance from there, or, of one that does nothing
/// where it is infinite, to its reciprocal. To first order the standard error is then the distance,
/// or the value, over the change.
TableBlock standard_errors(const Plan& plan) {
  TableBlock block{{"standard-errors", "Expected standard errors",
                    "Of each effect by itself, to first order, at the size that the pairs are "
                    "compared at: three times the minimum detectable value where the range allows "
                    "it."},
                   {{"effect"},
                    {"parameter"},
                    {"unit"},
                    {"value", "", true},
                    {"expected standard error", "", true}},
                   {}};
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    const diagnose::Detection& detection = plan.effects[i];
    if (!detection.compared || !(detection.compared_change > 0.0)) continue;
    const auto& parameters = detection.hypothesis.parameters;
    const auto moves = [](const diagnose::SearchedParameter& one) {
      return one.neutral_coordinate().has_value();
    };
    if (std::ranges::count_if(parameters, moves) != 1) continue;
    const auto at = std::ranges::find_if(parameters, moves);
    const double value =
        detection.compared->values[static_cast<std::size_t>(at - parameters.begin())];
    const double error = std::abs(value - at->neutral.value_or(0.0)) / detection.compared_change;
    block.rows.push_back({effect_words(plan, i), text_in_words(at->name),
                          unit_text(detection.hypothesis.unit_of(*at)), number_of(value, 4),
                          number_of(error, 2)});
  }
  return block;
}

Verdict plan_verdict(const Plan& plan) {
  const auto detectable = std::ranges::count(plan.effects, true, &diagnose::Detection::shows);
  const bool all = detectable == std::ssize(plan.effects) && plan.ties.empty();
  const Status status = detectable == 0 ? Status::bad : all ? Status::good : Status::partial;
  return {status,
          detectable == 0     ? "nothing detectable"
          : all               ? "all distinguishable"
          : plan.ties.empty() ? "partly detectable"
                              : "partly distinguishable",
          fmt::format("{} of {} effects are detectable in these runs; {}", detectable,
                      plan.effects.size(),
                      plan.ties.empty() ? "all pairs are distinguishable."
                      : plan.ties.size() == 1
                          ? "1 pair is indistinguishable."
                          : fmt::format("{} pairs are indistinguishable.", plan.ties.size()))};
}

Section ties_section(const Plan& plan) {
  Section section{"indistinguishable", "What the plan does not distinguish"};
  if (plan.ties.empty()) return section;
  for (const auto& members : plan.classes) {
    std::string text = "Equivalence class: ";
    for (std::size_t i = 0; i < members.size(); ++i) {
      text += (i > 0 ? ", " : "") + text_in_words(plan.effects[members[i]].hypothesis.label());
    }
    section.text.push_back(text + ".");
  }
  add_table(section, tie_table(plan), "pairs");
  add_table(section,
            further_run_table(plan.added, plan.added.size(),
                              "Improved plan: additional runs, in order of choice"),
            "added-runs");
  add_table(section,
            further_run_table(plan.further, plan.further.size(), "Value of one additional run"),
            "further-runs");
  if (plan.added.empty()) {
    section.text.emplace_back(
        "None of the additional runs considered resolves an indistinguishable pair.");
  }
  return section;
}

}  // namespace

PageDocument plan_page(const Plan& plan, const PageOrigin& origin) {
  PageDocument document{origin.program,
                        origin.command,
                        "Plan " + origin.subject,
                        plan_verdict(plan),
                        distinguishability(plan),
                        {},
                        {}};
  const auto detectable = std::ranges::count(plan.effects, true, &diagnose::Detection::shows);
  document.facts = {
      {"detectable effects", fmt::format("{} of {}", detectable, plan.effects.size())},
      {"indistinguishable pairs", fmt::format("{}", plan.ties.size())},
      {"runs of the improved plan", fmt::format("{}", plan.better.runs.size())}};
  for (const auto& tie : plan.ties) {
    if (document.results.size() == kShownPairs) break;
    document.results.push_back({effect_words(plan, tie.truth) + " and " +
                                    text_in_words(plan.effects[tie.rival].hypothesis.label()),
                                lead_words(tie.lead)});
  }
  document.next_step =
      plan.ties.empty() ? "Measure as planned."
      : plan.added.empty()
          ? "Measure another signal: no run that was considered resolves a pair."
          : fmt::format("Measure with the improved plan, which --write writes: {}.",
                        text_in_words(plan.added.front().further.change));
  document.add(ties_section(plan));
  Section detection{"detection", "Detection"};
  for (const auto& notice : plan.notices) detection.text.push_back(sentence_of(notice));
  add_table(detection, detection_table(plan), "effects");
  detection.add(standard_errors(plan));
  document.add(std::move(detection));
  Section pairs{"pairs", "Pairs of effects"};
  if (!plan.effects.empty()) pairs.blocks.emplace_back(separation_matrix_block(plan));
  add_table(pairs, separation_table(plan), "pair-table");
  document.add(std::move(pairs));
  return document;
}

}  // namespace flexarm::report::page
