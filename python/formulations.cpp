#include "python/formulations.hpp"

#include "arm/rigid_hub.hpp"
#include "python/argument_names.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"
#include "python/responses.hpp"
#include "python/roots.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_choice.hpp"

#include <fmt/format.h>

#include <complex>
#include <pybind11/complex.h>
#include <pybind11/stl.h>
#include <utility>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using Complex = std::complex<double>;
using WithoutLock = py::call_guard<py::gil_scoped_release>;

constexpr int kRoots = 10;
constexpr int kModes = 5;
constexpr int kPoints = 400;

/// The formulation as commands make it, of an arm with a beam: one without is a RigidHub.
Formulation made_with_beam(const arm::Arm& whole, response::FormulationChoice choice,
                           int roots = kRoots) {
  arm::require_beam(whole, choice.name);
  choice.spelled = [](std::string_view name) {
    return name == "modes" ? std::string("roots") : as_argument(name);
  };
  auto chosen = choice.make(whole, roots);
  return {whole, std::move(chosen.formulation), response::linear_chain(response::take_apart(whole)),
          std::move(chosen.settings)};
}

Formulation rigid_hub(const arm::Arm& whole) {
  return {whole, response::RigidHub(response::take_apart(whole).linear),
          response::linear_chain(response::take_apart(whole)), ""};
}

Modes modal_model(const Formulation& formulation, int count,
                  const std::vector<arm::Sensor>& sensors, std::vector<double> stations_m) {
  return {response::modal_model(formulation.formulation, count, sensors, stations_m), sensors,
          std::move(stations_m)};
}

py::object transfer_function(const Formulation& formulation, const std::string& sensor_name,
                             const ComplexNumbers& s_rad_per_s) {
  const arm::Sensor sensor = arm::parse_sensor(sensor_name);
  std::vector<Complex> values(static_cast<std::size_t>(s_rad_per_s.size()));
  const Complex* s = s_rad_per_s.data();
  {
    const py::gil_scoped_release without_lock;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = response::transfer_function(formulation.formulation, sensor, s[i]);
    }
  }
  if (s_rad_per_s.ndim() == 0) return py::cast(values.front());
  return owned(std::move(values), {s_rad_per_s.shape(), s_rad_per_s.shape() + s_rad_per_s.ndim()});
}

