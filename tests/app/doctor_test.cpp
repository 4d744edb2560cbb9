#include "tests/app/flexarm_fixture.hpp"
#include "tests/environment_variable.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

using Doctor = Flexarm;

TEST_F(Doctor, TriesWhatFlexarmNeeds) {
  const Ended ended = run({"doctor", "--json", "doctor.json"});
  EXPECT_EQ(ended.status, 0) << ended.output;
  EXPECT_EQ(ended.errors, "");
  EXPECT_THAT(ended.output, AllOf(StartsWith("Works: "), HasSubstr("flexarm " FLEXARM_VERSION),
                                  HasSubstr("Eigen "), HasSubstr("\nnext: ")));
  const Json document = Json::parse(text_of("doctor.json"));
  EXPECT_TRUE(document["works"]);
  int formulations = 0;
  for (const auto& check : document["checks"]) {
    EXPECT_NE(check["result"], "failed") << check.dump();
    const std::string name = check["name"];
    if (name != "exact_tf" && name != "fem" && name != "assumed_modes") continue;
    ++formulations;
    EXPECT_GT(check["time_s"], 0.0);
    EXPECT_THAT(check["found"].get<std::string>(), StartsWith("3 poles of the paper's arm"));
  }
  EXPECT_EQ(formulations, 3);
}

TEST_F(Doctor, SaysWhatToDoWithoutGnuplot) {
  const testing_environment::EnvironmentVariable path("PATH", folder_.c_str());
  const Ended ended = run({"doctor", "--json", "doctor.json"});
  EXPECT_EQ(ended.status, 1);
  EXPECT_THAT(ended.output,
              AllOf(StartsWith("FAILED: "), HasSubstr("apt-get install gnuplot-nox")));
  const Json document = Json::parse(text_of("doctor.json"));
  EXPECT_FALSE(document["works"]);
}

}  // namespace
}  // namespace flexarm::testing_app
