#include "experiment/simulated_experiment.hpp"
#include "python/archive.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"
#include "python/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <complex>
#include <pybind11/stl.h>
#include <string>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using experiment::SimulatedRun;
using experiment::SteppedSineRun;

void add_run(py::module_& module) {
  auto run = py::class_<SimulatedRun>(
      module, "SimulatedRun",
      "A simulated time response. run['hub_angle'] is what the sensor reads, noise included, "
      "read-only array (samples,) in its unit.");
  add_record_access(run, &SimulatedRun::record);
  run.def_readonly("id", &SimulatedRun::id, "Its id.")
      .def_readonly("excitation", &SimulatedRun::excitation, "Kind of the excitation.")
      .def(
          "noise_free",
          [](const py::object& self, const std::string& sensor) {
            const auto& simulated = self.cast<const SimulatedRun&>();
            return view<double>(simulated.simulation.channels[channel_of(simulated.record, sensor)],
                                self);
          },
          py::arg("sensor"),
          "What the sensor reads without noise, array (samples,).\n\nArguments:\n  sensor: its "
          "name")
      .def_property_readonly(
          "hub_torque_N_m",
          [](const py::object& self) {
            return view<double>(self.cast<const SimulatedRun&>().simulation.hub_torque_N_m, self);
          },
          "Torque that reaches the hub, friction left out [N m], array (samples,).")
      .def_property_readonly(
          "energy", [](const SimulatedRun& self) { return self.simulation.energy; },
          "EnergyBalance [J].")
      .def_property_readonly(
          "summary", [](const SimulatedRun& self) { return self.simulation.summary; },
          "SimulationSummary.")
      .def_readonly("noise_deviation", &SimulatedRun::noise_deviation,
                    "Standard deviation of the noise of each sensor, a list.")
      .def_readonly("step_error", &SimulatedRun::step_error,
                    "Relative difference of each sensor to a tenfold smaller step, a list; empty "
                    "unless check_step was asked for.")
      .def_property_readonly(
          "modes", [](const SimulatedRun& self) { return self.truncation.modes; },
          "Flexible modes.")
      .def_property_readonly(
          "truncation_errors", [](const SimulatedRun& self) { return self.truncation.errors; },
          "Estimated error of each sensor by the omitted modes, relative to its signal, a list; of "
          "several runs the largest.")
      .def("__repr__", [](const SimulatedRun& self) {
        return fmt::format("<flexarm.SimulatedRun '{}': {} samples of {:g} s, {}>", self.id,
                           self.record.time_s.size(), measured::sampling_period_s(self.record),
                           fmt::join(names_of_channels(self.record), ", "));
      });
  auto stepped = py::class_<SteppedSineRun>(
      module, "SteppedSineRun",
      "A simulated stepped-sine test. run['hub_angle'] is the measured response, read-only complex "
      "array (frequencies,) in the unit of the sensor per N m.");
  stepped.def_readonly("id", &SteppedSineRun::id, "Its id.")
      .def_property_readonly(
          "frequency_Hz",
          [](const py::object& self) {
            return view<double>(self.cast<const SteppedSineRun&>().measured.frequency_Hz, self);
          },
          "f [Hz], read-only array (frequencies,).")
      .def_property_readonly(
          "sensors", [](const SteppedSineRun& self) { return names_of(self.sensors); },
          "Names of the sensors.")
      .def_property_readonly(
          "units", [](const SteppedSineRun& self) { return units_of(self.sensors); },
          "Their units; responses are in these per N m.")
      .def("__getitem__", [](const py::object& self, const std::string& sensor) {
        const auto& measured = self.cast<const SteppedSineRun&>();
        return view<std::complex<double>>(
            measured.measured.values[place_of(sensor, measured.sensors)], self);
      });
}

void add_simulation_summaries(py::module_& module) {
  using response::EnergyBalance;
  using response::SimulationSummary;
  py::class_<EnergyBalance>(module, "EnergyBalance",
                            "Where the energy went, from the first sample to the last [J].")
      .def_readonly("work_in_J", &EnergyBalance::work_in_J, "Work of the torque at the hub.")
      .def_readonly("kinetic_J", &EnergyBalance::kinetic_J, "At the end.")
      .def_readonly("potential_J", &EnergyBalance::potential_J, "At the end.")
      .def_readonly("viscous_J", &EnergyBalance::viscous_J, "Lost in the hub's viscous friction.")
      .def_readonly("material_air_J", &EnergyBalance::material_air_J,
                    "Lost in the other linear damping.")
      .def_readonly("dry_friction_J", &EnergyBalance::dry_friction_J, "Lost in dry friction.")
      .def_readonly("drag_J", &EnergyBalance::drag_J, "Lost in quadratic drag.")
      .def_property_readonly("dissipated_J", &EnergyBalance::dissipated_J, "All losses.")
      .def_property_readonly("residual_J", &EnergyBalance::residual_J, "0 but for errors.");
  py::class_<SimulationSummary>(module, "SimulationSummary", "What a simulation took.")
      .def_readonly("steps", &SimulationSummary::steps, "From sample to sample.")
      .def_readonly("inner_steps", &SimulationSummary::inner_steps, "Inner steps taken.")
      .def_readonly("reversals", &SimulationSummary::reversals, "Of the hub, without a rest.")
      .def_readonly("stops", &SimulationSummary::stops, "The hub came to rest in friction.")
      .def_readonly("breakaways", &SimulationSummary::breakaways, "The hub left its rest.")
      .def_readonly("stick_time_s", &SimulationSummary::stick_time_s, "Time at rest [s].")
      .def_readonly("samples_per_period", &SimulationSummary::samples_per_period,
                    "Samples a period of the highest mode.");
}

}  // namespace

void add_simulated_runs(py::module_& module) {
  add_simulation_summaries(module);
  add_run(module);
  add_pickle<SimulatedRun, SteppedSineRun, response::EnergyBalance, response::SimulationSummary>();
}

}  // namespace flexarm::python
