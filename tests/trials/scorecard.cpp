#include "tests/trials/scorecard.hpp"

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

{} experiments on three arms (aluminium, steel, a sandwich that is soft in shear) whose causes
`flexarm diagnose` was not told, made by `scripts/trials`. The simulator is not the model that is
fitted: finite elements, Newmark's method, its own friction, actuator and sensors (`tests/trials`).
Columns: the kind of data, and noise over signal. In poles and zeros a fifth of that noise is the
frequencies' and ten times it the damping ratios'.

A class counts as an answer where it has three members at most. The bounds are Clopper and Pearson's.
)";
constexpr const char* kAboutStrength =
    R"(## The weakest strength found in 90 % of trials

A strength is the error that the cause makes in a simulation without it, relative to the signal:
weak 5 %, middle 15 %, strong 50 %; of poles and zeros a tenth of it. Where no physical size makes
as much, the largest stands. In brackets: the trials at that strength.
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

/// Trials of one kind of data and one noise.
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

/// The weakest strength at which a cause is found in 90 % of the trials.
std::string strength_table(const std::vector<Cell>& cells) {
  std::vector<std::string> titles;
  std::map<std::string, std::vector<std::string>> rows;
  for (const auto& cause : hideables()) {
    if (!cause.outside) rows[cause.name];
  }
  for (const Cell& cell : cells) {
    titles.push_back(cell.title);
    for (auto& [name, found] : rows) {
      const Results some = chosen(cell.results, [&](const TrialResult& one) {
        return one.hidden == std::vector<std::string>{name};
      });
      std::string weakest = some.empty() ? "" : "none";
      for (const Strength strength : kStrengths) {
        const Results of = chosen(
            some, [&](const TrialResult& one) { return one.strength == to_string(strength); });
        if (of.empty() || count(of, is_found) < 0.9 * static_cast<double>(of.size())) continue;
        weakest = fmt::format("{} ({})", to_string(strength), of.size());
        break;
      }
      found.push_back(weakest);
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

std::string scorecard(const Results& results) {
  if (results.empty()) return "No trials.\n";
  const std::vector<Cell> cells = cells_of(results);
  return fmt::format("{}\n{}\n## What was said\n\n{}\n{}\n{}\n## Failures\n\n{}",
                     fmt::format(kIntroduction, results.size()), summary_table(cells),
                     confusion_table(results), kAboutStrength, strength_table(cells),
                     failure_list(results));
}

}  // namespace flexarm::trials
