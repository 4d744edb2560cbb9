#include "report/tables/plan_tables.hpp"

#include "arm/unit_suffix.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace flexarm::report {

namespace {

using diagnose::Plan;

constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

std::string label_of(const Plan& plan, std::size_t effect) {
  return plan.effects[effect].hypothesis.label();
}

/// "mass 0.0012 kg", "factor 1 +0.03 %".
std::string value_text(const diagnose::Hypothesis& hypothesis,
                       const diagnose::SearchedParameter& parameter, double value) {
  const std::string unit = arm::unit_suffix(hypothesis.unit_of(parameter));
  const double neutral = parameter.neutral.value_or(0.0);
  if (neutral == 0.0) return fmt::format("{} {:.3g}{}", parameter.name, value, unit);
  return fmt::format("{} {:.3g}{} {:+.2g} %", parameter.name, neutral, unit,
                     100.0 * (value / neutral - 1.0));
}

/// All parameters of one effect.
std::string values_text(const diagnose::Candidate& candidate) {
  std::vector<std::string> words;
  const diagnose::Hypothesis& hypothesis = candidate.effects.front();
  for (std::size_t i = 0; i < candidate.values.size(); ++i) {
    words.push_back(value_text(hypothesis, hypothesis.parameters[i], candidate.values[i]));
  }
  return fmt::format("{}", fmt::join(words, ", "));
}

/// A delta BIC that is nothing but rounding is 0.
double shown_lead(double lead) {
  constexpr double kShownAsZero = 1e-3;
  return std::abs(lead) < kShownAsZero ? 0.0 : lead;
}

std::vector<std::string> tied_with(const Plan& plan, std::size_t effect) {
  std::vector<std::string> names;
  for (const auto& tie : plan.ties) {
    if (tie.truth == effect) names.push_back(label_of(plan, tie.rival));
    if (tie.rival == effect) names.push_back(label_of(plan, tie.truth));
  }
  return names;
}

/// The nearest rival that an effect is distinguishable from, with its lead.
std::string nearest_distinguishable(const Plan& plan, std::size_t effect) {
  const auto nearest = nearest_rival(plan, effect, diagnose::kToldLead);
  return nearest ? fmt::format("{} ({:.0f})", label_of(plan, nearest->effect), nearest->lead) : "";
}

char mark(const Plan& plan, std::size_t truth, std::size_t rival) {
  const auto& separation = plan.separations[truth][rival];
  if (!separation) return ' ';
  if (separation->lead < diagnose::kToldLead) return '#';
  return separation->lead < kClearLead ? 'o' : '.';
}

}  // namespace

std::optional<PlanRival> nearest_rival(const Plan& plan, std::size_t effect, double least_lead) {
  std::optional<PlanRival> nearest;
  for (std::size_t b = 0; b < plan.effects.size(); ++b) {
    const auto& separation = plan.separations[effect][b];
    if (!separation || separation->lead < least_lead) continue;
    if (!nearest || separation->lead < nearest->lead) nearest = PlanRival{b, separation->lead};
  }
  return nearest;
}

std::vector<std::size_t> least_distinguishable_first(const Plan& plan) {
  std::vector<std::size_t> order(plan.effects.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::size_t effect) {
    constexpr int kTied = 0, kNotDetectable = 1, kOther = 2;
    const auto nearest = nearest_rival(plan, effect);
    return std::pair(!tied_with(plan, effect).empty() ? kTied
                     : !plan.effects[effect].shows    ? kNotDetectable
                                                      : kOther,
                     nearest ? nearest->lead : std::numeric_limits<double>::infinity());
  });
  return order;
}

std::string minimum_detectable(const diagnose::Detection& detection) {
  if (!detection.shows) return "not detectable";
  return detection.smallest ? values_text(*detection.smallest) : "detectable (no size parameter)";
}

std::string effect_letter(std::size_t effect) {
  return effect < kLetters.size() ? std::string(1, kLetters[effect]) : std::string("*");
}

std::string plan_summary(const Plan& plan) {
  const auto shown = std::ranges::count(plan.effects, true, &diagnose::Detection::shows);
  std::string text =
      fmt::format("{} of {} effects are detectable in these runs; ", shown, plan.effects.size());
  if (plan.ties.empty()) return text + "all pairs are distinguishable.";
  std::vector<std::string> classes;
  for (const auto& members : plan.classes) {
    std::vector<std::string> names;
    for (const std::size_t effect : members) names.push_back(label_of(plan, effect));
    classes.push_back(fmt::format("{}", fmt::join(names, " / ")));
  }
  return text + fmt::format("{} indistinguishable. Equivalence classes: {}.",
                            plan.ties.size() == 1 ? std::string("1 pair is")
                                                  : fmt::format("{} pairs are", plan.ties.size()),
                            fmt::join(classes, "; "));
}

