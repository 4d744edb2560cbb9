#include "export/fmu/si_unit.hpp"

#include "arm/arm_keys.hpp"
#include "arm/sensor.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace flexarm::fmu {
namespace {

using Exponents = std::map<std::string, int>;

TEST(SiUnit, IsReadAsAProductOfPowers) {
  EXPECT_EQ(parse_si_unit("N m s/rad")->exponents,
            (Exponents{{"kg", 1}, {"m", 2}, {"s", -1}, {"rad", -1}}));
  EXPECT_EQ(parse_si_unit("N m/rad^3")->exponents,
            (Exponents{{"kg", 1}, {"m", 2}, {"s", -2}, {"rad", -3}}));
  EXPECT_EQ(parse_si_unit("N s^2/m^3")->exponents, (Exponents{{"kg", 1}, {"m", -2}}));
  EXPECT_EQ(parse_si_unit("1")->exponents, Exponents{});
  EXPECT_EQ(parse_si_unit("m/m")->exponents, Exponents{});
  EXPECT_DOUBLE_EQ(parse_si_unit("1/rev")->factor, 0.5 / std::numbers::pi);
}

TEST(SiUnit, OfEveryNumberAndEffectIsKnown) {
  for (const auto& key : arm::arm_keys()) EXPECT_TRUE(parse_si_unit(key.unit)) << key.unit;
  for (const auto& definition : effects::vocabulary()) {
    for (const auto& parameter : definition->parameters) {
      const std::string unit = effects::unit_of(parameter, "hub_angle");
      EXPECT_TRUE(parse_si_unit(unit)) << definition->name << " " << unit;
    }
  }
}

TEST(SiUnit, OfAnotherTextIsNone) {
  for (const char* const text : {"", "furlong", "N m/rad/s", "m^", "m^x", "N  m", "/s"}) {
    EXPECT_FALSE(parse_si_unit(text)) << text;
  }
}

}  // namespace
}  // namespace flexarm::fmu
