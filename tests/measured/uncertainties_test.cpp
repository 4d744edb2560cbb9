#include "arm/uncertainties.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace flexarm::measured {
namespace {

using namespace arm;

using testing::HasSubstr;

const std::string kHub = "[hub]\ninertia = 5.86e-4\n";

std::string error_of(const std::string& toml) {
  try {
    parse_arm(toml, "a.toml", effects::vocabulary());
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Uncertainty, IsReadBesideItsNumberAndWrittenBack) {
  const Arm arm = parse_arm(
      "[beam]\nlength = 1\nlength_uncertainty = 0.002\nflexural_rigidity = 3.7\n"
      "flexural_rigidity_uncertainty = 0.03\nlinear_density = 0.16\n" +
          kHub,
      "a", effects::vocabulary());
  EXPECT_EQ(
      arm.relative_uncertainties,
      (std::map<std::string, double>{{"beam.flexural_rigidity", 0.03}, {"beam.length", 0.002}}));
  EXPECT_EQ(parse_arm(format_arm(arm), "again", effects::vocabulary()), arm);
}

TEST(Uncertainty, IsRefusedWithItsLineAndReason) {
  const std::string beam = "[beam]\nlength = 1\nflexural_rigidity = 3.7\nlinear_density = 0.16\n";
  EXPECT_THAT(error_of(beam + "length_uncertainty = 1.5\n" + kHub),
              HasSubstr("a.toml:5: beam.length_uncertainty = 1.5; must be above 0 and below 1"));
  EXPECT_THAT(error_of(beam + "length_uncertainty = 0\n" + kHub), HasSubstr("a.toml:5:"));
  EXPECT_THAT(error_of(beam + "length_uncertainty = \"3 %\"\n" + kHub), HasSubstr("a.toml:5:"));
  EXPECT_THAT(error_of(beam + "width_uncertainty = 0.1\n" + kHub),
              HasSubstr("a.toml:5: beam.width_uncertainty: relative to beam.width, which must be "
                        "given and above 0"));
  EXPECT_THAT(
      error_of(beam + "lenght_uncertainty = 0.1\n" + kHub),
      HasSubstr("unknown key (did you mean length_uncertainty?); allowed in [beam]: length, "));
  EXPECT_THAT(error_of(beam + "lenght_uncertainty = 0.1\n" + kHub),
              HasSubstr(", and each followed by _uncertainty"));
  EXPECT_THAT(
      error_of(beam +
               "width = 0.02\nthickness = 0.003\nyoungs_modulus = 8.2222e10\n"
               "youngs_modulus_uncertainty = 0.1\n" +
               kHub),
      HasSubstr("a.toml:8: beam.youngs_modulus_uncertainty: beam.flexural_rigidity is given too"));
}

TEST(Displaced, MultipliesUncertainNumbersAloneAndStaysValid) {
  Arm arm = paper_arm();  // with E, EI and a section
  arm.relative_uncertainties = {{"beam.flexural_rigidity", 0.03}, {"hub.inertia", 0.1}};
  const Arm made = with_deviations(arm, std::vector{1.0, -2.0});
  EXPECT_DOUBLE_EQ(made.beam.flexural_rigidity_N_m2(),
                   arm.beam.flexural_rigidity_N_m2() * std::exp(0.03));
  EXPECT_DOUBLE_EQ(made.hub.inertia_kg_m2, arm.hub.inertia_kg_m2 * std::exp(-0.2));
  EXPECT_EQ(made.beam.length_m, arm.beam.length_m);
  EXPECT_NO_THROW(require_valid(made));
  EXPECT_EQ(with_deviations(arm, {}), arm);
}

}  // namespace
}  // namespace flexarm::measured
