#include "arm/beam.hpp"

#include "arm/arm.hpp"
#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace flexarm::arm {
namespace {

using testing::HasSubstr;

TEST(Beam, SectionOfThePaperGivesItsRigidityAndDensity) {
  const Beam beam = paper_arm().beam;
  // Table 1: E = 7.11e10 Pa, I = 5.1924e-11 m^4; 2710 kg/m^3 on 19.008 mm by 3.2004 mm.
  EXPECT_DOUBLE_EQ(beam.flexural_rigidity_N_m2(), 3.6917964);
  EXPECT_DOUBLE_EQ(beam.linear_density_kg_per_m(), 0.164857980672);
}

TEST(Beam, TwoDescriptionsThatDisagreeAreRefused) {
  Beam beam = paper_arm().beam;
  EXPECT_NO_THROW(require_valid(beam));
  beam.given_flexural_rigidity_N_m2 = 3.8;
  try {
    require_valid(beam);
    FAIL() << "a rigidity 3 % off the section's was accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("beam.flexural_rigidity = 3.8 N m^2 differs"));
  }
}

TEST(Beam, ABeamNotKnownWellEnoughNamesWhatIsMissing) {
  Beam beam;
  beam.length_m = 1.0;
  EXPECT_THROW(require_valid(beam), InputError);
}

TEST(Arm, NegativeAndNonFiniteValuesAreRefusedByKey) {
  Arm arm = paper_arm();
  arm.payload.mass_kg = -0.1;
  try {
    require_valid(arm);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "payload.mass = -0.1 kg: must be a finite number, 0 or more");
  }
  arm = paper_arm();
  arm.beam.length_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_valid(arm), InputError);
}

}  // namespace
}  // namespace flexarm::arm
