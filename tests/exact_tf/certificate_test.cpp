#include "exact_tf/certificate.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "exact_tf/exact_arm.hpp"
#include "sample_arms.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

namespace flexarm::exact_tf {
namespace {

constexpr double kUlps = 4.0;  // the project's figure

double moved_by_ulps(double x, int ulps) {
  return x + ulps * (std::nextafter(x, 2.0 * x) - x);
}

void expect_proved(const Certificate& certificate, long counted) {
  EXPECT_TRUE(certificate.proved) << certificate.failure;
  EXPECT_TRUE(certificate.failure.empty());
  EXPECT_EQ(certificate.counted, counted);
  EXPECT_LE(certificate.largest_distance_ulp, kUlps);
  EXPECT_GE(certificate.precision_bits, 128);
  ASSERT_EQ(std::ssize(certificate.roots), certificate.given);
  for (const auto& root : certificate.roots) {
    EXPECT_TRUE(root.enclosed);
    // The midpoint's own rounding and 2^-12 ulp.
    EXPECT_LE(root.radius, 0.51 * std::numeric_limits<double>::epsilon() * std::abs(root.lambda));
  }
}

void expect_refuted(const Certificate& certificate, const std::string& reason) {
  EXPECT_FALSE(certificate.proved);
  EXPECT_NE(certificate.failure.find(reason), std::string::npos) << certificate.failure;
}

/// The reference's arms have decimal values, ours their doubles: lambda differs by a part of 2^-53.
void expect_to_enclose(const Certificate& certificate, std::span<const std::string> digits) {
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const long double exact = std::stold(digits[i]);
    const auto& root = certificate.roots[i];
    EXPECT_LE(std::abs(exact - static_cast<long double>(root.lambda.real())),
              root.radius + std::numeric_limits<double>::epsilon() * root.lambda.real());
  }
}

TEST(Certificate, ProvesTheReference) {
  for (const auto& each : reference::reference_cases()) {
    SCOPED_TRACE(each.name);
    const arm::Arm arm = arm_of(each);
    const auto poles = certify_poles(arm, each.pole_lambda);
    expect_proved(poles, std::ssize(each.pole_lambda));
    expect_to_enclose(poles, each.pole_lambda_digits);
    const auto zeros = certify_hub_zeros(arm, each.hub_zero_lambda);
    expect_proved(zeros, std::ssize(each.hub_zero_lambda));
    expect_to_enclose(zeros, each.hub_zero_lambda_digits);
  }
}

TEST(Certificate, ProvesTheTipZerosOfTheReferenceWhereItsListIsComplete) {
  for (const auto& each : reference::reference_cases()) {
    SCOPED_TRACE(each.name);
    const arm::Arm arm = arm_of(each);
    std::vector<std::complex<double>> s;
    for (const double value : each.real_tip_zero_rad_per_s) s.emplace_back(value, 0.0);
    const auto certificate = certify_zeros(arm, kTip, s);
    if (each.payload_inertia_kg_m2 == 0.0) {
      expect_proved(certificate, std::ssize(s));
    } else {
      // The list leaves the imaginary pair out.
      expect_refuted(certificate, "7 roots up to the last one given");
      EXPECT_EQ(certificate.counted, std::ssize(s) + 1);
    }
  }
}

class Certified : public testing::TestWithParam<arm::Arm> {};

TEST_P(Certified, PolesAndHubZerosUpTo300) {
  constexpr int kCount = 300;
  const ExactArm exact(GetParam());
  expect_proved(certify_poles(GetParam(), exact.pole_lambdas(kCount)), kCount);
  expect_proved(certify_hub_zeros(GetParam(), exact.hub_zero_lambdas(kCount)), kCount);
}

TEST_P(Certified, ZerosOfSensorsUpTo50) {
  constexpr int kCount = 50;
  const ExactArm exact(GetParam());
  const double l = GetParam().beam.length_m;
  for (const arm::Sensor& sensor :
       {kTip, arm::Sensor{arm::SensorKind::tip_deflection}, arm::Sensor{arm::SensorKind::hub_angle},
        arm::Sensor{arm::SensorKind::strain, 0.0}, arm::Sensor{arm::SensorKind::strain, 0.4 * l},
        arm::Sensor{arm::SensorKind::strain, 0.9 * l}}) {
    SCOPED_TRACE(to_string(sensor));
    expect_proved(certify_zeros(GetParam(), sensor, exact.zeros(sensor, kCount).s_rad_per_s),
                  kCount);
  }
}

INSTANTIATE_TEST_SUITE_P(Arms, Certified, testing::ValuesIn(undamped_arms()));

class CertifiedTo10000 : public testing::TestWithParam<arm::Arm> {};

TEST_P(CertifiedTo10000, PolesAndHubZerosAreWithinFourUlpsAndNoneIsMissing) {
  constexpr int kCount = 10000;
  const ExactArm exact(GetParam());
  const auto poles = certify_poles(GetParam(), exact.pole_lambdas(kCount));
  expect_proved(poles, kCount);
  const auto zeros = certify_hub_zeros(GetParam(), exact.hub_zero_lambdas(kCount));
  expect_proved(zeros, kCount);
  RecordProperty("largest_pole_distance_ulp", std::to_string(poles.largest_distance_ulp));
  RecordProperty("largest_hub_zero_distance_ulp", std::to_string(zeros.largest_distance_ulp));
}

INSTANTIATE_TEST_SUITE_P(Arms, CertifiedTo10000,
                         testing::Values(arm::paper_arm(), unit_arm(0.1, 0.5, 0.02),
                                         unit_arm(1e3, 10.0, 0.1)));

class Refutation : public testing::Test {
 protected:
  const arm::Arm arm_ = unit_arm(0.1, 0.5, 0.02);
  std::vector<double> poles_ = ExactArm(arm_).pole_lambdas(40);
  std::vector<double> hub_zeros_ = ExactArm(arm_).hub_zero_lambdas(40);
  std::vector<std::complex<double>> tip_zeros_ = ExactArm(arm_).zeros(kTip, 20).s_rad_per_s;
};

TEST_F(Refutation, OfAListWithARootRemoved) {
  for (const std::ptrdiff_t at : {0, 17, 38}) {
    auto poles = poles_;
    poles.erase(poles.begin() + at);
    expect_refuted(certify_poles(arm_, poles), "40 roots up to the last one given");
    auto zeros = hub_zeros_;
    zeros.erase(zeros.begin() + at);
    expect_refuted(certify_hub_zeros(arm_, zeros), "40 roots up to the last one given");
  }
  for (const std::ptrdiff_t at : {0, 3, 18}) {
    auto zeros = tip_zeros_;
    zeros.erase(zeros.begin() + at);
    expect_refuted(certify_zeros(arm_, kTip, zeros), "20 roots up to the last one given");
  }
}

TEST_F(Refutation, OfAListWithARootTwice) {
  auto poles = poles_;
  poles.insert(poles.begin() + 5, poles[5]);
  expect_refuted(certify_poles(arm_, poles), "share an enclosure");
  auto zeros = tip_zeros_;
  zeros.insert(zeros.begin() + 5, zeros[5]);
  expect_refuted(certify_zeros(arm_, kTip, zeros), "share an enclosure");
}

TEST_F(Refutation, OfARootInPlaceOfAnother) {
  auto poles = poles_;
  poles[11] = poles[10];
  expect_refuted(certify_poles(arm_, poles), "share an enclosure");
}

TEST_F(Refutation, OfARootMovedByTenUlps) {
  constexpr int kMove = 10;
  for (const int move : {-kMove, kMove}) {
    auto poles = poles_;
    poles[20] = moved_by_ulps(poles[20], move);
    const auto certificate = certify_poles(arm_, poles);
    expect_refuted(certificate, "root 21 differs");
    EXPECT_NEAR(certificate.roots[20].distance_ulp, kMove, 1.0);
    EXPECT_EQ(certificate.counted, std::ssize(poles_));

    // s moves by twice as much, relatively, as lambda.
    auto zeros = tip_zeros_;
    zeros[7] = {zeros[7].real() * (1.0 + move * 0x1p-51), 0.0};
    expect_refuted(certify_zeros(arm_, kTip, zeros), "root 8 differs");
  }
}

TEST_F(Refutation, OfTheWrongOrder) {
  auto poles = poles_;
  std::swap(poles[3], poles[4]);
  expect_refuted(certify_poles(arm_, poles), "ascending");
}

TEST_F(Refutation, OfWhatIsNoRoot) {
  for (const double value : {0.0, -poles_[3], std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    auto poles = poles_;
    poles[3] = value;
    expect_refuted(certify_poles(arm_, poles), "root 4");
    auto zeros = tip_zeros_;
    zeros[3] = {value, 0.0};
    expect_refuted(certify_zeros(arm_, kTip, zeros), "root 4");
    zeros[3] = {value, value};
    expect_refuted(certify_zeros(arm_, kTip, zeros), "root 4");
  }
}

TEST_F(Refutation, OfTheZerosOfAnotherArm) {
  const arm::Arm other = unit_arm(0.1, 0.5, 0.02 * (1.0 + 1e-13));
  expect_refuted(certify_zeros(other, kTip, tip_zeros_), "differs");
}

TEST(Certificate, KeepsItsWordAtLowPrecision) {
  const arm::Arm arm = arm::paper_arm();
  const auto poles = ExactArm(arm).pole_lambdas(10);
  CertificateOptions options;
  options.precision_bits = 32;
  options.max_precision_bits = 32;
  const auto uncertain = certify_poles(arm, poles, options);
  EXPECT_FALSE(uncertain.proved);
  EXPECT_FALSE(uncertain.failure.empty());
  options.max_precision_bits = 512;
  const auto raised = certify_poles(arm, poles, options);
  EXPECT_TRUE(raised.proved);
  EXPECT_GT(raised.precision_bits, 32);
}

TEST(Certificate, GivesUpWithinItsBudget) {
  const arm::Arm arm = unit_arm(0.1, 0.0, 0.0);
  const arm::Sensor close_to_tip{arm::SensorKind::strain, 1.0 - 1e-7};
  CertificateOptions options;
  options.max_function_values = 10'000;
  const auto zeros = ExactArm(arm).zeros(close_to_tip, 5).s_rad_per_s;
  expect_refuted(certify_zeros(arm, close_to_tip, zeros, options), "root count not certified");
}

TEST(Certificate, IsRefusedWhereItWouldNotHold) {
  arm::Arm arm = arm::paper_arm();
  const std::vector<std::complex<double>> s = {{1.0, 0.0}};
  const arm::Sensor at_tip{arm::SensorKind::strain, arm.beam.length_m};
  EXPECT_THROW(certify_zeros(arm, at_tip, s), arm::InputError);
  effects::put(arm, "hub_spring", {{"stiffness", 2.0}});
  EXPECT_THROW(certify_poles(arm, std::vector{1.0}), arm::InputError);
}

TEST(Certificate, HoldsForAnArmWithTheEffectsOfAPlainOne) {
  arm::Arm arm = arm::paper_arm();
  effects::put(arm, "hub_inertia", {{"factor", 2.0}});
  effects::put(arm, "flexural_rigidity", {{"factor", 0.9}});
  const ExactArm exact(arm);
  expect_proved(certify_poles(arm, exact.pole_lambdas(5)), 5);
  expect_refuted(certify_poles(arm, ExactArm(arm::paper_arm()).pole_lambdas(5)), "root 1");
}

}  // namespace
}  // namespace flexarm::exact_tf
