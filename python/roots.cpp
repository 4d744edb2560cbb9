#include "python/roots.hpp"

#include "python/archive.hpp"
#include "python/arm.hpp"
#include "python/arrays.hpp"
#include "python/module.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <pybind11/complex.h>
#include <pybind11/stl.h>
#include <string>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using Complex = std::complex<double>;

constexpr double kTwoPi = 2.0 * std::numbers::pi;
/// Numbers that a representation shows.
constexpr std::size_t kShown = 6;

/// "11.8618, 32.2606, ..."
std::string shown_Hz(const std::vector<double>& omega_rad_per_s) {
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, omega_rad_per_s.size()); ++i) {
    text += fmt::format("{}{:.6g}", i == 0 ? "" : ", ", omega_rad_per_s[i] / kTwoPi);
  }
  return omega_rad_per_s.size() > kShown ? text + ", ..." : text;
}

py::array_t<double> frequencies(const std::vector<double>& omega_rad_per_s) {
  std::vector<double> frequency_Hz;
  frequency_Hz.reserve(omega_rad_per_s.size());
  for (const double omega : omega_rad_per_s) frequency_Hz.push_back(omega / kTwoPi);
  return owned(std::move(frequency_Hz));
}

std::vector<double> sizes(const std::vector<Complex>& roots) {
  std::vector<double> sizes;
  sizes.reserve(roots.size());
  for (const Complex& s : roots) sizes.push_back(std::abs(s));
  return sizes;
}

/// Undamped natural frequency of a pair, its geometric mean where both are real.
double natural_rad_per_s(const arm::PolePair& pair) {
  return std::sqrt(std::abs(pair.first_rad_per_s) * std::abs(pair.second_rad_per_s));
}

std::vector<double> natural_frequencies(const arm::DampedPoleSet& poles) {
  std::vector<double> omega_rad_per_s;
  for (const auto& pair : poles.flexible) omega_rad_per_s.push_back(natural_rad_per_s(pair));
  return omega_rad_per_s;
}

std::vector<double> damping_ratios(const arm::DampedPoleSet& poles) {
  std::vector<double> ratios;
  for (const auto& pair : poles.flexible) {
    ratios.push_back(-(pair.first_rad_per_s + pair.second_rad_per_s).real() /
                     (2.0 * natural_rad_per_s(pair)));
  }
  return ratios;
}

std::vector<Complex> both(const std::vector<arm::PolePair>& pairs) {
  std::vector<Complex> roots;
  for (const auto& pair : pairs) {
    roots.push_back(pair.first_rad_per_s);
    roots.push_back(pair.second_rad_per_s);
  }
  return roots;
}

void add_summaries(py::module_& module) {
  py::class_<arm::SolveSummary>(module, "SolveSummary", "What an iterative search says of itself.")
      .def_readonly("method", &arm::SolveSummary::method, "The method.")
      .def_readonly("iterations", &arm::SolveSummary::iterations,
                    "Iterations, or function values where those are counted.")
      .def_readonly("largest_residual", &arm::SolveSummary::largest_residual,
                    "In the sense that `method` states; 0 where none is formed.")
      .def_readonly("converged", &arm::SolveSummary::converged, "Whether it converged.")
      .def("__repr__", [](const arm::SolveSummary& summary) {
        return fmt::format("<flexarm.SolveSummary {}: {} iterations, {}>", summary.method,
                           summary.iterations, summary.converged ? "converged" : "not converged");
      });
  py::class_<arm::RootCount>(module, "RootCount",
                             "How many roots were found and how many there are.")
      .def_readonly("found", &arm::RootCount::found, "Roots that were found.")
      .def_property_readonly(
          "expected",
          [](const arm::RootCount& count) {
            return count.expected < 0 ? std::optional<int>() : count.expected;
          },
          "Roots that a count by `method` gives; None where nothing counted them.")
      .def_readonly("method", &arm::RootCount::method, "'Wittrick-Williams', ...")
      .def("__repr__", [](const arm::RootCount& count) {
        return fmt::format("<flexarm.RootCount {} found, {} expected>", count.found,
                           count.expected < 0 ? "unknown" : fmt::to_string(count.expected));
      });
}