void add_base(py::module_& module) {
  py::class_<Formulation>(
      module, "Formulation",
      "A model of an arm: ExactTransferFunction, FiniteElements, AssumedModes or RigidHub. It does "
      "not change, and may be used by several threads at once. Its methods raise InputError for a "
      "sensor that the arm cannot carry and for a count below 1 or above what the formulation "
      "takes. Roots and modes are those of the linear arm; the effects of torque path and sensors "
      "act in frequency responses and state spaces.")
      .def_property_readonly(
          "name",
          [](const Formulation& self) { return std::string(response::name(self.formulation)); },
          "'exact_tf', 'fem', 'assumed_modes' or 'rigid_hub'.")
      .def_property_readonly(
          "arm", [](const Formulation& self) { return self.arm; }, "The arm, with all effects.")
      .def_readonly("settings", &Formulation::settings,
                    "'4 elements of degree 11'; '' where there are none.")
      .def_property_readonly(
          "degrees_of_freedom",
          [](const Formulation& self) { return response::degrees_of_freedom(self.formulation); },
          "Generalised coordinates, hub rotation included; 0 for exact_tf.")
      .def(
          "poles",
          [](const Formulation& self, int count) {
            return response::poles(self.formulation, count);
          },
          py::arg("count") = kModes, WithoutLock(),
          "The lowest undamped flexible poles: Poles.\n\nArguments:\n  count: how many, 1 or more")
      .def(
          "damped_poles",
          [](const Formulation& self, int count) {
            return response::damped_poles(self.formulation, count);
          },
          py::arg("count") = kModes, WithoutLock(),
          "The poles with all linear damping: DampedPoles.\n\nArguments:\n  count: of pairs, 1 or "
          "more")
      .def(
          "zeros",
          [](const Formulation& self, const std::string& sensor_name, int count) {
            const arm::Sensor sensor = arm::parse_sensor(sensor_name);
            return SensorZeros{sensor, response::zeros(self.formulation, sensor, count)};
          },
          py::arg("sensor"), py::arg("count") = kModes, WithoutLock(),
          "The zeros of torque to a sensor that are smallest in |s|: Zeros.\n\nArguments:\n"
          "  sensor: its name, 'hub_angle', 'strain@0.05'\n  count: how many, 1 or more")
      .def(
          "modes",
          [](const Formulation& self, int count, const py::object& sensors,
             const Numbers& stations_m) {
            const auto chosen = sensors_of(sensors);
            auto stations = one_dimensional(stations_m, "stations_m");
            const py::gil_scoped_release without_lock;
            return modal_model(self, count, chosen, std::move(stations));
          },
          py::arg("count") = kModes, py::arg("sensors") = py::tuple(),
          py::arg("stations_m") = py::tuple(),
          "The lowest (rigid-body) mode and `count` flexible ones with their values at sensors and "
          "at places along the beam: Modes.\n\nArguments:\n"
          "  count: of flexible modes\n  sensors: names of sensors\n"
          "  stations_m: distances from the motor axis [m], array (stations,)")
      .def("transfer_function", &transfer_function, py::arg("sensor"), py::arg("s_rad_per_s"),
           "Response of a sensor per torque on the hub at complex frequencies s [rad/s], damping "
           "included: complex array of the shape of s, or a number, in the unit of the sensor per "
           "N m. Raises ValueError at s = 0 of an arm with a free hub. Near a pole it is huge or "
           "not finite.\n\nArguments:\n  sensor: its name\n"
           "  s_rad_per_s: s [rad/s], complex, of any shape")
      .def(
          "frequency_response",
          [](const Formulation& self, const py::object& sensors, const Numbers& frequency_Hz,
             std::optional<double> from_Hz, std::optional<double> to_Hz, int points, int modes) {
            const auto chosen = sensors_or_default(sensors, self.arm);
            const auto frequencies = one_dimensional(frequency_Hz, "frequency_Hz");
            const py::gil_scoped_release without_lock;
            return frequency_response_of(self, chosen, frequencies,
                                         {from_Hz, to_Hz, points, modes});
          },
          py::arg("sensors") = py::none(), py::arg("frequency_Hz") = py::tuple(), py::kw_only(),
          py::arg("from_Hz") = py::none(), py::arg("to_Hz") = py::none(),
          py::arg("points") = kPoints, py::arg("modes") = kModes,
          "Readings per commanded torque at ascending frequencies [Hz], array (frequencies,): "
          "FrequencyResponse, with the linear effects of torque path and sensors.\n\nArguments:\n"
          "  sensors: names; None: hub_angle and, with a beam, tip_acceleration\n"
          "  frequency_Hz: f [Hz], array (frequencies,); none: those of `flexarm response`, more "
          "around poles and zeros\n"
          "  from_Hz: lowest of those [Hz]; None: below the first pole\n"
          "  to_Hz: highest of those [Hz]; None: above the last of `modes` poles\n"
          "  points: how many, at least\n"
          "  modes: poles that the frequencies cover")
      .def(
          "state_space",
          [](const Formulation& self, const py::object& sensors, std::optional<int> modes,
             bool static_correction) {
            const auto chosen = sensors_or_default(sensors, self.arm);
            const py::gil_scoped_release without_lock;
            return state_space_of(self, chosen, modes, static_correction);
          },
          py::arg("sensors") = py::none(), py::kw_only(), py::arg("modes") = py::none(),
          py::arg("static_correction") = true,
          "Commanded torque [N m] to sensors as StateSpace, of the lowest mode and some flexible "
          "ones.\n\nArguments:\n"
          "  sensors: names; None: hub_angle and, with a beam, tip_acceleration\n"
          "  modes: flexible modes; None: as many as keep truncation_errors below 1e-4, 160 at "
          "most\n"
          "  static_correction: whether a residual mode stands for the omitted ones")
      .def("__repr__", [](const py::object& self) {
        const auto& formulation = self.cast<const Formulation&>();
        return fmt::format(
            "<flexarm.{} of '{}'{}{}>", py::type::of(self).attr("__name__").cast<std::string>(),
            formulation.arm.name, formulation.settings.empty() ? "" : ": ", formulation.settings);
      });
}

}  // namespace

