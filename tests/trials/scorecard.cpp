#include "tests/trials/scorecard.hpp"

#include "arm/input_error.hpp"
#include "tests/trials/calibration.hpp"
#include "tests/trials/clopper_pearson.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <span>

namespace flexarm::trials {

namespace {

constexpr const char* kIntroduction =
    R"(# Scorecard of blind trials

Of flexarm at {}.

{} experiments on three arms (aluminium, steel, a sandwich that is soft in shear) whose causes
`flexarm diagnose` was not told, made by `scripts/trials`. The simulator is not the model that is
fitted: its own finite elements, Newmark's method, each cause said anew (`tests/trials`).
Columns: the kind of data, and noise over signal. In poles and zeros a fifth of that noise is the
frequencies' and ten times it the damping ratios'. The strength of a cause is the error that it
makes in a simulation without it, relative to the signal: weak 5 %, middle 15 %, strong 50 %; of
poles and zeros a tenth of it. Where no physical size makes as much, the largest stands.

A class counts as an answer where it has three members at most. A cause that is named wrongly beside
`partly_explained` is wrong; so is one that is claimed with a probability above 0.5 where the hidden
one has no name. The bounds are Clopper and Pearson's, of 95 % to each side.
)";
constexpr const char* kAboutSmallest =
    R"(## The smallest effect found in 90 % of trials

Its strength as a multiple of the noise: the least at which the effect is named, or in a class of at
most three, in 90 % of the trials or more, there and at every greater strength that was tried; "<"
where no lesser one was. In brackets: the trials at that strength. Below 20 trials nothing is
claimed: "few". For this, faint effects are hidden as well, which make an error of 1.5 %. They are not part of the tables above; what was said
of them:

)";

constexpr const char* kAboutReliability =
    R"(## Claimed probabilities and intervals

A cause is right here if it was hidden itself, whatever class it is said to be in.

)";

using Results = std::vector<TrialResult>;
using Choice = std::function<bool(const TrialResult&)>;

Results chosen(const Results& results, const Choice& choice) {
  Results some;
  std::ranges::copy_if(results, std::back_inserter(some), choice);
  return some;
}

int count(const Results& results, const Choice& choice) {
  return static_cast<int>(std::ranges::count_if(results, choice));
}

int count(const Results& results, Outcome outcome) {
  return count(results, [&](const TrialResult& one) { return one.outcome == outcome; });
}

bool is_found(const TrialResult& one) {
  return one.outcome == Outcome::exact || one.outcome == Outcome::in_class;
}

bool is_right(const TrialResult& one) {
  return is_found(one) || one.outcome == Outcome::quiet || one.outcome == Outcome::recognised;
}

