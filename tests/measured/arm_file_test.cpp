#include "measured/files/arm_file.hpp"

#include "arm/arm_keys.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace flexarm::measured {
namespace {

using namespace arm;

using testing::HasSubstr;

constexpr const char* kFromFormatsDocument = R"(name = "aluminium link"
[beam]
length = 0.960
width = 0.019008
thickness = 0.0032004
density = 2710.0
youngs_modulus = 7.11e10
shear_modulus = 2.67e10
[hub]
inertia = 5.86e-4
viscous_friction = 0.002
[payload]
mass = 0.1
inertia = 0.0
[damping]
kelvin_voigt = 1.2e-4
[effects.coulomb_friction]
torque = 0.012
[effects.sensor_lag]
time_constant = 1e-3
sensor = "strain@0.05"
)";

TEST(ArmFile, EveryKeyReachesItsMember) {
  const Arm arm = parse_arm(kFromFormatsDocument, "arm.toml", effects::vocabulary());
  EXPECT_EQ(arm.name, "aluminium link");
  EXPECT_EQ(arm.beam.length_m, 0.96);
  EXPECT_EQ(arm.beam.width_m, 0.019008);
  EXPECT_EQ(arm.beam.thickness_m, 0.0032004);
  EXPECT_EQ(arm.beam.density_kg_per_m3, 2710.0);
  EXPECT_EQ(arm.beam.youngs_modulus_Pa, 7.11e10);
  EXPECT_EQ(arm.beam.shear_modulus_Pa, 2.67e10);
  EXPECT_EQ(arm.beam.given_flexural_rigidity_N_m2, std::nullopt);
  EXPECT_EQ(arm.hub.inertia_kg_m2, 5.86e-4);
  EXPECT_EQ(arm.hub.viscous_friction_N_m_s_per_rad, 0.002);
  EXPECT_EQ(arm.payload.mass_kg, 0.1);
  EXPECT_EQ(arm.damping.kelvin_voigt_s, 1.2e-4);
  EXPECT_EQ(arm.effects.at("coulomb_friction").parameters.at("torque"), 0.012);
  EXPECT_EQ(arm.effects.at("sensor_lag").sensor, "strain@0.05");
}

TEST(ArmFile, ABeamMayBeGivenByRigidityAndDensityAlone) {
  const Arm arm = parse_arm(
      "[beam]\nlength = 1\nflexural_rigidity = 3.7\nlinear_density = 0.16\n[hub]\ninertia = 0\n",
      "arm.toml", effects::vocabulary());
  EXPECT_EQ(arm.beam.flexural_rigidity_N_m2(), 3.7);
  EXPECT_EQ(arm.beam.linear_density_kg_per_m(), 0.16);
  EXPECT_EQ(parse_arm(format_arm(arm), "again", effects::vocabulary()), arm);
}

TEST(ArmFile, WithoutABeamItIsARigidHub) {
  const Arm arm = parse_arm(
      "[hub]\ninertia = 95.1\ninertia_uncertainty = 0.02\nviscous_friction = 203.5\n"
      "[effects.coulomb_friction]\ntorque = 20.4\n[effects.sensor_lag]\ntime_constant = 1e-3\n"
      "sensor = \"hub_angle\"\n",
      "arm.toml", effects::vocabulary());
  EXPECT_FALSE(has_beam(arm));
  EXPECT_EQ(arm.hub.inertia_kg_m2, 95.1);
  EXPECT_EQ(total_inertia_kg_m2(arm), 95.1);
  const std::string text = format_arm(arm);
  EXPECT_EQ(text.find("beam"), std::string::npos) << text;
  EXPECT_EQ(parse_arm(text, "again", effects::vocabulary()), arm);
}

TEST(ArmFile, DottedKeysAndInlineTablesAreTheSameFile) {
  EXPECT_EQ(parse_arm("beam = { length = 1, flexural_rigidity = 3.7, linear_density = 0.16 }\n"
                      "hub.inertia = 0\n",
                      "a", effects::vocabulary()),
            parse_arm("\xef\xbb\xbf[beam]\r\nlength = 1.0\r\nflexural_rigidity = 3.7\r\n"
                      "linear_density = 0.16\r\n[hub]\r\ninertia = 0.0",
                      "b", effects::vocabulary()));
}

TEST(ArmFile, WhatEqualsItsDefaultIsLeftOutOfTheText) {
  EXPECT_EQ(format_arm(paper_arm()),
            "name = \"aluminium link of the paper's Table 1\"\n"
            "\n[beam]\n"
            "length = 0.96  # m\n"
            "width = 0.019008  # m\n"
            "thickness = 0.0032004  # m\n"
            "density = 2710.0  # kg/m^3\n"
            "youngs_modulus = 7.11e+10  # Pa\n"
            "flexural_rigidity = 3.6917964  # N m^2\n"
            "\n[hub]\n"
            "inertia = 0.000586  # kg m^2\n");
}

TEST(ArmFile, AnArmThatIsNotValidIsNotWritten) {
  Arm arm = paper_arm();
  arm.hub.inertia_kg_m2 = std::numeric_limits<double>::infinity();
  EXPECT_THROW(format_arm(arm), InputError);
  arm = paper_arm();
  arm.name = "link \xe9";  // Latin-1
  try {
    format_arm(arm);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(R"(name = "link \xe9": not UTF-8)"));
  }
}

TEST(ArmFile, NumbersAreFloatsOfTheShortestFormThatReadsBack) {
  EXPECT_EQ(toml_number(0.1), "0.1");
  EXPECT_EQ(toml_number(1.0), "1.0");
  EXPECT_EQ(toml_number(-0.0), "-0.0");
  EXPECT_EQ(toml_number(7.11e10), "7.11e+10");
  EXPECT_EQ(toml_number(1e-5), "1e-05");
  EXPECT_EQ(toml_number(5e-324), "5e-324");
}

