#include "measured/files/name_change.hpp"

#include "measured/files/column_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using testing::HasSubstr;

struct Changed {
  const char* name;
  ChangeKind kind;
  const char* mark;
  const char* rest;
};

TEST(NameChange, WhatANameDoesToItsQuantityIsFound) {
  using enum ChangeKind;
  for (const auto& [name, kind, mark, rest] : std::vector<Changed>{
           {"Angle*100", factor, "*100", "Angle"},
           {"theta^2", factor, "^2", "theta"},
           {"-Torque", sign, "-", "Torque"},
           {"\xe2\x88\x92\xce\xb8", sign, "-", "\xce\xb8"},
           {"(-1)*theta", sign, "(-1)*", "theta"},
           {"|tau|", function, "|", "tau"},
           {"abs(tau)", function, "abs", "tau"},
           {"\xce\x94\xce\xb8", function, "\xce\x94", "\xce\xb8"},
           {"1/theta", number, "1/", "theta"},
           {"1-tau", number, "1-", "tau"},
           {"180-theta", number, "180-", "theta"},
           {"theta+90", number, "+90", "theta"},
           {"theta-90", number, "-90", "theta"},
           {"Magnitude (dB) - 20", number, "- 20", "Magnitude (dB)"},
           {"Phase (deg) + 180", number, "+ 180", "Phase (deg)"},
           {"d(torque)/dt", derivative, "d/dt", "torque"},
           {"dtheta/dt", derivative, "d/dt", "theta"},
           {"theta'", derivative, "'", "theta"},
           {"theta.", derivative, ".", "theta"},
           {"\xce\xb8\xcc\x87", derivative, "\xcc\x87", "\xce\xb8"},
           {"theta''", function, "''", "theta"},
           {"\xce\xb8\xcc\x88", function, "\xcc\x88", "\xce\xb8"},
           {"\xce\xb8*", reference, "*", "\xce\xb8"},
       }) {
    const auto change = change_in(name);
    ASSERT_TRUE(change) << name;
    EXPECT_EQ(change->kind, kind) << name;
    EXPECT_EQ(change->mark, mark) << name;
    EXPECT_EQ(change->rest, rest) << name;
  }
}

TEST(NameChange, APlainNameHasNone) {
  for (const char* name : {"hub-angle",
                           "theta_1-filt",
                           "Time - Plot 0",
                           "Channel-1",
                           "x-axis",
                           "Torque - measured",
                           "hub angle 1/2",
                           "acc 2",
                           "Beschl.",
                           "acc.",
                           "'theta'",
                           "couple d'entr\xc3\xa9"
                           "e",
                           "strain@0.05",
                           "strain@1e-3",
                           "log 2024-03-01",
                           "encoder 0-360",
                           "theta (1)",
                           "data(:,1)",
                           "Beschleunigu\xcc\x88ng",
                           "--- torque ---",
                           "-",
                           "",
                           "Torque-01",
                           "Ch1/Ch2"}) {
    EXPECT_FALSE(change_in(name)) << name;
  }
}

TEST(NameChange, AColumnOfAChangedQuantityIsAskedAbout) {
  for (const char* name : {"-theta", "|theta|", "abs(theta)", "theta+90", "1/theta", "theta'",
                           "theta.", "\xce\xb8\xcc\x87", "\xce\xb8*", "log.-theta"}) {
    for (const char* unit : {"", "rad"}) {
      const auto guess = guess_columns(std::vector<ColumnLabel>{{name, unit}}, {});
      EXPECT_TRUE(guess.mappings.empty()) << name;
      ASSERT_EQ(guess.questions.size(), 1U) << name;
      EXPECT_THAT(guess.questions[0].sentence, HasSubstr("may be hub_angle, but its name has"))
          << name;
    }
  }
}

TEST(NameChange, AFirstDerivativeInRadPerSecondIsTheVelocity) {
  for (const char* name : {"theta'", "theta.", "\xce\xb8\xcc\x87", "d(theta)/dt", "hub_angle'"}) {
    const auto guess = guess_columns(std::vector<ColumnLabel>{{name, "deg/s"}}, {});
    EXPECT_EQ(guess.mappings.at("hub_velocity").unit, "deg/s") << name;
  }
  EXPECT_TRUE(guess_columns(std::vector<ColumnLabel>{{"theta''", "rad/s"}}, {}).mappings.empty());
}

}  // namespace
}  // namespace flexarm::measured
