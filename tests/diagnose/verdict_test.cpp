#include "diagnose/verdict.hpp"

#include "measured/files/text_file.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <string>

namespace flexarm::diagnose {
namespace {

enum class Effects { none, one };
enum class Residuals { noise, level_fails, validation_fails };

Explanation fitted(Effects effects, Residuals residuals, bool converged = true) {
  Explanation made;
  made.fit.converged = converged;
  if (effects == Effects::one) made.fit.candidate.effects = {{.effect = "payload_mass"}};
  if (residuals == Residuals::level_fails) made.estimation_test.level_p_value = 0.0;
  if (residuals == Residuals::validation_fails) made.validation_test.level_p_value = 0.0;
  return made;
}

const Explanation kWrong = fitted(Effects::none, Residuals::level_fails);

TEST(Verdict, IsAdequateWhereTheArmOfTheFileLeavesNoise) {
  const Explanation right = fitted(Effects::none, Residuals::noise);
  EXPECT_EQ(verdict_of(right, right), Verdict::adequate);
}

TEST(Verdict, IsExplainedWhereTheExtendedArmLeavesNoise) {
  EXPECT_EQ(verdict_of(fitted(Effects::one, Residuals::noise), kWrong), Verdict::explained);
}

TEST(Verdict, IsExplainedByUncertainNumbersAloneThatLeaveNoise) {
  EXPECT_EQ(verdict_of(fitted(Effects::none, Residuals::noise), kWrong), Verdict::explained);
}

TEST(Verdict, IsPartlyExplainedWhereEstimationOrValidationRunsFail) {
  for (const Residuals residuals : {Residuals::level_fails, Residuals::validation_fails}) {
    EXPECT_EQ(verdict_of(fitted(Effects::one, residuals), kWrong), Verdict::partly_explained);
  }
}

TEST(Verdict, OfAFitThatDidNotConvergeIsNeverExplained) {
  EXPECT_EQ(verdict_of(fitted(Effects::one, Residuals::noise, false), kWrong),
            Verdict::partly_explained);
  EXPECT_EQ(verdict_of(fitted(Effects::none, Residuals::noise, false), kWrong),
            Verdict::unexplained);
}

TEST(Verdict, OfANumberBeyondThreeStandardDeviationsIsNeverExplained) {
  const auto verdict = [](Effects effects, double deviation) {
    Explanation made = fitted(effects, Residuals::noise);
    made.fit.candidate.nuisances = {0.1, deviation};
    return verdict_of(made, kWrong);
  };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(verdict(Effects::one, 2.9 * sign), Verdict::explained);
    EXPECT_EQ(verdict(Effects::one, 3.1 * sign), Verdict::partly_explained);
    EXPECT_EQ(verdict(Effects::none, 3.1 * sign), Verdict::unexplained);
  }
}

TEST(Verdict, OfAnIncompleteSearchIsNeverExplained) {
  const auto verdict = [](Effects effects, const Explanation& as_filed) {
    return verdict_of(fitted(effects, Residuals::noise), as_filed, SearchState::incomplete);
  };
  EXPECT_EQ(verdict(Effects::one, kWrong), Verdict::partly_explained);
  EXPECT_EQ(verdict(Effects::none, kWrong), Verdict::unexplained);
  EXPECT_EQ(verdict(Effects::none, fitted(Effects::none, Residuals::noise)), Verdict::adequate);
}

TEST(Verdict, IsUnexplainedWithoutACause) {
  EXPECT_EQ(verdict_of(kWrong, kWrong), Verdict::unexplained);
}

TEST(Verdict, IsDefinedInTheDocumentsWordForWord) {
  constexpr std::size_t kLargest_bytes = 1 << 20;
  for (const char* name : {"glossary.md", "diagnosis.md", "formats.md"}) {
    const std::string text = measured::read_text_file(
        std::filesystem::path(FLEXARM_SOURCE_DIR) / "docs" / name, kLargest_bytes);
    for (const Verdict verdict : kVerdicts) {
      EXPECT_NE(text.find(definition_of(verdict)), std::string::npos)
          << name << ": " << to_string(verdict);
    }
  }
}

}  // namespace
}  // namespace flexarm::diagnose
