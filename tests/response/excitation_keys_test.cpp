#include "response/excitation/excitation_keys.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace flexarm::response {
namespace {

using testing::ElementsAre;

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ExcitationKeys, EveryExcitationGoesByItsName) {
  EXPECT_THAT(excitation_names(), ElementsAre("bang-bang", "step", "random", "multisine", "chirp",
                                              "staircase", "prbs", "sine"));
  for (const auto& name_of_it : excitation_names()) {
    EXPECT_EQ(name(excitation_of(name_of_it)), name_of_it);
  }
}

TEST(ExcitationKeys, WhatIsReadIsWhatWasSet) {
  for (const auto& name_of_it : excitation_names()) {
    Excitation first = excitation_of(name_of_it);
    int number = 2;
    for (const auto& key : keys_of(first)) {
      set_key(first, key.name, key.name == "sweep" ? "linear" : std::to_string(++number));
    }
    Excitation second = excitation_of(name_of_it);
    number = 2;
    for (const auto& key : keys_of(first)) {
      EXPECT_EQ(key.value, key.name == "sweep" ? "linear" : std::to_string(++number)) << key.name;
      set_key(second, key.name, key.value);
    }
    EXPECT_EQ(describe("x", keys_of(first)), describe("x", keys_of(second)));
  }
}

TEST(ExcitationKeys, EachReachesItsMember) {
  Excitation excitation = excitation_of("chirp");
  set_key(excitation, "from", "0.25");
  set_key(excitation, "sweep", "linear");
  EXPECT_EQ(std::get<Chirp>(excitation).from_Hz, 0.25);
  EXPECT_EQ(std::get<Chirp>(excitation).sweep, Sweep::linear);
  excitation = excitation_of("multisine");
  set_key(excitation, "seed", "18446744073709551615");
  EXPECT_EQ(std::get<Multisine>(excitation).seed, ~std::uint64_t{0});
  EXPECT_EQ(describe("step", keys_of(Step{0.05, 0.1})), "step, amplitude 0.05 N m, start 0.1 s");
}

TEST(ExcitationKeys, MistakesAreOneLineWithARemedy) {
  EXPECT_EQ(error_of([] { excitation_of("chrip"); }),
            "excitation chrip: unknown (did you mean chirp?); allowed: bang-bang, step, random, "
            "multisine, chirp, staircase, prbs, sine");
  Excitation chirp = excitation_of("chirp");
  EXPECT_EQ(error_of([&] { set_key(chirp, "form", "1", {"id"}); }),
            "chirp.form: unknown (did you mean from?); allowed: amplitude, from, to, sweep, id");
  EXPECT_EQ(error_of([&] { set_key(chirp, "from", "1 Hz"); }),
            "chirp.from = 1 Hz: must be a number [Hz]");
  EXPECT_EQ(error_of([&] { set_key(chirp, "sweep", "up"); }),
            "chirp.sweep = up: must be linear or logarithmic");
  Excitation multisine = excitation_of("multisine");
  EXPECT_EQ(error_of([&] { set_key(multisine, "detection", "2.5"); }),
            "multisine.detection = 2.5: must be a whole number");
  EXPECT_EQ(error_of([&] { set_key(multisine, "seed", "-1"); }),
            "multisine.seed = -1: must be a whole number, 0 or more");
}

}  // namespace
}  // namespace flexarm::response