void add_poles(py::module_& module) {
  using arm::DampedPoleSet;
  using arm::PoleSet;
  py::class_<PoleSet>(
      module, "Poles",
      "Undamped flexible poles s = +-i omega, ascending. The lowest mode of the arm "
      "is counted apart.")
      .def_property_readonly("omega_rad_per_s", view_of(&PoleSet::omega_rad_per_s),
                             "omega [rad/s], read-only array (count,).")
      .def_property_readonly(
          "frequency_Hz", [](const PoleSet& poles) { return frequencies(poles.omega_rad_per_s); },
          "omega/(2 pi) [Hz], array (count,).")
      .def_readonly("lowest_omega_squared_rad2_per_s2", &PoleSet::lowest_omega_squared_rad2_per_s2,
                    "omega^2 of the lowest mode [rad^2/s^2]: 0 for a free hub, below 0 for an "
                    "inverted arm.")
      .def_readonly("count", &PoleSet::count, "RootCount.")
      .def_readonly("summary", &PoleSet::summary, "SolveSummary.")
      .def("__len__", [](const PoleSet& poles) { return poles.omega_rad_per_s.size(); })
      .def("__repr__", [](const PoleSet& poles) {
        return fmt::format("<flexarm.Poles, undamped: {} Hz>", shown_Hz(poles.omega_rad_per_s));
      });
  py::class_<DampedPoleSet>(module, "DampedPoles",
                            "Poles of the damped arm, two for each mode, in the order of Poles: "
                            "conjugates, the first with Im s > 0, or two real ones, the first the "
                            "nearer to 0.")
      .def_property_readonly(
          "s_rad_per_s",
          [](const DampedPoleSet& poles) {
            return owned(both(poles.flexible), {py::ssize_t(poles.flexible.size()), 2});
          },
          "s [rad/s], complex array (count, 2).")
      .def_property_readonly(
          "lowest_s_rad_per_s",
          [](const DampedPoleSet& poles) { return owned(both({poles.lowest})); },
          "s of the lowest mode [rad/s], complex array (2,).")
      .def_property_readonly(
          "frequency_Hz",
          [](const DampedPoleSet& poles) { return frequencies(natural_frequencies(poles)); },
          "Undamped natural frequency |s|/(2 pi) [Hz], of two real poles their geometric mean, "
          "array (count,).")
      .def_property_readonly(
          "damping_ratio", [](const DampedPoleSet& poles) { return owned(damping_ratios(poles)); },
          "Damping ratio [1], above 1 for two real poles, array (count,).")
      .def_readonly("summary", &DampedPoleSet::summary, "SolveSummary.")
      .def("__len__", [](const DampedPoleSet& poles) { return poles.flexible.size(); })
      .def("__repr__", [](const DampedPoleSet& poles) {
        return fmt::format("<flexarm.DampedPoles: {} Hz>", shown_Hz(natural_frequencies(poles)));
      });
}

void add_zeros(py::module_& module) {
  using arm::RejectedZero;
  py::class_<RejectedZero>(module, "RejectedZero",
                           "A root of a discrete zero problem that is not a zero of the arm.")
      .def_readonly("s_rad_per_s", &RejectedZero::s_rad_per_s, "s [rad/s].")
      .def_readonly("relative_change", &RejectedZero::relative_change,
                    "Distance to the nearest root of the checking discretisation, relative [1].")
      .def_readonly("reason", &RejectedZero::reason, "Why.")
      .def("__repr__", [](const RejectedZero& zero) {
        return fmt::format("<flexarm.RejectedZero s = {:.6g}{:+.6g}j rad/s: {}>",
                           zero.s_rad_per_s.real(), zero.s_rad_per_s.imag(), zero.reason);
      });
  py::class_<SensorZeros>(
      module, "Zeros",
      "Undamped finite zeros of torque to one sensor, ascending in |s|, those "
      "at s = 0 left out: one of each pair +-s or quadruple +-s, +-conj(s), with "
      "Re s >= 0 and Im s >= 0.")
      .def_property_readonly(
          "sensor", [](const SensorZeros& set) { return arm::to_string(set.sensor); },
          "The sensor's name.")
      .def_property_readonly(
          "s_rad_per_s",
          [](const py::object& self) {
            return view<Complex>(self.cast<const SensorZeros&>().zeros.s_rad_per_s, self);
          },
          "s [rad/s], read-only complex array (count,).")
      .def_property_readonly(
          "frequency_Hz",
          [](const SensorZeros& set) { return frequencies(sizes(set.zeros.s_rad_per_s)); },
          "|s|/(2 pi) [Hz], array (count,).")
      .def_property_readonly(
          "is_non_minimum_phase",
          [](const SensorZeros& set) {
            py::array_t<bool> is(static_cast<py::ssize_t>(set.zeros.s_rad_per_s.size()));
            for (std::size_t i = 0; i < set.zeros.s_rad_per_s.size(); ++i) {
              is.mutable_data()[i] = set.zeros.s_rad_per_s[i].real() > 0.0;
            }
            return is;
          },
          "Whether a zero of the pair is in the right half plane, bool array (count,).")
      .def_property_readonly(
          "rejected", [](const SensorZeros& set) { return set.zeros.rejected; },
          "Spurious roots of a discrete formulation, a list of RejectedZero.")
      .def_property_readonly(
          "infinite", [](const SensorZeros& set) { return set.zeros.infinite; },
          "Infinite roots of a discrete formulation.")
      .def_property_readonly(
          "count", [](const SensorZeros& set) { return set.zeros.count; }, "RootCount.")
      .def_property_readonly(
          "summary", [](const SensorZeros& set) { return set.zeros.summary; }, "SolveSummary.")
      .def("__len__", [](const SensorZeros& set) { return set.zeros.s_rad_per_s.size(); })
      .def("__repr__", [](const SensorZeros& set) {
        return fmt::format("<flexarm.Zeros of {}: {} Hz>", arm::to_string(set.sensor),
                           shown_Hz(sizes(set.zeros.s_rad_per_s)));
      });
}

