#include "arm/input_error.hpp"
#include "response/time/stepped_sine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace flexarm::response {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Keys = std::vector<std::pair<std::string, std::string>>;

std::string error_of(const Keys& keys) {
  try {
    frequencies_Hz(stepped_sine_of(keys, {"id"}));
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SteppedSineKeys, AreReadAndToldAlike) {
  const auto sine = stepped_sine_of({{"amplitude", "0.02"},
                                     {"offset", "-0.01"},
                                     {"bands", "2.5:3.5/11:13"},
                                     {"points", "5"},
                                     {"settle", "2.5"},
                                     {"cycles", "9"}});
  EXPECT_EQ(describe(kSteppedSine, keys_of(sine)),
            "stepped-sine, amplitude 0.02 N m, offset -0.01 N m, bands 2.5:3.5/11:13 Hz, points 5, "
            "settle 2.5 s, cycles 9");
  Keys told;
  for (const auto& key : keys_of(sine)) told.emplace_back(key.name, key.value);
  EXPECT_EQ(describe(kSteppedSine, keys_of(stepped_sine_of(told))),
            describe(kSteppedSine, keys_of(sine)));
  EXPECT_EQ(describe(kSteppedSine, keys_of(stepped_sine_of({{"from", "2"}, {"to", "3"}}))),
            "stepped-sine, amplitude 0.05 N m, offset 0 N m, bands 2:3 Hz, step 0.1 Hz, settle "
            "steady, cycles 4");
}

TEST(SteppedSineFrequencies, AscendOverAllBandsInDecimals) {
  EXPECT_THAT(frequencies_Hz(stepped_sine_of({{"bands", "1.1:1.4/5:5/7:7.25"}, {"step", "0.1"}})),
              ElementsAre(1.1, 1.2, 1.3, 1.4, 5.0, 7.0, 7.1, 7.2));
  EXPECT_THAT(frequencies_Hz(stepped_sine_of({{"from", "1"}, {"to", "2"}, {"points", "5"}})),
              ElementsAre(1.0, 1.25, 1.5, 1.75, 2.0));
  const auto fine =
      frequencies_Hz(stepped_sine_of({{"from", "11"}, {"to", "13"}, {"step", "0.001"}}));
  ASSERT_EQ(fine.size(), 2001U);
  EXPECT_EQ(fine[862], 11.862);
  EXPECT_EQ(fine.back(), 13.0);
}

TEST(SteppedSineKeys, RefuseWhatIsNoneOrDoesNotFit) {
  const std::vector<std::pair<Keys, const char*>> cases = {
      {{{"amplitud", "1"}}, "stepped-sine.amplitud: unknown (did you mean amplitude?); allowed: "},
      {{{"amplitude", "x"}}, "stepped-sine.amplitude = x: must be a number [N m]"},
      {{{"amplitude", "-1"}}, "stepped-sine.amplitude = -1 N m: must be a finite number above 0"},
      {{{"bands", "3"}}, "stepped-sine.bands = 3: must be FROM:TO/FROM:TO/... [Hz]"},
      {{{"bands", "3:4/"}}, "stepped-sine.bands = 3:4/: must be FROM:TO"},
      {{{"bands", "3:4/2:3"}}, "stepped-sine.bands = 2 Hz: must be above 4, the end of the previous band"},
      {{{"bands", "3:4"}, {"from", "1"}}, "stepped-sine.bands: not together with from or to"},
      {{{"points", "3"}, {"step", "1"}}, "stepped-sine.points: not together with step"},
      {{{"from", "0"}}, "stepped-sine.from = 0 Hz: must be a finite number above 0"},
      {{{"from", "3"}, {"to", "2"}}, "stepped-sine.to = 2 Hz: must be a finite number, 3 or more"},
      {{{"step", "0"}}, "stepped-sine.step = 0 Hz: must be"},
      {{{"step", "1e-9"}}, "more than 100000 frequencies"},
      {{{"points", "1"}}, "stepped-sine.points = 1: must be from 2 to"},
      {{{"cycles", "2"}}, "stepped-sine.cycles = 2: must be from 3 to"},
      {{{"cycles", "2.5"}}, "stepped-sine.cycles = 2.5: must be a whole number"},
      {{{"settle", "soon"}}, "stepped-sine.settle = soon: must be a number [s], or steady"},
      {{{"settle", "-1"}}, "stepped-sine.settle = -1 s: must be a finite number, 0 or more"},
      {{{"settle", "1e9"}}, "stepped-sine.settle = 1000000000 s: must be 200000 s, 1e+07 periods"},
      {{{"from", "nan"}}, "stepped-sine.from = nan Hz: must be a finite number above 0"},
  };
  for (const auto& [keys, message] : cases) EXPECT_THAT(error_of(keys), HasSubstr(message));
}

}  // namespace
}  // namespace flexarm::response
