#include "arm/sensor.hpp"

#include "arm/arm.hpp"
#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace flexarm::arm {
namespace {

using testing::HasSubstr;

TEST(Sensor, NamesAreReadAndWrittenBack) {
  for (const char* name : {"hub_angle", "hub_velocity", "tip_acceleration", "tip_displacement",
                           "tip_deflection", "strain@0.05", "strain@0"}) {
    EXPECT_EQ(to_string(parse_sensor(name)), name);
  }
}

TEST(Sensor, ATypoGetsTheNameThatWasMeant) {
  const auto meant = [](const char* typed) -> std::string {
    try {
      parse_sensor(typed);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(meant("hub_angel"), HasSubstr("did you mean hub_angle?"));
  EXPECT_THAT(meant("strian@0.05"), HasSubstr("did you mean strain@X?"));
  EXPECT_THAT(meant("stain@0.123456789"), HasSubstr("did you mean strain@X?"));
  EXPECT_THAT(meant("tip_acceleration@1"), HasSubstr("did you mean tip_acceleration?"));
  EXPECT_THROW(parse_sensor("strain@five"), InputError);
  EXPECT_THROW(parse_sensor("strain@nan"), InputError);
}

TEST(Sensor, StrainNeedsAPlaceOnTheBeamAndAThickness) {
  Arm arm = paper_arm();
  EXPECT_NO_THROW(require_valid(parse_sensor("strain@0.96"), arm));
  EXPECT_THROW(require_valid(parse_sensor("strain@1.2"), arm), InputError);
  arm.beam = Beam::from_rigidity(0.96, 3.7, 0.16);
  EXPECT_THROW(require_valid(parse_sensor("strain@0.05"), arm), InputError);
}

}  // namespace
}  // namespace flexarm::arm