/// Random valid arms, from what a user may give to what only a program would.
class ArmGenerator {
 public:
  explicit ArmGenerator(std::uint64_t seed) : random_(seed) {}

  Arm arm() {
    Arm arm;
    arm.name = name();
    arm.beam = beam();
    arm.hub = {not_negative(), chance() ? not_negative() : 0.0};
    if (chance()) arm.payload = {not_negative(), not_negative()};
    if (chance()) arm.damping.kelvin_voigt_s = not_negative();
    for (const auto& definition : effects::vocabulary()) {
      const bool needs_gauge = definition->name == "gauge_position";
      if (pick(4) != 0 || (needs_gauge && !arm.beam.thickness_m)) continue;
      // Which holds its root's only spring.
      if (definition->name == "root_damping" && arm.effects.contains("root_compliance")) continue;
      // Which divides the hub's inertia.
      const bool is_drive = definition->name == "drive_compliance";
      if (is_drive && with_changed_numbers(arm).hub.inertia_kg_m2 == 0.0) continue;
      arm.effects[definition->name] = effect(definition, arm.beam);
    }
    return arm;
  }

 private:
  std::uint64_t pick(std::uint64_t count) { return random_() % count; }
  bool chance() { return pick(2) == 0; }

  /// All 53 bits of the significand random, 1e-6 to 1e6: products stay finite.
  double moderate() {
    return std::pow(10.0, std::uniform_real_distribution<double>(-6.0, 6.0)(random_));
  }

  /// Any positive finite double, subnormals and the largest among them.
  double positive() {
    constexpr std::uint64_t kPositiveInfinity = 0x7ff0000000000000;
    return std::bit_cast<double>(1 + pick(kPositiveInfinity - 1));
  }
  double not_negative() { return pick(8) == 0 ? 0.0 : positive(); }

  std::string name() {
    static const std::vector<std::string> pieces = {"rig",
                                                    " ",
                                                    "\"",
                                                    "\\",
                                                    "'",
                                                    "#",
                                                    "\n",
                                                    "\t",
                                                    "\r",
                                                    "é",
                                                    "μ",
                                                    "梁",
                                                    "\U0001f9be",
                                                    "\x7f",
                                                    "\x01",
                                                    "]",
                                                    "=",
                                                    "\"\"\"",
                                                    std::string(1, '\0')};
    std::string text;
    for (auto length = pick(6); length > 0; --length) text += pieces[pick(pieces.size())];
    return text;
  }

  Beam beam() {
    Beam beam;
    if (chance()) {
      beam = Beam::from_section(moderate(), moderate(), moderate(), moderate(), moderate());
      const double near_one = 1.0 + 0.9 * kDescriptionAgreement * (chance() ? 1.0 : -1.0);
      if (chance()) beam.given_flexural_rigidity_N_m2 = beam.flexural_rigidity_N_m2() * near_one;
      if (chance()) beam.given_linear_density_kg_per_m = beam.linear_density_kg_per_m() * near_one;
    } else {
      beam = Beam::from_rigidity(positive(), positive(), positive());
      if (chance()) beam.thickness_m = positive();
    }
    if (chance()) beam.shear_modulus_Pa = positive();
    return beam;
  }

  Effect effect(const std::shared_ptr<const EffectDefinition>& definition, const Beam& beam) {
    Effect effect{.definition = definition};
    for (const auto& parameter : definition->parameters) {
      if (parameter.otherwise && chance()) continue;
      double value = parameter.range.exclusive ? positive() : not_negative();
      if (parameter.range.minimum < 0.0 && chance()) value = -value;
      if (parameter.name == "position") value = beam.length_m * 0.25;
      if (parameter.name == "rotor_share") value = 0.25;
      if (definition->name == "beam_length") value = 0.75;  // a crack stays on the beam
      if (definition->name == "gauge_position") value = beam.length_m * 0.25;
      // Bounded by numbers of the beam that other effects change.
      if (definition->name == "air_damping" || definition->name == "quadratic_drag") value = 0.0;
      if (definition->name == "load_friction" && parameter.name == "factor") value = 0.25;
      if (definition->name == "stribeck_friction" && parameter.name == "static_torque") {
        value = std::max(value, effect.parameters.at("torque"));
      }
      effect.parameters[parameter.name] = value;
    }
    if (definition->name == "gauge_position") {
      effect.sensor = "strain@0";
    } else if (definition->sensor && chance()) {
      effect.sensor = beam.thickness_m && chance() ? "strain@0" : "hub_velocity";
    }
    return effect;
  }

  std::mt19937_64 random_;
};

TEST(ArmFile, WhatIsWrittenReadsBackEqual) {
  constexpr int kArms = 2000;
  ArmGenerator generator(20261120);
  for (int i = 0; i < kArms; ++i) {
    const Arm arm = generator.arm();
    const std::string text = format_arm(arm);
    ASSERT_EQ(parse_arm(text, "arm.toml", effects::vocabulary()), arm) << text;
    ASSERT_EQ(format_arm(parse_arm(text, "arm.toml", effects::vocabulary())), text);
  }
}

TEST(ArmFile, EveryNumberThatIsOutOfItsRangeIsRefusedByEveryRow) {
  for (const auto& key : arm_keys()) {
    for (const double bad : {-1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
      Arm arm = paper_arm();
      key.set(arm, bad);
      try {
        require_valid(arm);
        FAIL() << key.name() << " took " << bad;
      } catch (const InputError& error) {
        EXPECT_EQ(error.key(), key.name());
      }
    }
  }
}

}  // namespace
}  // namespace flexarm::measured
