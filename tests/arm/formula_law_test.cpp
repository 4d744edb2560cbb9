#include "arm/formula_law.hpp"

#include "arm/input_error.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <variant>
#include <vector>

namespace flexarm::arm {
namespace {

FormulaLaw law_of(const std::string& text, const std::vector<std::string>& names = {},
                  std::vector<double> numbers = {}) {
  return {"my_law", std::make_shared<const CompiledFormula>(text, names), std::move(numbers)};
}

struct Parts {
  double constant_N_m = 0.0;
  std::optional<SmoothHubTorque> smooth = {};
  std::optional<DryFriction> friction = {};
};

Parts parts_of(const FormulaLaw& law) {
  Parts parts;
  const HubLaw beyond = law.beyond_slopes();
  if (const auto* constant = std::get_if<ConstantHubTorque>(&beyond)) {
    parts.constant_N_m = constant->torque_N_m;
  } else if (const auto* smooth = std::get_if<SmoothHubTorque>(&beyond)) {
    parts.smooth = *smooth;
  } else if (const auto* friction = std::get_if<DryFriction>(&beyond)) {
    parts.friction = *friction;
  } else {
    const auto& both = std::get<HubTorqueWithFriction>(beyond);
    parts.smooth = both.smooth;
    parts.friction = both.friction;
  }
  return parts;
}

SmoothHubTorque::Value smooth_at(const Parts& parts, const HubState& hub) {
  return parts.smooth ? parts.smooth->law(hub, {}, {}) : SmoothHubTorque::Value{};
}

/// The parts added up again.
double whole(const FormulaLaw& law, const Parts& parts, const HubState& hub) {
  const double velocity = hub.velocity_rad_per_s;
  double sum = parts.constant_N_m + smooth_at(parts, hub).torque_N_m -
               law.stiffness_N_m_per_rad() * hub.angle_rad - law.damping_N_m_s_per_rad() * velocity;
  if (parts.friction) {
    sum -= std::copysign(parts.friction->size(std::abs(velocity)).torque_N_m, velocity);
  }
  return sum;
}

struct Case {
  const char* name;
  std::string text;
  double stiffness = 0.0;
  double damping = 0.0;
  double friction = 0.0;
  bool has_smooth = true;
};

void PrintTo(const Case& one, std::ostream* out) {
  *out << one.name;
}

const std::vector<Case> kCases = {
    {"Cubic", "-3*theta^3"},
    {"Pendulum", "-0.4*sin(theta)", 0.4},
    {"SpringAndDashpot", "-0.3*theta - 0.002*omega", 0.3, 0.002, 0.0, false},
    {"SpringThatHardens", "-0.3*theta*(1 + 20*theta^2)", 0.3},
    {"SpringOfTheOtherSign", "0.3*theta - theta^3"},
    {"SteepNearRest", "-0.02*tanh(omega/1e-3)", 0.0, 20.0},
    {"CableWithPlay", "-2*max(abs(theta) - 0.1, 0)*sign(theta)"},
    {"CableThatPullsOneWay", "-2*max(theta, 0)"},
    {"Coulomb", "-0.012*sign(omega)", 0.0, 0.0, 0.012, false},
    {"CoulombAndViscous", "-0.012*sign(omega) - 0.003*omega", 0.0, 0.003, 0.012, false},
    {"Stribeck", "-(0.01 + 0.006*exp(-(omega/0.2)^2))*sign(omega)", 0.0, 0.0, 0.016},
    {"OtherFrictionForward", "-0.012*sign(omega) - 0.004 - 0.1*theta^3", 0.0, 0.0, 0.012},
    {"GrowsOneWay", "-(0.01 + 0.002*omega)*sign(omega)", 0.0, 0.0, 0.01},
    {"OfTheTorque", "-0.1*tau*abs(tau)"},
    {"OfTime", "0.01*sin(3*t)*(1 + theta)"},
    {"Drag", "-0.01*omega*abs(omega)"}};

class TakenApart : public testing::TestWithParam<Case> {};

TEST_P(TakenApart, IntoTheSlopesAndFrictionThatItHas) {
  constexpr double kSlope = 1e-6;  // relative: where an extrapolation is taken for certain
  const FormulaLaw law = law_of(GetParam().text);
  law.require_law();
  EXPECT_NEAR(law.stiffness_N_m_per_rad(), GetParam().stiffness, kSlope * GetParam().stiffness);
  EXPECT_NEAR(law.damping_N_m_s_per_rad(), GetParam().damping, kSlope * GetParam().damping);
  const Parts parts = parts_of(law);
  EXPECT_EQ(parts.smooth.has_value(), GetParam().has_smooth);
  ASSERT_EQ(parts.friction.has_value(), GetParam().friction > 0.0);
  if (parts.friction) {
    EXPECT_NEAR(parts.friction->size(0.0).torque_N_m, GetParam().friction, 1e-15);
  }
}

TEST_P(TakenApart, AndAddsUpToTheFormula) {
  constexpr double kRounding = 1e-13;
  const CompiledFormula formula(GetParam().text, {});
  const FormulaLaw law = law_of(GetParam().text);
  const Parts parts = parts_of(law);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-2.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const HubState hub{any(random), any(random), any(random), any(random)};
    const double expected = formula(hub, std::copysign(1.0, hub.velocity_rad_per_s), {});
    // Slopes of 20 N m s/rad are added and taken off again.
    const double size = 1.0 + std::abs(law.damping_N_m_s_per_rad() * hub.velocity_rad_per_s);
    EXPECT_NEAR(whole(law, parts, hub), expected, kRounding * size);
  }
}

TEST_P(TakenApart, IntoASmoothPartThatDoesNotJumpWhereTheHubTurnsRound) {
  constexpr double kShort = 1e-10;
  constexpr double kSteepest = 50.0;  // d torque/d velocity of these laws
  const Parts parts = parts_of(law_of(GetParam().text));
  for (const double angle : {-0.7, 0.0, 0.4}) {
    const auto at = [&](double velocity) {
      return smooth_at(parts, {angle, velocity, 0.03, 1.0}).torque_N_m;
    };
    EXPECT_NEAR(at(kShort), at(0.0), kSteepest * kShort);
    EXPECT_NEAR(at(-kShort), at(0.0), kSteepest * kShort);
  }
}

TEST_P(TakenApart, WithTheSlopesOverVelocityThatStepsAreSolvedBy) {
  constexpr double kStep = 1e-5;
  constexpr double kSecondOrder = 1e-6;
  const Parts parts = parts_of(law_of(GetParam().text));
  for (const double velocity : {-1.3, -0.21, 0.17, 0.9}) {
    const auto at = [&](double v) { return smooth_at(parts, {0.3, v, 0.03, 1.0}); };
    EXPECT_NEAR(at(velocity).per_velocity_N_m_s,
                (at(velocity + kStep).torque_N_m - at(velocity - kStep).torque_N_m) / (2.0 * kStep),
                kSecondOrder);
    if (!parts.friction) continue;
    const double speed = std::abs(velocity);
    const auto size = [&](double v) { return parts.friction->size(v); };
    EXPECT_NEAR(size(speed).per_speed_N_m_s,
                (size(speed + kStep).torque_N_m - size(speed - kStep).torque_N_m) / (2.0 * kStep),
                kSecondOrder);
  }
}

INSTANTIATE_TEST_SUITE_P(, TakenApart, testing::ValuesIn(kCases),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(FormulaLaw, ThatIsAConstantIsOne) {
  EXPECT_EQ(parts_of(law_of("-0.25*b", {"b"}, {0.1})).constant_N_m, -0.025);
}

TEST(FormulaLaw, KnowsTheSpeedOverWhichFrictionFalls) {
  const auto friction =
      *parts_of(law_of("-(0.01 + 0.006*exp(-(omega/0.2)^2))*sign(omega)")).friction;
  ASSERT_TRUE(friction.changes_over_rad_per_s.has_value());
  EXPECT_GT(*friction.changes_over_rad_per_s, 0.05);
  EXPECT_LT(*friction.changes_over_rad_per_s, 0.25);
  EXPECT_FALSE(parts_of(law_of("-0.01*sign(omega)")).friction->changes_over_rad_per_s.has_value());
}

TEST(FormulaLaw, OnlyALawOfTimeDependsOnIt) {
  EXPECT_TRUE(parts_of(law_of("0.01*sin(3*t)")).smooth->depends_on_time);
  EXPECT_FALSE(parts_of(law_of("-theta^3")).smooth->depends_on_time);
}

struct Refused {
  const char* name;
  std::string text;
  std::string error;
};

void PrintTo(const Refused& one, std::ostream* out) {
  *out << one.name;
}

const std::vector<Refused> kRefused = {
    {"NotFiniteAtRest", "-0.01*omega/abs(omega)",
     "effects.my_law.hub_torque: nan at theta = 0 rad, omega = 0 rad/s, tau = 0 N m, t = 0 s; must "
     "be finite"},
    {"JumpsAtRest", "omega > 0 ? -0.01 : 0.01",
     "effects.my_law.hub_torque: jumps at omega = 0; dry friction is written with sign(omega)"},
    {"SignOfAnythingElse", "-0.01*sign(2*omega)",
     "effects.my_law.hub_torque: jumps at omega = 0; dry friction is written with sign(omega)"},
    {"FrictionOfTheAngle", "-(0.01 + 0.1*theta^2)*sign(omega)",
     "effects.my_law.hub_torque: dry friction, what stands at sign(omega), depends on theta, tau "
     "or "
     "t; at omega = 0 it may depend on numbers alone"},
    {"FrictionThatDrives", "0.01*sign(omega)",
     "effects.my_law.hub_torque: dry friction of -0.01 N m at omega = 0; must be 0 or more, "
     "against "
     "the motion: -F*sign(omega)"}};

class RefusedLaw : public testing::TestWithParam<Refused> {};

TEST_P(RefusedLaw, SaysWhy) {
  try {
    law_of(GetParam().text).require_law();
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.what(), GetParam().error);
    EXPECT_EQ(error.key(), "effects.my_law.hub_torque");
  }
}

INSTANTIATE_TEST_SUITE_P(, RefusedLaw, testing::ValuesIn(kRefused),
                         [](const auto& one) { return std::string(one.param.name); });

TEST(FormulaLaw, OutsideOfItsDomainSaysWhere) {
  const auto smooth = *parts_of(law_of("-0.1*sqrt(1 - theta^2)*theta")).smooth;
  try {
    smooth.law({1.5, 0.25, 0.0, 3.0}, {}, {});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::EndsWith("nan at theta = 1.5 rad, omega = 0.25 rad/s, tau = 0 N m, "
                                  "t = 3 s; must be finite"));
  }
}

}  // namespace
}  // namespace flexarm::arm