/// "12/14 (86 %)".
std::string part(int some, int all) {
  if (all == 0) return "-";
  return fmt::format("{}/{} ({:.0f} %)", some, all, 100.0 * some / all);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string row(const std::string& name, const std::vector<std::string>& cells) {
  return fmt::format("| {} | {} |\n", name, fmt::join(cells, " | "));
}

std::string header(const std::string& name, const std::vector<std::string>& cells) {
  std::string text = row(name, cells) + "| --- |";
  for (std::size_t i = 0; i < cells.size(); ++i) text += " ---: |";
  return text + "\n";
}

/// Trials of one kind of data and one noise, or of all.
struct Cell {
  std::string title;
  Results results;
};

std::vector<Cell> cells_of(const Results& results) {
  std::map<std::pair<std::string, double>, Results> sorted;
  for (const auto& one : results) sorted[{one.kind, one.noise}].push_back(one);
  std::vector<Cell> cells;
  for (auto& [key, some] : sorted) {
    cells.push_back({fmt::format("{} {:g} %", key.first, 100.0 * key.second), std::move(some)});
  }
  return cells;
}

/// Those of `cells_of`, then the kinds together.
std::vector<Cell> cells_and_totals_of(const Results& results) {
  std::vector<Cell> cells = cells_of(results);
  std::map<double, Results> by_noise;
  for (const auto& one : results) by_noise[one.noise].push_back(one);
  for (auto& [noise, some] : by_noise) {
    cells.push_back({fmt::format("all {:g} %", 100.0 * noise), std::move(some)});
  }
  cells.push_back({"all", results});
  return cells;
}

bool has_effects(const TrialResult& one, std::size_t effects) {
  return one.hidden.size() == effects && !one.outside;
}

std::string noise_reached(const Results& results) {
  const Results answered = chosen(
      results, [](const TrialResult& one) { return is_found(one) && one.validation_floor > 0.0; });
  return part(count(answered,
                    [](const TrialResult& one) {
                      return one.validation_after <= kNoiseReached * one.validation_floor;
                    }),
              static_cast<int>(answered.size()));
}

std::string summary_table(const std::vector<Cell>& cells) {
  std::vector<std::string> titles;
  for (const Cell& cell : cells) titles.push_back(cell.title);
  std::string text = header("", titles);
  const auto add = [&](const std::string& name,
                       const std::function<std::string(const Results&)>& value) {
    std::vector<std::string> values;
    for (const Cell& cell : cells) values.push_back(value(cell.results));
    text += row(name, values);
  };
  const auto of_effects = [&](const std::string& name, std::size_t effects, const Choice& choice) {
    add(name, [&, effects](const Results& all) {
      const Results some =
          chosen(all, [&](const TrialResult& one) { return has_effects(one, effects); });
      return part(count(some, choice), static_cast<int>(some.size()));
    });
  };
  const auto is = [](Outcome outcome) {
    return [outcome](const TrialResult& one) { return one.outcome == outcome; };
  };
  of_effects("one effect: named", 1, is(Outcome::exact));
  of_effects("one effect: named, or in a class of at most three", 1, is_found);
  for (const Strength strength : kStrengths) {
    if (strength == Strength::faint) continue;
    add(fmt::format("... {}", to_string(strength)), [strength](const Results& all) {
      const Results some = chosen(all, [&](const TrialResult& one) {
        return has_effects(one, 1) && one.strength == to_string(strength);
      });
      return part(count(some, is_found), static_cast<int>(some.size()));
    });
  }
  of_effects("one effect: beside others", 1, is(Outcome::partly));
  of_effects("one effect: another named", 1, is(Outcome::wrong));
  of_effects("one effect: missed", 1, is(Outcome::missed));
  of_effects("one effect: abstained", 1, is(Outcome::abstained));
  of_effects("two effects: both named", 2, is_found);
  of_effects("two effects: one of them", 2, is(Outcome::partly));
  of_effects("two effects: another named", 2, is(Outcome::wrong));
  const auto of_nothing = [&](const std::string& name, Outcome outcome) {
    of_effects(name, 0, is(outcome));
    add("... upper 95 % bound", [outcome](const Results& all) {
      const auto some = chosen(all, [](const TrialResult& one) { return has_effects(one, 0); });
      if (some.empty()) return std::string("-");
      const double bound = upper_bound_95(count(some, outcome), static_cast<int>(some.size()));
      return fmt::format("{:.1f} %", 100.0 * bound);
    });
  };
  of_nothing("nothing hidden: a cause named (false alarm)", Outcome::false_alarm);
  of_nothing("nothing hidden: none named, but not adequate", Outcome::doubted);
  add("outside the vocabulary: said so", [](const Results& all) {
    const Results some = chosen(all, [](const auto& one) { return one.outside; });
    return part(count(some, Outcome::recognised), static_cast<int>(some.size()));
  });
  add("outside the vocabulary: another named, or all explained", [](const Results& all) {
    const Results some = chosen(all, [](const auto& one) { return one.outside; });
    return part(count(some, Outcome::wrong) + count(some, Outcome::mistaken),
                static_cast<int>(some.size()));
  });
  add("parameters within 5 %", [](const Results& all) {
    int recovered = 0;
    int parameters = 0;
    for (const auto& one : all) {
      recovered += one.recovered;
      parameters += one.parameters;
    }
    return part(recovered, parameters);
  });
  add("parameters within 1.96 standard errors", [](const Results& all) {
    int covered = 0;
    int parameters = 0;
    for (const auto& one : all) {
      covered += one.covered;
      parameters += one.parameters;
    }
    return part(covered, parameters);
  });
  add("validation error at most 1.1 of the noise", noise_reached);
  add("no answer", [](const Results& all) {
    return part(count(all, Outcome::no_answer), static_cast<int>(all.size()));
  });
  add("time: median, most [s]", [](const Results& all) {
    std::vector<double> times;
    for (const auto& one : all) times.push_back(one.time_s);
    return fmt::format("{:.1f}, {:.1f}", median(times), std::ranges::max(times));
  });
  return text;
}

/// What was named where one cause was hidden, most often first.
std::string confusion_table(const Results& results) {
  std::map<std::string, std::map<std::string, int>> named;
  for (const auto& one : results) {
    if (one.hidden.size() > 1) continue;
    const std::string hidden = one.hidden.empty() ? "nothing" : one.hidden.front();
    ++named[hidden][one.named.empty() ? one.verdict : fmt::format("{}", fmt::join(one.named, "+"))];
  }
  std::string text = "| hidden | said, times |\n| --- | --- |\n";
  for (const auto& [hidden, answers] : named) {
    std::vector<std::pair<std::string, int>> sorted(answers.begin(), answers.end());
    std::ranges::stable_sort(sorted, std::greater(), &std::pair<std::string, int>::second);
    std::vector<std::string> cells;
    for (const auto& [answer, times] : sorted) cells.push_back(fmt::format("{} {}", answer, times));
    text += fmt::format("| {} | {} |\n", hidden, fmt::join(cells, ", "));
  }
  return text;
}

bool is_faint(const TrialResult& one) {
  return one.strength == to_string(Strength::faint);
}

std::string faint_table(const Results& faint) {
  if (faint.empty()) return "No trials.\n";
  std::vector<std::string> titles;
  std::vector<std::string> found;
  std::vector<std::string> wrong;
  std::vector<std::string> silent;
  for (const Cell& cell : cells_and_totals_of(faint)) {
    const auto all = static_cast<int>(cell.results.size());
    titles.push_back(cell.title);
    found.push_back(part(count(cell.results, is_found), all));
    wrong.push_back(
        part(count(cell.results, Outcome::wrong) + count(cell.results, Outcome::partly), all));
    silent.push_back(
        part(count(cell.results, Outcome::missed) + count(cell.results, Outcome::abstained), all));
  }
  return header("", titles) + row("named, or in a class of at most three", found) +
         row("another named", wrong) + row("none named", silent);
}

/// Trials behind a statement on 90 % of them.
constexpr std::size_t kEnoughTrials = 20;

/// The least strength at which a cause is found, over the noise: "< 1.7 (20)"; "none"; "few (2)".
std::string smallest_found(const Results& of_cause) {
  std::string smallest = "none";
  for (auto strength = kStrengths.rbegin(); strength != kStrengths.rend(); ++strength) {
    const Results of = chosen(
        of_cause, [&](const TrialResult& one) { return one.strength == to_string(*strength); });
    if (of.empty()) continue;
    if (of.size() < kEnoughTrials) {
      return smallest == "none" ? fmt::format("few ({})", of.size()) : smallest;
    }
    if (count(of, is_found) < 0.9 * static_cast<double>(of.size())) return smallest;
    double multiples = 0.0;
    for (const TrialResult& one : of) {
      multiples += one.error / (one.kind == "modal" ? kFrequencyNoise * one.noise : one.noise);
    }
    smallest = fmt::format("{:.2g} ({})", multiples / static_cast<double>(of.size()), of.size());
  }
  return smallest == "none" ? smallest : "< " + smallest;
}

std::string smallest_table(const std::vector<Cell>& cells) {
  std::vector<std::string> titles;
  std::map<std::string, std::vector<std::string>> rows;
  for (const Cause& cause : causes()) {
    if (!cause.outside) rows[cause.name];
  }
  for (const Cell& cell : cells) {
    titles.push_back(cell.title);
    for (auto& [name, found] : rows) {
      const Results some = chosen(cell.results, [&](const TrialResult& one) {
        return one.hidden == std::vector<std::string>{name};
      });
      found.push_back(some.empty() ? "" : smallest_found(some));
    }
  }
  std::string text = header("effect", titles);
  for (const auto& [name, found] : rows) text += row(name, found);
  return text;
}

std::string failure_list(const Results& results) {
  std::string text;
  for (const auto& one : results) {
    const bool left_over = is_found(one) && one.verdict != "explained";
    if (is_right(one) && !left_over) continue;
    text += fmt::format("- {} ({}): {}, {}; error {:.2g}, after {:.2g}; {}\n", one.id, one.arm,
                        to_string(one.outcome), one.verdict, one.before, one.after,
                        one.values.empty() ? "nothing named" : one.values);
  }
  return text.empty() ? "None.\n" : text;
}

}  // namespace

