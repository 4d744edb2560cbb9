#include "report/tables/simulation_report.hpp"

#include "report/figures/svg.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/text_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace flexarm::report {
namespace {

using testing::HasSubstr;

SimulatedRun sample_run() {
  SimulatedRun run;
  run.id = "first";
  run.excitation = "step";
  run.keys = {{"amplitude", "N m", "0.5"}};
  run.payload = {0.06, 0.0};
  run.record = {
      {0.0, 0.5, 1.0}, {0.5, 0.5, 0.5}, {{{arm::SensorKind::hub_angle}, {0.1, -3.1, 2.0}}}};
  run.simulation.time_s = run.record.time_s;
  run.simulation.hub_torque_N_m = {0.5, 0.4, 0.5};
  run.simulation.channels = {{0.0, -3.0, 2.0}};
  run.simulation.energy.work_in_J = 2.0;
  run.simulation.energy.kinetic_J = 1.5;
  run.simulation.energy.viscous_J = 0.4999;
  run.simulation.summary.stops = 3;
  run.simulation.summary.stick_time_s = 0.25;
  run.noise_deviation = {0.1};
  return run;
}

TEST(SimulationReport, PeaksAreThoseOfTheSignalAndNotOfItsNoise) {
  const Table table = reading_table({sample_run()});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(std::get<double>(table.rows[0][3]), -3.0);
  EXPECT_EQ(std::get<double>(table.rows[0][4]), 0.5);
  EXPECT_EQ(std::get<double>(table.rows[0][5]), 2.0);
  EXPECT_EQ(std::get<double>(table.rows[0][6]), 0.1);
}

TEST(SimulationReport, TheStepErrorHasAColumnWhenItWasAskedFor) {
  SimulatedRun run = sample_run();
  EXPECT_EQ(reading_table({run}).columns.size(), 7U);
  run.step_error = {2e-9};
  const Table table = reading_table({run});
  ASSERT_EQ(table.columns.size(), 8U);
  EXPECT_EQ(std::get<double>(table.rows[0][7]), 2e-9);
}

TEST(SimulationReport, TheEnergyLeftOverIsRelativeToTheWork) {
  EXPECT_NEAR(relative_energy_residual(sample_run().simulation.energy), 5e-5, 1e-15);
  EXPECT_EQ(relative_energy_residual({}), 0.0);
  response::EnergyBalance falling;  // no torque: gravity alone
  falling.potential_J = -2.0;
  falling.kinetic_J = 1.998;
  EXPECT_NEAR(relative_energy_residual(falling), 0.001, 1e-12);
}

TEST(SimulationReport, TorqueAndHubMotionAreTold) {
  const std::string torque = to_text(torque_table({sample_run()}));
  EXPECT_THAT(torque, HasSubstr("step, amplitude 0.5 N m"));
  EXPECT_THAT(torque, HasSubstr("0.06000"));
  SimulatedRun multisine = sample_run();
  multisine.lines_Hz = {1.0, 3.0, 7.0};
  multisine.detection_Hz = {5.0};
  EXPECT_THAT(to_csv(torque_table({multisine})), HasSubstr("3 lines, 1 detection line"));
  const Table hub = hub_motion_table({sample_run()});
  EXPECT_EQ(std::get<std::int64_t>(hub.rows[0][2]), 3);
  EXPECT_EQ(std::get<double>(hub.rows[0][4]), 0.25);
}

TEST(SimulationReport, TheFigureShowsTheTorqueAtTheHubWhereItIsAnother) {
  SimulatedRun run = sample_run();
  EXPECT_THAT(to_svg(simulation_figure("rig", run)), HasSubstr("<text>at the hub</text>"));
  run.simulation.hub_torque_N_m = run.record.torque_N_m;
  const std::string svg = to_svg(simulation_figure("rig", run));
  EXPECT_THAT(svg, testing::Not(HasSubstr("at the hub")));
  EXPECT_THAT(svg, HasSubstr("<text>rig: first</text>"));
  EXPECT_THAT(svg, HasSubstr("<text>hub angle [rad]</text>"));
}

}  // namespace
}  // namespace flexarm::report
