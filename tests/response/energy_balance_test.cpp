// Where the energy goes, and that a wrong law is found out by it.
#include "response/time/energy_ledger.hpp"
#include "tests/response/simulation_models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace flexarm::response {
namespace {

/// A random torque, linear between samples, on two masses with every force that loses energy.
Simulation lossy_run(const ArmParts& parts) {
  arm::ModalModel model = two_masses(0.01, 0.05, 3.0);
  model.damping_rad_per_s = {0.05, 0.03, 0.03, 0.09};
  std::vector<double> torque;
  for (int k = 0; k < 2000; ++k) torque.push_back(0.3 * std::sin(0.013 * k + 1e-5 * k * k));
  return simulate(model, parts, hub_sensors(), torque,
                  {.sample_time_s = 2e-3, .hold = TorqueHold::first});
}

TEST(EnergyBalance, OfCoulombFrictionClosesToRounding) {
  const auto energy = lossy_run(coulomb(0.05)).energy;
  EXPECT_GT(energy.dry_friction_J, 0.1 * energy.work_in_J);
  EXPECT_GT(energy.material_air_J, 0.0);
  EXPECT_LT(energy.largest_residual_J, 1e-11 * energy.work_in_J);
  EXPECT_GE(energy.lowest_loss_J, -1e-15);
}

TEST(EnergyBalance, OfStribeckFrictionAndRippleClosesToOneInAMillion) {
  ArmParts parts = coulomb(0.02);
  put(parts, "stribeck_friction", {{"torque", 0.02}, {"static_torque", 0.04}, {"velocity", 0.5}});
  put(parts, "torque_ripple", {{"amplitude", 0.02}, {"cycles", 3.0}, {"phase", 0.0}});
  const auto made = lossy_run(parts);
  EXPECT_GT(made.summary.stops, 0);
  EXPECT_LT(made.energy.largest_residual_J, 1e-6 * made.energy.work_in_J);
  EXPECT_GE(made.energy.lowest_loss_J, -1e-15);
}

TEST(EnergyBalance, IsNotFormedUnlessAskedFor) {
  const auto made = simulate(oscillator(1.0, 1.0), coulomb(0.1), hub_sensors(), step_torque(1.0, 9),
                             {.energy = false});
  EXPECT_EQ(made.energy.work_in_J, 0.0);
}

/// How a step is booked: by quadrature of the solution, or as a whole one of constant forces.
class BookedStep : public testing::TestWithParam<bool> {
 protected:
  /// One step of a turning hub that was solved with some friction torque, booked by the true law.
  static EnergyBalance booked(double friction_N_m, double law_N_m) {
    constexpr double kStep_s = 0.01;
    const auto sensors = hub_sensors();
    ArmParts parts = coulomb(0.0);
    parts.hub.friction.push_back({"coulomb_friction", {[law_N_m](double) {
                                    return arm::DryFriction::Size{law_N_m, 0.0};
                                  }}});
    const ModalDynamics arm = modal_dynamics(two_masses(0.01, 0.05, 3.0), parts, sensors);
    const AddedForces forces(arm, parts.hub, std::nullopt);
    EnergyLedger ledger(arm, forces, 0.0);
    const Eigen::VectorXd friction = Eigen::VectorXd::Constant(1, -friction_N_m);
    const StepInputs inputs{
        .u0 = 0.3, .u1 = 0.3, .length_s = kStep_s, .f0 = friction, .fm = friction, .f1 = friction};
    const Eigen::VectorXd begin = Eigen::VectorXd::Zero(arm.size());
    Expansion solution;
    solution.compute(arm.turning, kStep_s, begin,
                     {arm.turning.actuator * 0.3 - arm.turning.force * friction_N_m, begin, begin});
    const Eigen::VectorXd end = solution.at(1.0);
    if (GetParam()) {
      ledger.add(ledger.step_energy(arm, StepEnergy::Hub::turning, kStep_s), inputs,
                 HubMotion::forward, begin, end);
    } else {
      ledger.add(solution, inputs, HubMotion::forward, 1.0);
    }
    ledger.close_sample(end);
    return ledger.balance();
  }
};

TEST_P(BookedStep, FrictionOfTheWrongSignLeavesAResidual) {
  const EnergyBalance right = booked(0.1, 0.1);
  EXPECT_LT(std::abs(right.residual_J()), 1e-14 * right.work_in_J);
  const EnergyBalance wrong = booked(-0.1, 0.1);
  EXPECT_LT(wrong.residual_J(), -0.5 * wrong.work_in_J);  // energy was created
}

TEST_P(BookedStep, ALawOfTheWrongSignShowsAsALossBelowZero) {
  EXPECT_LT(booked(-0.1, -0.1).lowest_loss_J, -0.1 * booked(-0.1, -0.1).work_in_J);
}

INSTANTIATE_TEST_SUITE_P(Energy, BookedStep, testing::Bool(), [](const auto& tested) {
  return tested.param ? "AsAWhole" : "ByQuadrature";
});

}  // namespace
}  // namespace flexarm::response
