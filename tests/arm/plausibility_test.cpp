#include "arm/plausibility.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::arm {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Plausibility, HasNothingToSayOfRealArms) {
  EXPECT_THAT(plausibility_notes(paper_arm()), IsEmpty());
  Arm known_by_rigidity;
  known_by_rigidity.beam = Beam::from_rigidity(1.0, 1.0, 1.0);
  EXPECT_THAT(plausibility_notes(known_by_rigidity), IsEmpty());
  Arm rubber = paper_arm();
  rubber.beam = Beam::from_section(0.3, 0.02, 0.005, 910.0, 1.5e6);
  EXPECT_THAT(plausibility_notes(rubber), IsEmpty());
}

TEST(Plausibility, NamesNumbersInOtherUnits) {
  Arm arm = paper_arm();
  arm.beam = Beam::from_section(0.96, 0.019, 0.0032, 2.71, 71.1e9);  // g/cm^3
  EXPECT_THAT(plausibility_notes(arm), ElementsAre(HasSubstr("beam.density = 2.71 kg/m^3")));
  arm.beam = Beam::from_section(0.96, 0.019, 0.0032, 2710.0, 71100.0);  // N/mm^2
  EXPECT_THAT(plausibility_notes(arm),
              ElementsAre(AllOf(HasSubstr("beam.youngs_modulus = 7.11e+04 Pa"),
                                HasSubstr("1e+06 to 1.3e+12 Pa"))));
  arm.beam = Beam::from_section(960.0, 19.0, 3.2, 2710.0, 71.1e9);  // mm
  EXPECT_THAT(plausibility_notes(arm), ElementsAre(HasSubstr("beam.thickness = 3.2 m")));
}

TEST(Plausibility, NamesAMaterialThatFollowsFromTheSection) {
  Arm arm;
  arm.beam = Beam::from_rigidity(0.96, 3.7, 0.165);
  arm.beam.width_m = 0.019;
  arm.beam.thickness_m = 0.032;  // ten times
  EXPECT_THAT(plausibility_notes(arm), IsEmpty());
  arm.beam.given_linear_density_kg_per_m = 165.0;  // g/m
  EXPECT_THAT(plausibility_notes(arm),
              ElementsAre(HasSubstr("by linear_density, width and thickness")));
}

TEST(Plausibility, NamesABeamThatIsNotSlender) {
  Arm arm = paper_arm();
  arm.beam.length_m = 9.9 * *arm.beam.thickness_m;
  EXPECT_THAT(plausibility_notes(arm),
              ElementsAre(AllOf(HasSubstr("beam.length/beam.thickness = 9.9"), HasSubstr("10"))));
  arm.beam.length_m = 10.1 * *arm.beam.thickness_m;
  EXPECT_THAT(plausibility_notes(arm), IsEmpty());
}

}  // namespace
}  // namespace flexarm::arm