Table detection_table(const Plan& plan) {
  Table table{"Detectability",
              {{.name = "effect"},
               {.name = "minimum detectable value"},
               {.name = "indistinguishable from"},
               {.name = "closest distinguishable (delta BIC)"}}};
  for (const std::size_t i : least_distinguishable_first(plan)) {
    table.add_row({label_of(plan, i), minimum_detectable(plan.effects[i]),
                   fmt::format("{}", fmt::join(tied_with(plan, i), ", ")),
                   nearest_distinguishable(plan, i)});
  }
  return table;
}

std::string separation_matrix(const Plan& plan) {
  std::string text =
      "Distinguishability of an effect that is present (row) from another (column)\n";
  std::size_t width = 0;
  for (std::size_t i = 0; i < plan.effects.size(); ++i) {
    width = std::max(width, label_of(plan, i).size());
  }
  std::string head(width + 2, ' ');
  for (std::size_t i = 0; i < plan.effects.size(); ++i) head += " " + effect_letter(i);
  text += head + "\n";
  for (std::size_t a = 0; a < plan.effects.size(); ++a) {
    std::string row = fmt::format("{} {:<{}}", effect_letter(a), label_of(plan, a), width);
    for (std::size_t b = 0; b < plan.effects.size(); ++b) {
      row += ' ';
      row += a == b ? '\\' : mark(plan, a, b);
    }
    row.erase(row.find_last_not_of(' ') + 1);
    text += row + "\n";
  }
  return text +
         fmt::format(
             "# indistinguishable (delta BIC < {:g})   o weakly distinguishable (< {:g})   . "
             "distinguishable\nblank: row not detectable, or a limiting case of the column\n",
             diagnose::kToldLead, kClearLead);
}

Table separation_table(const Plan& plan) {
  Table table{"Pairs of effects",
              {{.name = "effect"},
               {.name = "alternative effect"},
               {.name = "cosine"},
               {.name = "expected delta BIC"},
               {.name = "computed by"},
               {.name = "distinguishable"}}};
  for (std::size_t a = 0; a < plan.effects.size(); ++a) {
    for (std::size_t b = 0; b < plan.effects.size(); ++b) {
      const auto& separation = plan.separations[a][b];
      if (!separation) continue;
      table.add_row({label_of(plan, a), label_of(plan, b), separation->cosine, separation->lead,
                     std::string(separation->is_fitted ? "fit" : "cosine"),
                     std::string(separation->lead >= diagnose::kToldLead ? "yes" : "no")});
    }
  }
  constexpr std::size_t kLeadColumn = 3;
  std::ranges::stable_sort(table.rows, {}, [](const std::vector<Cell>& row) {
    return std::get<double>(row[kLeadColumn]);
  });
  return table;
}

Table lead_table(const Plan& plan) {
  Table table{"Expected delta BIC", {{.name = "effect"}}};
  for (std::size_t b = 0; b < plan.effects.size(); ++b) {
    table.columns.push_back({.name = label_of(plan, b)});
  }
  for (std::size_t a = 0; a < plan.effects.size(); ++a) {
    std::vector<Cell> row = {label_of(plan, a)};
    for (const auto& separation : plan.separations[a]) {
      row.emplace_back(separation ? separation->lead : kMissing);
    }
    table.add_row(std::move(row));
  }
  return table;
}

Table tie_table(const Plan& plan) {
  Table table{"Indistinguishable pairs",
              {{.name = "effect present"},
               {.name = "indistinguishable effect"},
               {.name = "cosine", .significant_digits = 4},
               {.name = "expected delta BIC", .significant_digits = 2},
               {.name = "expected delta BIC, improved plan", .significant_digits = 2}}};
  for (const auto& tie : plan.ties) {
    table.add_row({label_of(plan, tie.truth), label_of(plan, tie.rival),
                   plan.separations[tie.truth][tie.rival]->cosine, shown_lead(tie.lead),
                   tie.lead_with_more.value_or(kMissing)});
  }
  return table;
}

Table further_run_table(const std::vector<diagnose::NextExperiment>& runs, std::size_t most,
                        const std::string& caption) {
  Table table{caption,
              {{.name = "based on run"},
               {.name = "change"},
               {.name = "peak torque", .unit = "N m", .significant_digits = 3},
               {.name = "payload", .unit = "kg", .significant_digits = 3},
               {.name = "resolves"},
               {.name = "delta BIC of closest resolved", .significant_digits = 2}}};
  for (std::size_t i = 0; i < std::min(most, runs.size()); ++i) {
    const auto& [further, leads, told, score] = runs[i];
    const diagnose::PlannedRun& run = further.run;
    const bool in_time = run.kind == measured::RunKind::time;
    double closest = std::numeric_limits<double>::infinity();
    for (const double lead : leads) {
      if (lead >= diagnose::kToldLead) closest = std::min(closest, lead);
    }
    table.add_row({further.like.empty() ? std::string("-") : further.like, further.change,
                   in_time ? response::peak_N_m(diagnose::torque_of(run)) : kMissing,
                   run.payload ? run.payload->mass_kg : kMissing,
                   fmt::format("{} of {}", told, leads.size()),
                   std::isfinite(closest) ? closest : kMissing});
  }
  return table;
}

}  // namespace flexarm::report