ExactTransferFunction::ExactTransferFunction(const arm::Arm& whole)
    : Formulation(made_with_beam(whole, {.name = "exact_tf"})) {}

FiniteElements::FiniteElements(const arm::Arm& whole, std::optional<int> elements,
                               std::optional<int> degree, int roots)
    : Formulation(
          made_with_beam(whole, {.name = "fem", .elements = elements, .degree = degree}, roots)) {}

AssumedModes::AssumedModes(const arm::Arm& whole, std::optional<int> functions,
                           const std::optional<std::string>& basis, int roots)
    : Formulation(made_with_beam(
          whole, {.name = "assumed_modes", .basis = basis, .functions = functions}, roots)) {}

RigidHub::RigidHub(const arm::Arm& whole) : Formulation(rigid_hub(whole)) {}

void add_formulations(py::module_& module) {
  add_base(module);
  py::class_<ExactTransferFunction, Formulation>(
      module, "ExactTransferFunction",
      "The exact transcendental transfer function (exact_tf): its roots are counted and found to "
      "rounding. Raises InputError for an arm that it does not take.\n\nArguments:\n  arm: the Arm")
      .def(py::init<const arm::Arm&>(), py::arg("arm"), WithoutLock());
  py::class_<FiniteElements, Formulation>(
      module, "FiniteElements",
      "Euler-Bernoulli finite elements of Hermite shape functions (fem). Raises InputError for an "
      "arm or a setting that it does not take.\n\nArguments:\n  arm: the Arm\n"
      "  elements: number of elements; None: by `roots`\n"
      "  degree: of the shape functions, 3 to 25; None: by `roots`\n"
      "  roots: number of poles and zeros that the settings keep within 1e-10 or so of exact")
      .def(py::init<const arm::Arm&, std::optional<int>, std::optional<int>, int>(), py::arg("arm"),
           py::kw_only(), py::arg("elements") = py::none(), py::arg("degree") = py::none(),
           py::arg("roots") = kRoots, WithoutLock());
  py::class_<AssumedModes, Formulation>(
      module, "AssumedModes",
      "Lagrange's equations on admissible functions (assumed_modes). Raises InputError for an arm "
      "or "
      "a setting that it does not take.\n\nArguments:\n  arm: the Arm\n"
      "  functions: number of functions; None: by `roots`\n"
      "  basis: 'legendre', 'clamped_free', 'pinned_free' or 'clamped_with_payload'; None: "
      "legendre\n"
      "  roots: number of poles and zeros that the settings keep within 1e-10 or so of exact")
      .def(py::init<const arm::Arm&, std::optional<int>, const std::optional<std::string>&, int>(),
           py::arg("arm"), py::kw_only(), py::arg("functions") = py::none(),
           py::arg("basis") = py::none(), py::arg("roots") = kRoots, WithoutLock());
  py::class_<RigidHub, Formulation>(
      module, "RigidHub",
      "An arm without a beam, in closed form: one mode, no flexible poles, no zeros. Raises "
      "InputError for an arm with a beam.\n\nArguments:\n  arm: the Arm")
      .def(py::init<const arm::Arm&>(), py::arg("arm"), WithoutLock());
}

}  // namespace flexarm::python
