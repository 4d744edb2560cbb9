#include "python/responses.hpp"

#include "python/archive.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"
#include "python/records.hpp"
#include "response/any_formulation.hpp"
#include "response/frequency/response_study.hpp"
#include "response/residual_mode.hpp"
#include "response/state_space_roots.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <complex>
#include <optional>
#include <pybind11/stl.h>
#include <string>

namespace flexarm::python {

namespace py = pybind11;

response::FrequencyResponse frequency_response_of(const Formulation& formulation,
                                                  const std::vector<arm::Sensor>& sensors,
                                                  const std::vector<double>& frequency_Hz,
                                                  const FrequencyRange& range) {
  if (!frequency_Hz.empty()) {
    response::require_ascending(frequency_Hz, "frequency_Hz");
    return response::frequency_response(formulation.formulation, formulation.chain, sensors,
                                        frequency_Hz);
  }
  response::ResponseOptions options;
  options.sensors = sensors;
  options.from_Hz = range.from_Hz;
  options.to_Hz = range.to_Hz;
  options.points = range.points;
  options.modes = range.modes;
  return response::study_response(formulation.arm, formulation.formulation, options).response;
}

response::StateSpace state_space_of(const Formulation& formulation,
                                    const std::vector<arm::Sensor>& sensors,
                                    std::optional<int> modes, bool static_correction) {
  response::ResponseOptions options;
  options.sensors = sensors;
  const auto band = response::frequency_range(formulation.formulation, options);
  const auto truncation = response::truncation_in_frequency(
      formulation.formulation, sensors, response::judged_frequencies_Hz(band.from_Hz, band.to_Hz),
      static_correction,
      {modes, response::most_chosen_modes(response::name(formulation.formulation))});
  arm::ModalModel model =
      response::modal_model(formulation.formulation, truncation.modes, sensors, {});
  if (static_correction) {
    model = response::with_residual_mode(formulation.formulation, model, sensors);
  }
  response::LinearChain chain = formulation.chain;
  std::erase_if(chain.sensor_chains, [&](const response::SensorChain& one) {
    return std::ranges::find(sensors, one.sensor) == sensors.end();
  });
  response::StateSpace system = response::state_space(model, sensors, chain);
  system.truncation_errors = truncation.errors;
  return system;
}

namespace {

using response::FrequencyResponse;
using response::StateSpace;

py::array_t<std::complex<double>> all_values(const FrequencyResponse& response) {
  std::vector<std::complex<double>> values;
  for (const auto& row : response.values) values.insert(values.end(), row.begin(), row.end());
  return owned(std::move(values),
               {py::ssize_t(response.values.size()), py::ssize_t(response.frequency_Hz.size())});
}

FrequencyResponse response_of(const StateSpace& system, const Numbers& frequency_Hz) {
  FrequencyResponse response{one_dimensional(frequency_Hz, "frequency_Hz"), system.sensors, {}};
  const py::gil_scoped_release without_lock;
  response::require_ascending(response.frequency_Hz, "frequency_Hz");
  response.values.resize(system.sensors.size());
  for (const double frequency : response.frequency_Hz) {
    const auto at = response::frequency_response(system, response::on_imaginary_axis(frequency));
    for (std::size_t i = 0; i < at.size(); ++i) response.values[i].push_back(at[i]);
  }
  return response;
}

void add_frequency_response(py::module_& module) {
  py::class_<FrequencyResponse>(
      module, "FrequencyResponse",
      "Readings of sensors per commanded torque at s = i 2 pi f. response['hub_angle'] is the row "
      "of one sensor, read-only complex array (frequencies,).")
      .def_property_readonly("frequency_Hz", view_of(&FrequencyResponse::frequency_Hz),
                             "f [Hz], read-only array (frequencies,).")
      .def_property_readonly(
          "sensors", [](const FrequencyResponse& self) { return names_of(self.sensors); },
          "Names of the sensors.")
      .def_property_readonly(
          "units", [](const FrequencyResponse& self) { return units_of(self.sensors); },
          "Their units; values are in these per N m.")
      .def_property_readonly("values", &all_values, "Complex array (sensors, frequencies).")
      .def("__getitem__",
           [](const py::object& self, const std::string& sensor) {
             const auto& response = self.cast<const FrequencyResponse&>();
             return view<std::complex<double>>(response.values[place_of(sensor, response.sensors)],
                                               self);
           })
      .def("__len__", [](const FrequencyResponse& self) { return self.frequency_Hz.size(); })
      .def("__repr__", [](const FrequencyResponse& self) {
        return fmt::format("<flexarm.FrequencyResponse of {}: {} frequencies, {:.6g} to {:.6g} Hz>",
                           fmt::join(texts_of(self.sensors), ", "), self.frequency_Hz.size(),
                           self.frequency_Hz.front(), self.frequency_Hz.back());
      });
}

/// What `compute` returns, computed without the interpreter's lock.
auto without_lock(const auto& compute) {
  const py::gil_scoped_release released;
  return compute();
}

/// The getter of a matrix of a state space.
auto matrix(Eigen::MatrixXd StateSpace::*member) {
  return [member](const py::object& self) {
    return view(self.cast<const StateSpace&>().*member, self);
  };
}

void add_state_space(py::module_& module) {
  py::class_<StateSpace>(
      module, "StateSpace",
      "x' = A x + B tau(t - delay_s), y = C x + D tau(t - delay_s): commanded torque [N m] to "
      "sensors. The reading of sensor k is y_k(t - output_delay_s[k]). Matrices are read-only "
      "arrays without a copy.")
      .def_property_readonly("A", matrix(&StateSpace::a), "Array (states, states).")
      .def_property_readonly("B", matrix(&StateSpace::b), "Array (states, 1).")
      .def_property_readonly("C", matrix(&StateSpace::c), "Array (sensors, states).")
      .def_property_readonly("D", matrix(&StateSpace::d), "Array (sensors, 1).")
      .def_readonly("delay_s", &StateSpace::delay_s, "Delay of the torque [s].")
      .def_property_readonly(
          "output_delay_s",
          [](const StateSpace& self) {
            return owned(
                std::vector<double>(self.output_delay_s.begin(), self.output_delay_s.end()));
          },
          "Delays of the sensors [s], array (sensors,).")
      .def_readonly("truncation_errors", &StateSpace::truncation_errors,
                    "Of each sensor, from well below the first pole to above the fifth: root mean "
                    "square of |G_ss - G|/|G|, list of float.")
      .def_readonly("states", &StateSpace::states,
                    "Names of the states: q_0, q_0', q_1, ..., 'hub torque', 'reading of ...'.")
      .def_property_readonly(
          "sensors", [](const StateSpace& self) { return names_of(self.sensors); },
          "Names of the sensors, rows of C and D.")
      .def_property_readonly(
          "units", [](const StateSpace& self) { return units_of(self.sensors); }, "Their units.")
      .def("frequency_response", &response_of, py::arg("frequency_Hz"),
           "Of this state space, delays included, at ascending frequencies [Hz]: "
           "FrequencyResponse.\n\nArguments:\n  frequency_Hz: f [Hz], array (frequencies,)")
      .def(
          "poles",
          [](const StateSpace& self) {
            return owned(without_lock([&] { return response::poles(self); }));
          },
          "Poles s [rad/s], the eigenvalues of A, ascending in |s|: complex array (states,).")
      .def(
          "zeros",
          [](const StateSpace& self, const std::optional<std::string>& name) {
            const arm::Sensor sensor =
                self.sensors[name ? place_of(*name, self.sensors) : std::size_t(0)];
            return owned(without_lock([&] { return response::zeros(self, sensor); }));
          },
          py::arg("sensor") = py::none(),
          "Finite zeros s [rad/s] from the torque to a sensor, ascending in |s|: complex array "
          "(zeros,). Those of few modes are not those of the arm: Formulation.zeros has them.\n\n"
          "Arguments:\n  sensor: its name; None: the first")
      .def("__repr__", [](const StateSpace& self) {
        return fmt::format("<flexarm.StateSpace: torque to {}, {} states>",
                           fmt::join(texts_of(self.sensors), ", "), self.states.size());
      });
}

}  // namespace

void add_responses(py::module_& module) {
  add_frequency_response(module);
  add_state_space(module);
  add_pickle<FrequencyResponse, StateSpace>();
}

}  // namespace flexarm::python
