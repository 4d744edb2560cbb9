#include "tests/trials/dirt_table.hpp"

#include <algorithm>
#include <map>

namespace flexarm::trials {

namespace {

/// Hidden causes that are named, or a class of few with one of them.
std::size_t found_of(const TrialResult& one) {
  if (is_found(one)) return one.hidden.size();
  return static_cast<std::size_t>(std::ranges::count_if(one.hidden, [&](const std::string& name) {
    return std::ranges::find(one.named, name) != one.named.end();
  }));
}

bool names_wrong(const TrialResult& one) {
  return std::ranges::any_of(one.named,
                             [&](const std::string& name) {
                               return std::ranges::find(one.hidden, name) == one.hidden.end();
                             }) &&
         !is_found(one);
}

std::vector<std::string> dirt_cells(const Results& all) {
  const auto of = [&](const Choice& group, const Choice& choice) {
    const Results some = chosen(all, group);
    return part(count(some, choice), static_cast<int>(some.size()));
  };
  const auto nothing = [](const TrialResult& one) { return has_effects(one, 0); };
  const auto single = [](const TrialResult& one) { return has_effects(one, 1); };
  const auto three = [](const TrialResult& one) { return has_effects(one, 3); };
  const auto outside = [](const TrialResult& one) { return one.outside; };
  const auto has_name = [](const TrialResult& one) { return one.dirt_answer != DirtAnswer::none; };
  const auto is = [](Outcome outcome) {
    return [outcome](const TrialResult& one) { return one.outcome == outcome; };
  };
  return {of(nothing, is(Outcome::false_alarm)),
          of(has_name, [](const TrialResult& one) { return one.dirt_answer == DirtAnswer::named; }),
          of(single, is_found),
          of(single, is(Outcome::partly)),
          of(single, is(Outcome::wrong)),
          of(three, [](const TrialResult& one) { return found_of(one) == 3; }),
          of(three, [](const TrialResult& one) { return found_of(one) >= 2; }),
          of(three, names_wrong),
          of(outside, is(Outcome::recognised))};
}

}  // namespace

std::string dirt_table(const Results& results) {
  if (results.empty()) return "No trials.\n";
  std::map<std::string, Results> by_dirt;
  for (const TrialResult& one : results) by_dirt[one.dirt].push_back(one);
  std::string text =
      header("dirt", {"no effect present: physical cause identified", "dirt identified",
                      "one effect: identified, or in a class of at most three",
                      "identified with additional wrong effects", "another effect identified",
                      "three effects: all identified", "two or more identified", "a wrong effect",
                      "effect outside the library: reported as unexplained"});
  for (const auto& [name, some] : by_dirt) text += row(name, dirt_cells(some));
  return text + row("all", dirt_cells(results));
}

}  // namespace flexarm::trials
