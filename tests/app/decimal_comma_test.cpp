#include "tests/app/flexarm_fixture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::testing_app {
namespace {

using DecimalComma = Flexarm;
using testing::HasSubstr;

/// A decimal comma is never read as something else, whatever takes the number.
TEST_F(DecimalComma, IsRefusedInOneLineThatShowsThePoint) {
  run({"new", "rig.toml"});
  write("log.csv", "t;V\n0,0;0,1\n0,1;0,2\n0,2;0,3\n");
  struct Case {
    std::vector<std::string> arguments;
    std::string meant;
  };
  for (const auto& [arguments, meant] : std::vector<Case>{
           {{"modes", "--payload-mass", "0,05"}, "0.05"},
           {{"compare", "--payload-mass", "0,5"}, "0.5"},
           {{"response", "--frequencies", "1,5"}, "1.5"},
           {{"sweep", "--over", "payload.mass=0,05"}, "0.05"},
           {{"sweep", "--over", "payload.mass=0:0,5:200"}, "0.5"},
           {{"modes", "--sensor", "strain@0,05"}, "strain@0.05"},
           {{"simulate", "--noise", "0,005"}, "0.005"},
           {{"simulate", "--noise-of", "hub_angle=0,001"}, "hub_angle=0.001"},
           {{"simulate", "--excitation", "random:rms=0,05,from=1,to=3"}, "rms=0.05"},
           {{"simulate", "--excitation", "stepped-sine:bands=2,5:3.5/11:13"}, "bands=2.5:3.5"},
           {{"simulate", "--reference", "step", "--controller", "kp=0,2,kd=0.1"}, "kp=0.2"},
           {{"modes", "--payload-inertia", "0,1"}, "0.1"},
           {{"modes", "--modes", "2,5"}, "2.5"},
           {{"import", "log.csv", "--times", "0,05:1"}, "0.05"},
           {{"import", "log.csv", "--column", "torque=V:V:8,925"}, "8.925"},
           {{"import", "log.csv", "--torque", "0,15*V"}, "0.15*V"},
       }) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.status, 2) << arguments.back();
    EXPECT_EQ(ended.output, "") << arguments.back();
    EXPECT_THAT(ended.errors, HasSubstr(meant));
    EXPECT_EQ(std::ranges::count(ended.errors, '\n'), 1) << ended.errors;
  }
}

TEST_F(DecimalComma, LeavesListsAlone) {
  const Ended three = run({"modes", "--modes", "1", "--payload-mass", "0,5,10"});
  EXPECT_EQ(three.status, 0) << three.errors;
  EXPECT_THAT(three.output, HasSubstr("Mp 10 kg"));
  const Ended two = run({"modes", "--modes", "1", "--payload-mass", "0,0.05"});
  EXPECT_EQ(two.status, 0) << two.errors;
  EXPECT_THAT(two.output, HasSubstr("Mp 0.05 kg"));
  const Ended repeated =
      run({"modes", "--modes", "1", "--payload-mass", "0", "--payload-mass", "5"});
  EXPECT_EQ(repeated.status, 0) << repeated.errors;
  EXPECT_THAT(repeated.output, HasSubstr("Mp 5 kg"));
}

TEST_F(DecimalComma, IsStatedInTheHelp) {
  EXPECT_THAT(run({"--help"}).output, HasSubstr("decimal point"));
}

}  // namespace
}  // namespace flexarm::testing_app
