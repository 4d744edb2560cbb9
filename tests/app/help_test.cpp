#include "report/utf8_text.hpp"
#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Help = Flexarm;

const std::vector<std::string> kCommands = {
    "doctor", "new",      "compare",  "modes", "response", "simulate", "sweep",
    "import", "identify", "diagnose", "plan",  "effects",  "paper",    "completion"};

TEST_F(Help, FitsIn80Columns) {
  std::vector<std::string> texts = {run({"--help"}).output};
  for (const auto& command : kCommands) texts.push_back(run({command, "--help"}).output);
  for (const auto& text : texts) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      EXPECT_LE(report::display_width(line), 80U) << line;
    }
  }
}

TEST_F(Help, GroupsTheCommandsInTheOrderOfAFirstSession) {
  const std::string text = run({"--help"}).output;
  std::size_t before = 0;
  for (const auto& command : kCommands) {
    const auto at = text.find("\n  " + command + " ");
    ASSERT_NE(at, std::string::npos) << command;
    EXPECT_GT(at, before) << command;
    before = at;
  }
  EXPECT_THAT(text, AllOf(HasSubstr("\nFirst steps:\n"), HasSubstr("\nMeasured data:\n")));
}

TEST_F(Help, HasGroupsUnitsAndDefaults) {
  const std::string text = run({"compare", "--help"}).output;
  EXPECT_THAT(text, AllOf(HasSubstr("Usage: flexarm compare [OPTIONS] [ARM]\n"),
                          HasSubstr("\nComparison:\n"), HasSubstr("\nArm:\n"),
                          HasSubstr("\nOutput:\n"), HasSubstr("[default: 10]"),
                          HasSubstr("[kg m^2]"), HasSubstr("\n  -v, --verbose ")));
}

TEST_F(Help, AListIsOneAndOtherOptionsAreRepeated) {
  const std::string simulate = run({"simulate", "--help"}).output;
  EXPECT_THAT(simulate,
              AllOf(HasSubstr("  --torque FILE  "), HasSubstr("  --reference TEXT  "),
                    HasSubstr("  --excitation TEXT  "), HasSubstr("  --sensor NAME,...")));
  EXPECT_THAT(run({"import", "--help"}).output,
              AllOf(HasSubstr("  --run TEXT  "), HasSubstr("  --validation TEXT  ")));
  // What the help says is a list is read as one.
  EXPECT_THAT(run({"identify", "--help"}).output, HasSubstr("  --run TEXT,..."));
  ASSERT_EQ(run({"simulate", "--duration", "1", "--period", "0.002", "--excitation", "step:id=a",
                 "--excitation", "prbs:id=b", "--out", "out"})
                .status,
            0);
  EXPECT_THAT(run({"identify", "out/measurement.toml", "--run", "a,c"}).errors,
              AllOf(HasSubstr("c"), testing::Not(HasSubstr("a,c"))));
  EXPECT_EQ(run({"simulate", "--torque", "out/a.csv", "--torque", "out/b.csv"}).status, 0);
}

TEST_F(Help, OfDiagnoseDefinesTheVerdicts) {
  EXPECT_THAT(run({"diagnose", "--help"}).output,
              AllOf(HasSubstr("\nVerdicts:\n"), HasSubstr("\n  partly_explained  Effects are")));
}

}  // namespace
}  // namespace flexarm::testing_app
