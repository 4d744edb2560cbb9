#include "tests/trials/scorecard.hpp"

#include "arm/input_error.hpp"
#include "tests/trials/calibration.hpp"
#include "tests/trials/clopper_pearson.hpp"
#include "tests/trials/dirt_table.hpp"
#include "tests/trials/rig_table.hpp"
#include "tests/trials/ruler_table.hpp"
#include "tests/trials/scorecard_parts.hpp"

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

Version: {}.

{} simulated experiments on three arms: aluminium, steel, and a sandwich with low shear stiffness.
{} of them are recorded with dirt and stand in a section of their own. The arm file given to
`flexarm diagnose` lacks one to three effects, or none. `scripts/trials`
generates the data with an independent simulator (`tests/trials`): its own finite elements,
Newmark's method, and each effect implemented anew. It gives each diagnosis four
minutes of one core (`--time-limit`), after which that answers with the best so far.

Columns: kind of data and noise-to-signal ratio. For poles and zeros the standard deviation of the
frequencies is a fifth of that ratio, that of the damping ratios ten times. The strength of an
effect is the NRMSE of a simulation without it: weak 5 %, middle 15 %, strong 50 %; a tenth of these
for poles and zeros. If no physically possible value gives that strength, the largest possible value
is used.

An equivalence class counts as correct if it has at most three members. A wrong effect beside the
verdict `partly_explained` counts as wrong. So does an effect with a probability above 0.5 if the
true one is outside the library. Bounds are Clopper-Pearson, one-sided, 95 %.
)";
constexpr const char* kAboutSmallest =
    R"(## Smallest single effect identified in 90 % of trials

Strength as a multiple of the noise floor: the smallest strength from which a single effect of the
library, or its equivalence class of at most three, is identified in at least 90 % of the trials, at
this and every larger strength. "<": no smaller strength was tested. In parentheses: number of
trials at that strength. "few": fewer than 20 trials, no statement. For this table, faint effects
with an NRMSE of 1.5 % are simulated in addition. They are not part of the tables above.

)";

constexpr const char* kAboutRuler =
    R"(## Wrong geometry

A steel ruler, 0.5 m x 30 mm x 1 mm, whose arm file states a length or thickness that is wrong by
the factor exp(+-size).

)";

constexpr const char* kAboutDirt =
    R"(## Recordings with dirt

The same experiments as laboratories record them, one kind of dirt each (`tests/trials/dirt`). None
of these trials is part of the tables above. Where the dirt is itself an effect of the library, it
is judged apart, and a physical cause is one beside it. A wrong effect: one that is neither present
nor the dirt.

)";

constexpr const char* kAboutRig =
    R"(## Rigs

Five to eight effects at once, each with an NRMSE of 2 to 30 % by itself: viscous and Coulomb
friction, hub inertia and flexural rigidity, and one to four of structural damping, torque gain and
bias, actuator lag, root compliance, a late sensor and a wrong sensor gain. Two sensors, two
estimation runs and one validation run. The noise is 1 % of the signal; the hub angle is in counts
of an encoder. None of these trials is part of the tables above.

Leading: the three effects whose absence costs most, as NRMSE of a simulation with all the others.
Such an effect counts as identified by its name, by one of its family, or by an equivalence class of
at most three with it, on the same sensor. A wrong effect is none of these for any effect present.
The floor is the NRMSE of noise and counts on the validation run.

)";

constexpr const char* kAboutReliability =
    R"(Here an effect is correct only if it is the one present; members of its class do not count.

)";

