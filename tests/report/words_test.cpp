#include "report/words.hpp"

#include "arm/arm_keys.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace flexarm::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Words, AnIdIsSaidAsAReaderWouldSayIt) {
  EXPECT_EQ(in_words("hub_angle"), "hub angle");
  EXPECT_EQ(in_words("strain@0.05"), "strain at 0.05 m");
  EXPECT_EQ(in_words("coulomb_friction"), "Coulomb friction");
  EXPECT_EQ(in_words("stribeck_friction"), "Stribeck friction");
  EXPECT_EQ(in_words("back_emf"), "back-EMF");
  EXPECT_EQ(in_words("exact_tf"), "exact transfer function");
  EXPECT_EQ(in_words("fem"), "finite elements");
  EXPECT_EQ(in_words("assumed_modes"), "assumed modes");
  EXPECT_EQ(in_words("rigid_hub"), "rigid hub");
}

TEST(Words, AParameterIsNamedWithItsTableOrEffect) {
  EXPECT_EQ(in_words("payload.mass"), "payload mass");
  EXPECT_EQ(in_words("beam.youngs_modulus"), "beam Young's modulus");
  EXPECT_EQ(in_words("damping.kelvin_voigt"), "Kelvin-Voigt damping");
  EXPECT_EQ(in_words("payload_mass_ratio"), "payload mass ratio");
  EXPECT_EQ(in_words("effects.root_compliance.stiffness"), "root compliance stiffness");
  EXPECT_EQ(in_words("effects.back_emf.constant"), "back-EMF constant");
}

TEST(Words, IdsWithinATextAreReplacedAndTheRestStays) {
  EXPECT_EQ(in_words("sensor_delay on hub_angle"), "sensor delay on hub angle");
  EXPECT_EQ(in_words("coulomb_friction + hub_inertia"), "Coulomb friction + hub inertia");
  EXPECT_EQ(in_words("fem, cubic elements"), "finite elements, cubic elements");
  EXPECT_EQ(in_words("sensor hub_angle, strain@0.05, 5.25"),
            "sensor hub angle, strain at 0.05 m, 5.25");
  EXPECT_EQ(in_words("0.05 and 1e-5"), "0.05 and 1e-5");
  EXPECT_EQ(in_words("strain@1e-05"), "strain at 1e-05 m");
  EXPECT_EQ(in_words("eigenfrequency ω₁ @ −3"), "eigenfrequency ω₁ @ −3");
  EXPECT_EQ(in_words(""), "");
}

TEST(Words, NoEffectAndNoKeyOfTheArmFileKeepsAnUnderscore) {
  for (const auto& effect : effects::vocabulary()) {
    EXPECT_THAT(in_words(effect->name), Not(HasSubstr("_")));
    for (const auto& parameter : effect->parameters) {
      const std::string words = in_words("effects." + effect->name + "." + parameter.name);
      EXPECT_EQ(words.find_first_of("_.@"), std::string::npos) << words;
      EXPECT_THAT(words, Not(HasSubstr("effects")));
      EXPECT_EQ(unit_text(parameter.unit).find('^'), std::string::npos) << parameter.unit;
    }
  }
  for (const auto& key : arm::arm_keys()) {
    EXPECT_EQ(in_words(key.name()).find_first_of("_.@"), std::string::npos) << key.name();
  }
}

TEST(Words, PowersOfUnitsAreSuperscripts) {
  EXPECT_EQ(unit_text("m/s^2"), "m/s²");
  EXPECT_EQ(unit_text("kg m^2"), "kg m²");
  EXPECT_EQ(unit_text("N s^2/m^3"), "N s²/m³");
  EXPECT_EQ(unit_text("(m/s^2)^2/Hz"), "(m/s²)²/Hz");
  EXPECT_EQ(unit_text("s^-1"), "s⁻¹");
  EXPECT_EQ(unit_text("m^12"), "m¹²");
  EXPECT_EQ(unit_text("1/rev"), "1/rev");
  EXPECT_EQ(unit_text("rad/(N m)"), "rad/(N m)");
  EXPECT_EQ(unit_text("a^b"), "a^b");
  EXPECT_EQ(unit_text("a^"), "a^");
  EXPECT_EQ(unit_text("1"), "");
  EXPECT_EQ(unit_text(""), "");
}

}  // namespace
}  // namespace flexarm::report