/// One number of each mode, in an array.
template <class Value>
py::array_t<double> of_modes(const Modes& modes, Value value) {
  std::vector<double> values;
  for (const auto& mode : modes.model.modes) values.push_back(value(mode));
  return owned(std::move(values));
}

/// A list of numbers of each mode, a row a mode.
py::array_t<double> rows_of_modes(const Modes& modes, std::vector<double> arm::Mode::*member,
                                  std::size_t columns) {
  std::vector<double> values;
  for (const auto& mode : modes.model.modes) {
    values.insert(values.end(), (mode.*member).begin(), (mode.*member).end());
  }
  return owned(std::move(values), {py::ssize_t(modes.model.modes.size()), py::ssize_t(columns)});
}

void add_modes(py::module_& module) {
  py::class_<Modes>(
      module, "Modes",
      "Modes of the undamped arm, scaled to the modal mass I_T: the lowest (rigid-body) mode, then "
      "the flexible ones, ascending. The arm in these modes:\n\n"
      "    q_i'' + sum_j D_ij q_j' + omega_i^2 q_i = hub_slope_i tau/I_T")
      .def_property_readonly(
          "modal_mass_kg_m2", [](const Modes& modes) { return modes.model.modal_mass_kg_m2; },
          "I_T [kg m^2].")
      .def_property_readonly(
          "omega_rad_per_s",
          [](const Modes& modes) {
            return of_modes(modes, [](const arm::Mode& mode) { return mode.omega_rad_per_s; });
          },
          "omega [rad/s], array (modes,); 0 for a lowest mode that nothing holds, or that falls.")
      .def_property_readonly(
          "frequency_Hz",
          [](const Modes& modes) {
            return of_modes(modes,
                            [](const arm::Mode& mode) { return mode.omega_rad_per_s / kTwoPi; });
          },
          "omega/(2 pi) [Hz], array (modes,).")
      .def_property_readonly(
          "lowest_omega_squared_rad2_per_s2",
          [](const Modes& modes) { return modes.model.lowest_omega_squared_rad2_per_s2; },
          "omega^2 of the lowest mode [rad^2/s^2], below 0 for an inverted arm.")
      .def_property_readonly(
          "hub_slope",
          [](const Modes& modes) {
            return of_modes(modes, [](const arm::Mode& mode) { return mode.hub_slope; });
          },
          "Rotation of the hub [1], array (modes,).")
      .def_property_readonly(
          "damping_ratio",
          [](const Modes& modes) {
            return of_modes(modes, [](const arm::Mode& mode) { return mode.damping_ratio; });
          },
          "Projected damping ratio D_ii/(2 omega_i) [1], array (modes,); 0 where omega is 0.")
      .def_property_readonly(
          "damping_rad_per_s",
          [](const py::object& self) {
            const auto& model = self.cast<const Modes&>().model;
            const auto size = static_cast<py::ssize_t>(model.modes.size());
            return view<double>(model.damping_rad_per_s, self).reshape({size, size});
          },
          "D [rad/s], symmetric array (modes, modes).")
      .def_property_readonly(
          "sensors", [](const Modes& modes) { return names_of(modes.sensors); },
          "Names of the sensors, columns of `sensor_values`.")
      .def_property_readonly(
          "sensor_values",
          [](const Modes& modes) {
            return rows_of_modes(modes, &arm::Mode::sensor_values, modes.sensors.size());
          },
          "Values at the sensors before time derivatives, in their units, array (modes, sensors).")
      .def_property_readonly("stations_m", view_of(&Modes::stations_m),
                             "Places along the beam [m], columns of `displacement_m`.")
      .def_property_readonly(
          "displacement_m",
          [](const Modes& modes) {
            return rows_of_modes(modes, &arm::Mode::displacement_m, modes.stations_m.size());
          },
          "Mode shapes phi [m], array (modes, stations).")
      .def("__len__", [](const Modes& modes) { return modes.model.modes.size(); })
      .def("__repr__", [](const Modes& modes) {
        std::vector<double> omega;
        for (const auto& mode : modes.model.modes) omega.push_back(mode.omega_rad_per_s);
        return fmt::format("<flexarm.Modes: {} Hz>", shown_Hz(omega));
      });
}

}  // namespace

void add_roots(py::module_& module) {
  add_summaries(module);
  add_poles(module);
  add_zeros(module);
  add_modes(module);
  add_pickle<arm::SolveSummary, arm::RootCount, arm::PoleSet, arm::DampedPoleSet, arm::RejectedZero,
             SensorZeros, Modes>();
}

}  // namespace flexarm::python