bool is_right(const TrialResult& one) {
  return is_found(one) || one.outcome == Outcome::quiet || one.outcome == Outcome::recognised;
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

/// Those of `cells_of`, then the kinds together where there are several.
std::vector<Cell> cells_and_totals_of(const Results& results) {
  std::vector<Cell> cells = cells_of(results);
  if (cells.size() == 1) return cells;
  std::map<double, Results> by_noise;
  for (const auto& one : results) by_noise[one.noise].push_back(one);
  for (auto& [noise, some] : by_noise) {
    cells.push_back({fmt::format("all {:g} %", 100.0 * noise), std::move(some)});
  }
  cells.push_back({"all", results});
  return cells;
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
    // A row without trials says nothing.
    if (std::ranges::count(values, "-") < std::ssize(values)) text += row(name, values);
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
  of_effects("one effect: identified", 1, is(Outcome::exact));
  of_effects("one effect: identified, or in an equivalence class of at most three", 1, is_found);
  for (const Strength strength : kStrengths) {
    if (strength == Strength::faint) continue;
    add(fmt::format("... {}", to_string(strength)), [strength](const Results& all) {
      const Results some = chosen(all, [&](const TrialResult& one) {
        return has_effects(one, 1) && one.strength == to_string(strength);
      });
      return part(count(some, is_found), static_cast<int>(some.size()));
    });
  }
  of_effects("one effect: identified with additional wrong effects", 1, is(Outcome::partly));
  of_effects("one effect: another effect identified", 1, is(Outcome::wrong));
  of_effects("one effect: not detected (adequate)", 1, is(Outcome::missed));
  of_effects("one effect: no effect identified (unexplained)", 1, is(Outcome::abstained));
  of_effects("two effects: both identified", 2, is_found);
  of_effects("two effects: one identified", 2, is(Outcome::partly));
  of_effects("two effects: another effect identified", 2, is(Outcome::wrong));
  const auto of_nothing = [&](const std::string& name, Outcome outcome) {
    of_effects(name, 0, is(outcome));
    add("... upper 95 % bound", [outcome](const Results& all) {
      const auto some = chosen(all, [](const TrialResult& one) { return has_effects(one, 0); });
      if (some.empty()) return std::string("-");
      const double bound = upper_bound_95(count(some, outcome), static_cast<int>(some.size()));
      return fmt::format("{:.1f} %", 100.0 * bound);
    });
  };
  of_nothing("no effect present: effect identified (false alarm)", Outcome::false_alarm);
  of_nothing("no effect present: verdict not adequate", Outcome::doubted);
  add("effect outside the library: reported as unexplained", [](const Results& all) {
    const Results some = chosen(all, [](const auto& one) { return one.outside; });
    return part(count(some, Outcome::recognised), static_cast<int>(some.size()));
  });
  add("effect outside the library: another effect identified, or explained",
      [](const Results& all) {
        const Results some = chosen(all, [](const auto& one) { return one.outside; });
        return part(count(some, Outcome::wrong) + count(some, Outcome::mistaken),
                    static_cast<int>(some.size()));
      });
  add("effect outside the library: port right", [](const Results& all) {
    const auto answered = [](const auto& one) { return one.port_answer != PortAnswer::none; };
    const Results some = chosen(all, answered);
    return part(count(some, [](const auto& one) { return one.port_answer == PortAnswer::right; }),
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
  add("validation NRMSE at most 1.1 x noise floor", noise_reached);
  add("no answer", [](const Results& all) {
    return part(count(all, Outcome::no_answer), static_cast<int>(all.size()));
  });
  const auto add_times = [&add](std::string_view what, double TrialResult::*time) {
    add(fmt::format("{}: median, maximum [s]", what), [time](const Results& all) {
      std::vector<double> times;
      for (const auto& one : all) times.push_back(one.*time);
      if (times.empty()) return std::string("-");
      return fmt::format("{:.1f}, {:.1f}", median(times), std::ranges::max(times));
    });
  };
  add_times("wall time, one trial per core", &TrialResult::time_s);
  add_times("processor time", &TrialResult::processor_s);
  return text;
}

/// What was named where one cause was hidden, most often first.
std::string confusion_table(const Results& results) {
  std::map<std::string, std::map<std::string, int>> named;
  for (const auto& one : results) {
    if (one.hidden.size() > 1) continue;
    const std::string hidden = one.hidden.empty() ? "no effect" : one.hidden.front();
    ++named[hidden][one.named.empty() ? one.verdict : fmt::format("{}", fmt::join(one.named, "+"))];
  }
  std::string text = "| effect present | result (count) |\n| --- | --- |\n";
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
  return header("", titles) +
         row("identified, or in an equivalence class of at most three", found) +
         row("another effect identified", wrong) + row("no effect identified", silent);
}

/// Trials behind a statement on 90 % of them.
constexpr std::size_t kEnoughTrials = 20;

/// The least strength at which causes are found, over the noise: "< 1.7 (20)"; "none"; "few (2)".
std::string smallest_found(const Results& of_one_cause) {
  std::string smallest = "none";
  for (auto strength = kStrengths.rbegin(); strength != kStrengths.rend(); ++strength) {
    const Results of = chosen(
        of_one_cause, [&](const TrialResult& one) { return one.strength == to_string(*strength); });
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

std::string smallest_table(const Results& results) {
  std::vector<std::string> titles;
  std::vector<std::string> found;
  for (const Cell& cell : cells_of(results)) {
    titles.push_back(cell.title);
    found.push_back(smallest_found(
        chosen(cell.results, [](const TrialResult& one) { return has_effects(one, 1); })));
  }
  return header("", titles) + row("smallest strength", found);
}

std::string failure_list(const Results& results) {
  std::string text;
  for (const auto& one : results) {
    const bool left_over = is_found(one) && one.verdict != "explained";
    if (is_right(one) && !left_over) continue;
    text += fmt::format("- {} ({}): {}, {}; NRMSE {:.2g}, extended arm {:.2g}; {}\n", one.id,
                        one.arm, to_string(one.outcome), one.verdict, one.before, one.after,
                        one.values.empty() ? "no effect identified" : one.values);
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
  return fmt::format("{} ({} source tree)", version, changed ? "modified" : "clean");
}

}  // namespace

void require_one_version(const Results& results, const std::string& version) {
  const auto other =
      std::ranges::find_if(results, [&](const auto& one) { return one.version != version; });
  if (other == results.end()) return;
  throw arm::InputError(
      fmt::format("{}: result of flexarm {}, not of {}; use one results file per version",
                  other->id, other->version, version));
}

std::string scorecard(const Results& results) {
  if (results.empty()) return "No trials.\n";
  require_one_version(results, results.front().version);
  const Results clean =
      chosen(results, [](const TrialResult& one) { return one.dirt == "-" && !one.rig; });
  const Results dirty = chosen(results, [](const TrialResult& one) { return one.dirt != "-"; });
  const Results rigs = chosen(results, [](const TrialResult& one) { return one.rig.has_value(); });
  const Results ruler = chosen(clean, is_ruler);
  const Results drawn = chosen(clean, [](const TrialResult& one) { return !is_ruler(one); });
  const Results faint = chosen(drawn, is_faint);
  const Results judged = chosen(drawn, [](const TrialResult& one) { return !is_faint(one); });
  const std::string probabilities = "Stated probabilities and intervals\n\n";
  const auto reliability = [](const Results& some) {
    return kAboutReliability + reliability_table(some) + "\n" + coverage_table(some);
  };
  std::string text =
      fmt::format(kIntroduction, described(results.front().version), results.size(), dirty.size());
  if (!judged.empty()) {
    text += "\n" + summary_table(cells_and_totals_of(judged));
    text += "\n## Results by effect\n\n" + confusion_table(judged);
    text += "\n## " + probabilities + reliability(judged);
  }
  if (!ruler.empty()) text += "\n" + (kAboutRuler + ruler_table(ruler));
  const bool has_single =
      std::ranges::any_of(drawn, [](const TrialResult& one) { return has_effects(one, 1); });
  if (has_single) text += "\n" + (kAboutSmallest + smallest_table(drawn));
  if (!faint.empty()) text += "\nFaint effects:\n\n" + faint_table(faint);
  if (!dirty.empty()) {
    text += "\n" + (kAboutDirt + dirt_table(dirty));
    text += "\n### " + probabilities + reliability(dirty);
  }
  if (!rigs.empty()) text += "\n" + (kAboutRig + rig_table(rigs));
  text += "\n## Failures\n";
  if (!judged.empty()) text += "\n" + failure_list(judged);
  if (!dirty.empty()) text += "\n### With dirt\n\n" + failure_list(dirty);
  return text;
}

}  // namespace flexarm::trials