namespace {

/// scripts/trials marks a changed tree so.
constexpr std::string_view kChanged = "+changes";

std::string described(const std::string& version) {
  if (version == kUnknownVersion) return version;
  const bool changed = version.find(kChanged) != std::string::npos;
  return fmt::format("{} ({} tree)", version, changed ? "a changed" : "a clean");
}

}  // namespace

void require_one_version(const Results& results, const std::string& version) {
  const auto other =
      std::ranges::find_if(results, [&](const auto& one) { return one.version != version; });
  if (other == results.end()) return;
  throw arm::InputError(fmt::format(
      "{} was answered by flexarm {}, not by {}: give the results of each a file of their own",
      other->id, other->version, version));
}

std::string scorecard(const Results& results) {
  if (results.empty()) return "No trials.\n";
  require_one_version(results, results.front().version);
  const Results faint = chosen(results, is_faint);
  const Results judged = chosen(results, [](const TrialResult& one) { return !is_faint(one); });
  return fmt::format("{}\n{}\n## What was said\n\n{}\n{}{}\n{}\n{}{}\n{}\n## Failures\n\n{}",
                     fmt::format(kIntroduction, described(results.front().version), judged.size()),
                     summary_table(cells_and_totals_of(judged)), confusion_table(judged),
                     kAboutReliability, reliability_table(judged), coverage_table(judged),
                     kAboutSmallest, faint_table(faint), smallest_table(cells_of(results)),
                     failure_list(judged));
}

}  // namespace flexarm::trials
