#include "arm/input_error.hpp"
#include "fem/fem_arm.hpp"
#include "tests/reference/reference_cases.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

namespace flexarm::fem {
namespace {

using Complex = std::complex<double>;

void expect_close(Complex value, Complex exact, double tolerance) {
  EXPECT_LE(std::abs(value - exact), tolerance * std::abs(exact)) << value << ", exact " << exact;
}

class ReferenceResponses : public ::testing::TestWithParam<reference::ReferenceCase> {};

TEST_P(ReferenceResponses, AreMetByTheDefaultModel) {
  // The last frequency lies past the tenth pole of some cases and close to one of others, where
  // the response is ill-conditioned.
  constexpr double kTolerance = 1e-12;
  const FemArm model(reference::arm_of(GetParam()));
  const arm::Sensor strain{arm::SensorKind::strain, GetParam().length_m / 4.0};
  for (const reference::ReferenceResponse& exact : GetParam().responses) {
    const Complex s = exact.s_rad_per_s;
    const auto response = [&](const arm::Sensor& sensor) {
      return model.transfer_function(sensor, s);
    };
    const Complex tip = exact.tip_displacement;
    expect_close(response({arm::SensorKind::hub_angle}), exact.hub_angle, kTolerance);
    expect_close(response({arm::SensorKind::hub_velocity}), s * exact.hub_angle, kTolerance);
    expect_close(response({arm::SensorKind::tip_displacement}), tip, kTolerance);
    expect_close(response({arm::SensorKind::tip_acceleration}), s * s * tip, kTolerance);
    expect_close(response({arm::SensorKind::tip_deflection}),
                 tip - GetParam().length_m * exact.hub_angle, kTolerance);
    expect_close(response(strain), exact.curvature_quarter, kTolerance);
  }
}

INSTANTIATE_TEST_SUITE_P(Reference, ReferenceResponses,
                         ::testing::ValuesIn(reference::reference_cases()),
                         reference::name_of_case);

/// A unit arm with both dampings.
arm::Arm damped_arm() {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.beam.thickness_m = 2.0;
  arm.hub = {0.1, 0.05};
  arm.payload = {0.5, 0.02};
  arm.damping.kelvin_voigt_s = 0.002;
  return arm;
}

struct DampedResponse {
  Complex s, hub_angle, tip_displacement, tip_deflection, strain_quarter;
};

// Solutions of the boundary-value problem, computed with 40 digits.
const std::array<DampedResponse, 5> kDampedResponses = {{
    {{0.0, 0.001},
     {-381.194841181108221, -19992.7318833767098},
     {-381.194943479146701, -19992.737248094292},
     {-0.00010229803847963136, -0.00536471758226032637},
     {-0.000231004537893765435, -0.0121143486662982936}},
    {{0.0, 2.5},
     {0.13323979736319339, -0.00412638146824648151},
     {-0.2229569044255356, 0.00406862743317782126},
     {-0.35619670178872899, 0.00819500890142430276},
     {-0.802226121373048953, 0.0184448806265378067}},
    {{-0.5, 20.0},
     {-0.0269255827036162773, 0.000697748754842854856},
     {0.00106846034781439613, -0.0000166632420833219044},
     {0.0279940430514306735, -0.00071441199692617676},
     {0.0996498722412838447, -0.00220179649080544432}},
    {{0.0, 150.0},
     {-0.000447085848125761924, -4.35514374462295693e-6},
     {-3.19126220314281346e-6, -2.37950007097421162e-6},
     {0.00044389458592261911, 1.97564367364874531e-6},
     {-0.00283139941338630727, -0.00184596110148631163}},
    {{4.0, 0.0},
     {0.212080934564494809, 0.0},
     {0.0365040506575148932, 0.0},
     {-0.175576883906979916, 0.0},
     {-0.398162827374787929, 0.0}},
}};

TEST(TransferFunction, HasBothDampings) {
  constexpr double kTolerance = 1e-12;
  const FemArm model(damped_arm());
  for (const DampedResponse& exact : kDampedResponses) {
    const auto response = [&](const char* sensor) {
      return model.transfer_function(arm::parse_sensor(sensor), exact.s);
    };
    expect_close(response("hub_angle"), exact.hub_angle, kTolerance);
    expect_close(response("tip_displacement"), exact.tip_displacement, kTolerance);
    expect_close(response("tip_deflection"), exact.tip_deflection, kTolerance);
    expect_close(response("strain@0.25"), exact.strain_quarter, kTolerance);
  }
}

TEST(TransferFunction, OfStrainInsideAnElementIsOfOrderFour) {
  // By inertia forces; the second derivative of cubic shape functions would be of order two.
  // At 0.25 an odd number of elements has no node.
  constexpr double kOrder = 4.0;
  constexpr double kOrderTolerance = 0.1;
  const DampedResponse& exact = kDampedResponses[2];
  const auto error = [&](int elements) {
    const FemArm model(damped_arm(), {.mesh = {.elements = elements}, .degree = 3});
    return std::abs(model.transfer_function(arm::parse_sensor("strain@0.25"), exact.s) -
                    exact.strain_quarter);
  };
  EXPECT_NEAR(std::log(error(17) / error(51)) / std::log(3.0), kOrder, kOrderTolerance);
}

TEST(TransferFunction, OfAFineCubicMeshKeepsItsDigits) {
  // At 2000 elements the discretisation error is below 1e-12, that of an assembled stiffness
  // would be epsilon h^-4 = 4e-3.
  constexpr double kTolerance = 1e-11;
  const FemArm model(damped_arm(), {.mesh = {.elements = 2000}, .degree = 3});
  const DampedResponse& exact = kDampedResponses[1];
  expect_close(model.transfer_function(arm::parse_sensor("hub_angle"), exact.s), exact.hub_angle,
               kTolerance);
  expect_close(model.transfer_function(arm::parse_sensor("strain@0.25"), exact.s),
               exact.strain_quarter, kTolerance);
}

TEST(TransferFunction, TendsToThatOfTheRigidArmAtLowFrequency) {
  arm::Arm arm = damped_arm();
  arm.hub.viscous_friction_N_m_s_per_rad = 0.0;
  const FemArm model(arm);
  const double inertia = arm::total_inertia_kg_m2(arm);
  for (const double omega : {1e-2, 1e-5, 1e-9}) {
    const Complex s(0.0, omega);
    // The flexible modes add a relative omega^2 times their compliance, here below 1.
    const double tolerance = omega * omega + 1e-14;
    expect_close(model.transfer_function(arm::parse_sensor("hub_angle"), s) * s * s, 1.0 / inertia,
                 tolerance);
    // The arm bends under the inertia forces -m x, -Mp and the moment -Ip of a unit angular
    // acceleration; l = m = EI = 1.
    const double deflection = -(11.0 / 120.0 + 0.5 / 3.0 + 0.02 / 2.0) / inertia;
    EXPECT_NEAR(model.transfer_function(arm::parse_sensor("tip_deflection"), s).real(), deflection,
                tolerance * std::abs(deflection));
  }
}

TEST(TransferFunction, VanishesAtTheZerosOfTheHubAngle) {
  const FemArm model(reference::arm_of(reference::case_named("unit_pinned_free")));
  const arm::Sensor hub{arm::SensorKind::hub_angle};
  for (const Complex zero : model.zeros(hub, 4).s_rad_per_s) {
    const Complex at = model.transfer_function(hub, zero);
    const Complex beside = model.transfer_function(hub, zero * 1.01);
    EXPECT_LE(std::abs(at), 1e-10 * std::abs(beside));
    // The tip moves although the hub stands still.
    const Complex tip = model.transfer_function({arm::SensorKind::tip_displacement}, zero);
    EXPECT_TRUE(std::isfinite(std::abs(tip)));
    EXPECT_GT(std::abs(tip), 1e-3 * std::abs(beside));
  }
}

TEST(TransferFunction, RefusesTheOriginAndImpossibleSensors) {
  const FemArm model(damped_arm());
  EXPECT_THROW(model.transfer_function({arm::SensorKind::hub_angle}, 0.0), std::domain_error);
  EXPECT_THROW(model.transfer_function({arm::SensorKind::hub_angle}, 1e200), std::domain_error);
  EXPECT_THROW(model.transfer_function({arm::SensorKind::strain, 1.5}, Complex(0.0, 1.0)),
               arm::InputError);
}

}  // namespace
}  // namespace flexarm::fem
