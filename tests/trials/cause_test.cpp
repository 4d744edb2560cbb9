// Causes of the trials against the vocabulary of the product.
#include "tests/trials/cause.hpp"

#include "effects/registry/vocabulary.hpp"
#include "tests/trials/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace flexarm::trials {
namespace {

TEST(Causes, EveryEffectOfTheVocabularyHasATrial) {
  std::set<std::string> named;
  for (const auto& entry : effects::entries()) named.insert(entry.definition->name);
  std::set<std::string> hidden;
  for (const Cause& cause : causes()) {
    if (!cause.outside) hidden.insert(cause.name);
  }
  EXPECT_EQ(hidden, named);
}

TEST(Causes, OutsideTheVocabularyHaveAPort) {
  for (const Cause& cause : causes()) EXPECT_EQ(cause.port.empty(), !cause.outside) << cause.name;
}

TEST(Causes, NoneIsCalledOutsideTheVocabularyThatIsIn) {
  for (const Cause& cause : causes()) {
    if (!cause.outside) continue;
    EXPECT_EQ(effects::find(cause.name), nullptr) << cause.name;
  }
}

ShownIn shown_in(effects::Shows shows) {
  if (shows == effects::Shows::in_time) return ShownIn::time;
  return shows == effects::Shows::in_all ? ShownIn::all : ShownIn::time_and_frequency;
}

TEST(Causes, ShowWhereTheVocabularySaysSo) {
  for (const auto& entry : effects::entries()) {
    const Cause& cause = find_cause(entry.definition->name);
    EXPECT_EQ(cause.shown_in, shown_in(entry.shows)) << cause.name;
  }
}

TEST(Causes, HaveTheParametersOfTheVocabularyWithinTheirRanges) {
  for (const auto& entry : effects::entries()) {
    const Cause& cause = find_cause(entry.definition->name);
    for (const TrialArm& of : trial_arms()) {
      for (const double size : {cause.largest, cause.smallest_part * cause.largest}) {
        World world = with_hidden(World{of.arm}, of, cause, size, Chance{});
        arm::Effects effects = {effects::named(cause.name, world.hidden.front().parameters,
                                               world.hidden.front().sensor)};
        EXPECT_NO_THROW(arm::require_valid(effects)) << cause.name;
      }
    }
  }
}

/// A file of the library of the trials that includes what it is to judge; empty where none does.
std::string judge_of_its_own_case() {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(FLEXARM_SOURCE_DIR) / "tests/trials";
  for (const auto& one : fs::recursive_directory_iterator(folder)) {
    const std::string name = one.path().filename().string();
    const bool is_source = name.ends_with(".cpp") || name.ends_with(".hpp");
    // The tests are where the two meet.
    const bool is_test = name.ends_with("_test.cpp") || name.starts_with("with_effects.");
    // Families are names that answers are scored by.
    if (!is_source || is_test || name == "family_of.cpp") continue;
    std::ifstream file(one.path());
    for (std::string line; std::getline(file, line);) {
      for (const char* room : {"fem/", "effects/", "exact_tf/", "assumed_modes/", "response/",
                               "diagnose/", "arm/linear_arm.hpp"}) {
        if (line.starts_with(std::string("#include \"") + room)) return name + ": " + line;
      }
    }
  }
  return "";
}

TEST(Causes, AndTheSimulatorShareNothingWithWhatTheyJudge) {
  EXPECT_EQ(judge_of_its_own_case(), "");
}

TEST(Causes, AreFoundByName) {
  EXPECT_EQ(find_cause("tuned_mass").name, "tuned_mass");
  EXPECT_ANY_THROW(find_cause("tuned_mas"));
}

}  // namespace
}  // namespace flexarm::trials
