#include "arm/controller.hpp"
#include "arm/input_error.hpp"
#include "measured/files/controller_keys.hpp"
#include "python/archive.hpp"
#include "python/arm.hpp"
#include "python/module.hpp"

#include <fmt/format.h>

#include <optional>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <string>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using Rows = arm::StateSpaceController::Rows;

arm::Controller pid(double kp, double kd, double ki, const std::string& sensor,
                    const std::string& derivative, std::optional<double> limit_N_m,
                    std::optional<double> sample_time_s) {
  using Derivative = arm::PidController::Derivative;
  if (derivative != "error" && derivative != "measurement") {
    throw arm::InputError(
        fmt::format("derivative {}: must be error or measurement", arm::shown(derivative)));
  }
  const auto of = derivative == "error" ? Derivative::error : Derivative::measurement;
  arm::Controller made{
      {arm::parse_sensor(sensor)}, arm::PidController{kp, kd, ki, of}, limit_N_m, sample_time_s};
  arm::require_valid(made);
  return made;
}

arm::Controller state_space(const Rows& a, const Rows& b, const Rows& c, const Rows& d,
                            const py::object& sensors, std::optional<double> limit_N_m,
                            std::optional<double> sample_time_s) {
  arm::Controller made{sensors_of(sensors), arm::StateSpaceController{a, b, c, d}, limit_N_m,
                       sample_time_s};
  arm::require_valid(made);
  return made;
}

}  // namespace

void add_controllers(py::module_& module) {
  py::class_<arm::Controller>(
      module, "Controller",
      "A sampled controller that makes the torque of a reference and of what sensors read.")
      .def_static("pid", &pid, py::arg("kp") = 0.0, py::arg("kd") = 0.0, py::arg("ki") = 0.0,
                  py::kw_only(), py::arg("sensor") = "hub_angle", py::arg("derivative") = "error",
                  py::arg("limit_N_m") = py::none(), py::arg("sample_time_s") = py::none(),
                  "Discrete PID of one sensor. Raises InputError for numbers out of range.\n\n"
                  "Arguments:\n"
                  "  kp: gain [N m per unit of the sensor]\n"
                  "  kd: gain [N m s per unit of the sensor]\n"
                  "  ki: gain [N m/s per unit of the sensor]\n"
                  "  sensor: its name\n"
                  "  derivative: of the 'error' or the 'measurement'\n"
                  "  limit_N_m: of the torque [N m]; None: none\n"
                  "  sample_time_s: period [s]; None: that of the record")
      .def_static("state_space", &state_space, py::arg("A"), py::arg("B"), py::arg("C"),
                  py::arg("D"), py::kw_only(), py::arg("sensors") = "hub_angle",
                  py::arg("limit_N_m") = py::none(), py::arg("sample_time_s") = py::none(),
                  "u_k = C x_k + D w_k, x_(k+1) = A x_k + B w_k with w = (reference, sensors). "
                  "Raises InputError for matrices that do not fit together.\n\nArguments:\n"
                  "  A: matrix by rows, (n, n)\n  B: (n, 1 + sensors)\n  C: (1, n)\n"
                  "  D: (1, 1 + sensors)\n  sensors: names\n"
                  "  limit_N_m: of the torque [N m]; None: none\n"
                  "  sample_time_s: period [s]; None: that of the record")
      .def_static(
          "read", &measured::read_controller_file, py::arg("path"),
          "Reads a controller file (TOML, docs/formats.md). Raises InputError.\n\nArguments:\n"
          "  path: its path")
      .def("__repr__", [](const arm::Controller& controller) {
        return fmt::format("<flexarm.Controller {}>", measured::format_controller(controller));
      });
  add_pickle<arm::Controller>();
}

}  // namespace flexarm::python
