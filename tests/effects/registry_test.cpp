// What every file of effects/ must say, and that it fits together.
#include "arm/input_error.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "effects/registry/vocabulary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::effects {
namespace {

/// An arm that can have every effect, and what was measured on it.
Scales scales() {
  Scales made;
  made.arm = arm::paper_arm();
  made.arm.beam.shear_modulus_Pa = 2.67e10;
  made.arm.payload = {0.05, 1e-4};
  made.beam = arm::linear_arm(made.arm);
  made.sensors = {arm::parse_sensor("hub_angle"), arm::parse_sensor("tip_acceleration")};
  made.has_payload_mass = true;
  made.torque_rms_N_m = 0.05;
  made.torque_peak_N_m = 0.2;
  return made;
}

/// Those of an effect on one sensor are of the sensor that it acts on by itself.
Scales scales_of(const Entry& entry) {
  Scales made = scales();
  made.sensor = entry.definition->sensor;
  made.reading_rms = 0.3;
  return made;
}

TEST(Registry, HasEachNameOnceAndWordsForAll) {
  std::set<std::string> names;
  for (const Entry& entry : entries()) {
    const arm::EffectDefinition& definition = *entry.definition;
    EXPECT_TRUE(names.insert(definition.name).second) << definition.name;
    EXPECT_FALSE(definition.meaning.empty()) << definition.name;
    EXPECT_FALSE(entry.speaks_for.empty()) << definition.name;
    EXPECT_FALSE(entry.refuted_by.empty()) << definition.name;
    EXPECT_FALSE(definition.ports().empty()) << definition.name;
    EXPECT_FALSE(definition.parameters.empty()) << definition.name;
    for (const auto& parameter : definition.parameters) {
      EXPECT_FALSE(parameter.meaning.empty()) << definition.name << "." << parameter.name;
      EXPECT_FALSE(parameter.unit.empty()) << definition.name << "." << parameter.name;
    }
  }
  EXPECT_EQ(names.size(), vocabulary().size());
}

TEST(Registry, ExamplesAreValidAndUnlikeTheNeutralValue) {
  for (const auto& definition : vocabulary()) {
    arm::Arm arm = scales().arm;
    arm.effects[definition->name] = example(definition);
    EXPECT_NO_THROW(arm::require_valid(arm)) << definition->name;
    for (const auto& parameter : definition->parameters) {
      EXPECT_NE(parameter.example, parameter.neutral.value_or(NAN)) << definition->name;
    }
  }
}

TEST(Registry, LimitsAreEffectsOfFewerOrAsManyParameters) {
  for (const Entry& entry : entries()) {
    for (const std::string& limit : entry.contains) {
      const Entry* simpler = find(limit);
      ASSERT_NE(simpler, nullptr) << entry.definition->name << " contains " << limit;
      EXPECT_LE(simpler->definition->parameters.size(), entry.definition->parameters.size());
    }
  }
}

TEST(Registry, EachEffectStatesAFamilyWithAName) {
  for (const Entry& entry : entries()) {
    EXPECT_NE(entry.family, Family::stated_law) << entry.definition->name;
    EXPECT_FALSE(to_string(entry.family).empty()) << entry.definition->name;
  }
}

TEST(Registry, FamiliesHaveDifferentNames) {
  std::set<std::string_view> names;
  std::set<Family> families;
  for (const Entry& entry : entries()) {
    names.insert(to_string(entry.family));
    families.insert(entry.family);
  }
  EXPECT_EQ(names.size(), families.size());
}

TEST(Registry, LimitsAreOfTheSameFamilyOrItIsStatedWhyNot) {
  struct Exception {
    std::string effect;
    std::string limit;
    std::string reason;
  };
  const std::vector<Exception> exceptions = {
      {"attached_mass", "payload_mass", "a mass that is attached at the tip is a payload"},
      {"hub_hysteresis", "hub_spring", "below the friction torque presliding is elastic"},
      {"local_stiffness_loss", "root_compliance", "a crack at the root is a compliant root"},
      {"tilt", "hub_spring", "at small angles the torque of gravity is linear in the angle"},
      {"torque_ripple", "hub_spring", "within a part of a cycle a ripple is linear in the angle"}};
  std::vector<std::pair<std::string, std::string>> of_others;
  for (const Entry& entry : entries()) {
    for (const std::string& limit : entry.contains) {
      if (find(limit)->family == entry.family) continue;
      of_others.emplace_back(entry.definition->name, limit);
    }
  }
  std::vector<std::pair<std::string, std::string>> stated;
  for (const Exception& one : exceptions) stated.emplace_back(one.effect, one.limit);
  EXPECT_THAT(of_others, testing::UnorderedElementsAreArray(stated));
}

TEST(Registry, EffectsThatAreTheSameModelAreOfTheSameFamily) {
  for (const Entry& entry : entries()) {
    for (const std::string& same : entry.same_as) {
      EXPECT_EQ(find(same)->family, entry.family) << entry.definition->name;
    }
  }
}

TEST(Registry, EachParameterIsLookedForWithinItsRange) {
  for (const Entry& entry : entries()) {
    const auto searched = entry.search(scales_of(entry));
    const auto& parameters = entry.definition->parameters;
    ASSERT_EQ(searched.size(), parameters.size()) << entry.definition->name;
    for (std::size_t i = 0; i < searched.size(); ++i) {
      const std::string where = entry.definition->name + "." + parameters[i].name;
      EXPECT_EQ(searched[i].name, parameters[i].name);
      EXPECT_LT(searched[i].lowest, searched[i].highest) << where;
      for (const double coordinate : {0.0, 0.01, 0.5, 1.0}) {
        const double value = searched[i].value(coordinate);
        EXPECT_TRUE(parameters[i].range.contains(value)) << where << " = " << value;
      }
    }
  }
}

TEST(Registry, ANeutralValueIsOneAtWhichTheSearchSaysThatNothingIsDone) {
  for (const Entry& entry : entries()) {
    const auto searched = entry.search(scales_of(entry));
    for (std::size_t i = 0; i < searched.size(); ++i) {
      const auto& neutral = entry.definition->parameters[i].neutral;
      if (!neutral) continue;
      const auto coordinate = searched[i].neutral_coordinate();
      ASSERT_TRUE(coordinate.has_value()) << entry.definition->name;
      // A clipping limit does nothing from the highest torque on.
      if (std::isinf(*neutral)) continue;
      EXPECT_NEAR(searched[i].value(*coordinate), *neutral, 1e-12) << entry.definition->name;
    }
  }
}

TEST(Registry, TheSizeOfACoordinateIsThatOfItsValueByTheDerivative) {
  const SearchedParameter from_zero{"torque", 3e-3, 3.0, Spacing::from_zero};
  const SearchedParameter from_infinity{"stiffness", 2.0, 5e3, Spacing::from_infinity};
  const SearchedParameter logarithmic{"time", 1e-3, 1.0, Spacing::logarithmic};
  constexpr double kStep = 1e-6;
  constexpr double kOfQuotients = 1e-5;
  for (const double at : {0.05, 0.4, 0.9}) {
    const auto change = [at](const auto& value) {
      return (value(at + kStep) - value(at - kStep)) / (2.0 * kStep);
    };
    const auto torque = [&](double place) { return from_zero.value(place); };
    EXPECT_NEAR(from_zero.size(at) * change(torque) / torque(at), 1.0, kOfQuotients) << at;
    const auto compliance = [&](double place) { return 1.0 / from_infinity.value(place); };
    EXPECT_NEAR(from_infinity.size(at) * change(compliance) / compliance(at), 1.0, kOfQuotients)
        << at;
    const auto time = [&](double place) { return logarithmic.value(place); };
    EXPECT_NEAR(logarithmic.size(at) * change(time) / time(at), 1.0, kOfQuotients) << at;
  }
  const SearchedParameter about_zero{"delay", -0.004, 1.0, Spacing::about_zero};
  for (const double at : {0.05, 0.15, 0.4, 0.9}) {
    const double slope =
        (about_zero.value(at + kStep) - about_zero.value(at - kStep)) / (2.0 * kStep);
    EXPECT_NEAR(about_zero.size(at) * slope / std::abs(about_zero.value(at)), 1.0, kOfQuotients);
    EXPECT_NEAR(about_zero.coordinate(about_zero.value(at)), at, kOfQuotients);
  }
  EXPECT_NEAR(about_zero.value(0.0), -0.004, 1e-12);
  EXPECT_NEAR(about_zero.value(1.0), 1.0, 1e-9);
  const SearchedParameter with_neutral{"factor", 0.5, 2.5, Spacing::linear, false, 1.0};
  EXPECT_DOUBLE_EQ(with_neutral.size(0.75), 0.5);
}

TEST(Registry, RefusesAnUnknownNameWithWhatWasMeant) {
  try {
    effect("coulomb_frction", {});
    ADD_FAILURE() << "not refused";
  } catch (const arm::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean coulomb_friction?"));
  }
}

TEST(Registry, PutKeepsTheOtherNumbersOfAnEffect) {
  arm::Arm arm = arm::paper_arm();
  put(arm, "stribeck_friction", {{"torque", 0.01}, {"static_torque", 0.02}, {"velocity", 0.1}});
  put(arm, "stribeck_friction", {{"torque", 0.015}});
  EXPECT_EQ(arm.effects.at("stribeck_friction").value("torque"), 0.015);
  EXPECT_EQ(arm.effects.at("stribeck_friction").value("static_torque"), 0.02);
}

/// Returns the scales of a run with these torques.
Scales scales_with(const std::vector<double>& torque_N_m) {
  TorqueScales torques;
  torques.add(torque_N_m, 0.01, 1.0);
  Scales made = scales();
  torques.put(made);
  return made;
}

TEST(SearchRange, OfASaturationEndsWhereNearlyAllOfTheTorqueIsLimited) {
  std::vector<double> torque_N_m = {0.0, 0.0};
  for (int k = 1; k <= 100; ++k) torque_N_m.push_back(k % 2 == 0 ? 0.01 * k : -0.01 * k);
  EXPECT_NEAR(scales_with(torque_N_m).torque_low_N_m, 0.11, 1e-12);  // ten of the hundred are below
  EXPECT_EQ(scales_with({0.0}).torque_low_N_m, scales().torque_low_N_m);
  Scales seen;
  seen.torque_peak_N_m = 0.06;
  seen.torque_low_N_m = 0.02;
  const Entry& saturation = *find("torque_saturation");
  EXPECT_TRUE(saturation.applies(seen));
  EXPECT_EQ(saturation.search(seen).front().lowest, 0.02);
  // A limit is a gain for a torque of one size.
  EXPECT_FALSE(saturation.applies(scales_with({0.0, 0.06, -0.06, 0.06})));
}

}  // namespace
}  // namespace flexarm::effects
