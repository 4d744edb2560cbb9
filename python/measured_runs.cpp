#include "python/measured_runs.hpp"

#include "arm/input_error.hpp"
#include "arm/range.hpp"
#include "arm/read_word.hpp"
#include "experiment/run_choice.hpp"
#include "python/archive.hpp"
#include "python/arrays.hpp"
#include "python/given_columns.hpp"
#include "python/records.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <pybind11/stl.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::python {

namespace py = pybind11;

namespace {

using arm::InputError;
using measured::ModalEntry;
using OptionalNumber = std::optional<double>;

/// An argument as T, which `allowed` describes. Throws py::type_error, one line, for any other.
template <class T>
T argument(const char* name, const py::object& given, const char* allowed) {
  try {
    return given.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(
        fmt::format("{} = {}: must be {}", name, std::string(py::repr(given)), allowed));
  }
}

/// The facts that a run of any kind has, as given.
struct RunFacts {
  const py::object& id;
  const py::object& purpose;
  const py::object& payload_mass_kg;
  const py::object& payload_inertia_kg_m2;
};

measured::Run run_of(measured::RunKind kind, const RunFacts& facts) {
  const auto id = argument<std::string>("id", facts.id, "text");
  const auto purpose =
      argument<std::string>("purpose", facts.purpose, "'estimation', 'validation' or ''");
  const auto payload_mass_kg =
      argument<OptionalNumber>("payload_mass_kg", facts.payload_mass_kg, "a number [kg] or None");
  const auto payload_inertia_kg_m2 = argument<OptionalNumber>(
      "payload_inertia_kg_m2", facts.payload_inertia_kg_m2, "a number [kg m^2] or None");
  measured::Run run;
  run.id = experiment::require_id(id);
  run.kind = kind;
  run.file = id + ".csv";
  if (!purpose.empty()) run.purpose = experiment::read_purpose(purpose);
  if (payload_mass_kg || payload_inertia_kg_m2) {
    run.payload = arm::Payload{payload_mass_kg.value_or(0.0), payload_inertia_kg_m2.value_or(0.0)};
    arm::require_in_range("payload_mass_kg", run.payload->mass_kg, "kg", arm::kNotNegative);
    arm::require_in_range("payload_inertia_kg_m2", run.payload->inertia_kg_m2, "kg m^2",
                          arm::kNotNegative);
  }
  return run;
}

TimeRun time_run(const py::object& data, const py::object& id, const py::object& sample_time_s,
                 const py::object& purpose, const py::object& payload_mass_kg,
                 const py::object& payload_inertia_kg_m2, const std::string& torque_hold,
                 const std::string& initial, const std::optional<arm::Controller>& controller,
                 const py::kwargs& columns) {
  using measured::InitialState;
  using measured::TorqueHold;
  TimeRun made{
      run_of(measured::RunKind::time, {id, purpose, payload_mass_kg, payload_inertia_kg_m2}), {}};
  made.run.torque_hold =
      arm::read_word("torque_hold", torque_hold, std::array{TorqueHold::zero, TorqueHold::first});
  made.run.initial =
      arm::read_word("initial", initial, std::array{InitialState::rest, InitialState::free});
  made.record = time_record_of(columns_of(data, columns), sample_time_s);
  if (controller) {
    made.run.controller = controller;
    made.run.reference = measured::ColumnMapping{std::string(measured::kReferenceColumn), "", 1.0};
  } else if (!made.record.reference.values.empty()) {
    throw InputError("reference: needs the controller that made the torque of it, controller=...");
  }
  measured::require_valid(made.run, made.record);
  return made;
}

FrequencyRun frequency_run(const py::object& data, const py::object& id, const py::object& purpose,
                           const py::object& payload_mass_kg,
                           const py::object& payload_inertia_kg_m2, const std::string& input,
                           const py::kwargs& columns) {
  FrequencyRun made{
      run_of(measured::RunKind::frf, {id, purpose, payload_mass_kg, payload_inertia_kg_m2}),
      frequency_record_of(columns_of(data, columns), input)};
  measured::require_valid(made.run, made.record);
  return made;
}

ModalEntry modal_entry(const std::string& feature, OptionalNumber frequency_Hz,
                       const std::optional<std::string>& sensor, std::optional<int> order,
                       OptionalNumber frequency_std_Hz, OptionalNumber damping_ratio,
                       OptionalNumber damping_ratio_std) {
  ModalEntry entry;
  entry.feature = arm::read_word("feature", feature,
                                 std::array{measured::Feature::pole, measured::Feature::zero});
  if (sensor) entry.sensor = arm::parse_sensor(*sensor);
  entry.order = order;
  entry.frequency_Hz = frequency_Hz;
  entry.frequency_std_Hz = frequency_std_Hz;
  entry.damping_ratio = damping_ratio;
  entry.damping_ratio_std = damping_ratio_std;
  return entry;
}

constexpr std::array<std::string_view, 7> kEntryArguments = {
    "feature",          "frequency_Hz",  "sensor",           "order",
    "frequency_std_Hz", "damping_ratio", "damping_ratio_std"};

/// A row of a DataFrame as the arguments of ModalEntry: NaN is what is not known.
py::dict without_nan(const py::dict& row) {
  py::dict known;
  for (const auto& [name, value] : row) {
    if (std::ranges::count(kEntryArguments, std::string(py::str(name))) == 0) {
      throw InputError(fmt::format("entries: {}: unknown; must be {}", std::string(py::str(name)),
                                   fmt::join(kEntryArguments, ", ")));
    }
    const bool is_nan = py::isinstance<py::float_>(value) && std::isnan(value.cast<double>());
    const bool is_order = name.equal(py::str("order"));  // a column with gaps has floats
    if (!is_nan)
      known[name] = is_order ? py::int_(py::reinterpret_borrow<py::object>(value)) : value;
  }
  return known;
}

ModalRun modal_run(const py::object& entries, const py::object& id, const py::object& purpose,
                   const py::object& payload_mass_kg, const py::object& payload_inertia_kg_m2) {
  ModalRun made{
      run_of(measured::RunKind::modal, {id, purpose, payload_mass_kg, payload_inertia_kg_m2}), {}};
  const bool is_frame = py::hasattr(entries, "to_dict");
  const py::object rows = is_frame ? entries.attr("to_dict")("records") : entries;
  if (!py::isinstance<py::sequence>(rows)) {
    throw py::type_error("entries: must be a list of ModalEntry or dicts, or a DataFrame");
  }
  for (const auto& row : rows) {
    const bool is_entry = py::isinstance<ModalEntry>(row);
    if (!is_entry && !py::isinstance<py::dict>(row)) {
      throw py::type_error(
          fmt::format("entries: {}; must be a ModalEntry or a dict of its arguments",
                      std::string(py::repr(row))));
    }
    const py::object entry = is_entry
                                 ? py::reinterpret_borrow<py::object>(row)
                                 : py::type::of<ModalEntry>()(**without_nan(row.cast<py::dict>()));
    made.table.push_back(entry.cast<ModalEntry>());
  }
  measured::require_valid(made.run, made.table);
  return made;
}

std::vector<arm::Sensor> sensors_in(const measured::FrequencyRecord& record) {
  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  return sensors;
}

/// The getter or method of one sensor's numbers, which are `member` of its channel.
template <class T>
auto of_channel(std::vector<T> measured::FrequencyChannel::*member) {
  return [member](const py::object& self, const std::string& sensor) {
    const auto& record = self.cast<const FrequencyRun&>().record;
    return view<T>(record.channels[place_of(sensor, sensors_in(record))].*member, self);
  };
}

template <class Class>
Class& add_run_facts(Class& type) {
  using Run = typename Class::type;
  type.def_property_readonly(
          "id", [](const Run& self) { return self.run.id; }, "Its id.")
      .def_property_readonly(
          "purpose",
          [](const Run& self) -> std::optional<std::string> {
            if (!self.run.purpose) return std::nullopt;
            return std::string(to_string(*self.run.purpose));
          },
          "'estimation' or 'validation'; None: the program chooses.")
      .def_property_readonly(
          "payload_mass_kg",
          [](const Run& self) -> OptionalNumber {
            if (!self.run.payload) return std::nullopt;
            return self.run.payload->mass_kg;
          },
          "Mass of its payload [kg]; None: that of the arm file.");
  return type;
}

constexpr const char* kRunArguments =
    "  id: its name, which names its file\n"
    "  purpose: 'estimation' or 'validation' ('': the program chooses)\n"
    "  payload_mass_kg: mass of the payload [kg] (None: that of the arm)\n"
    "  payload_inertia_kg_m2: its inertia about its centre of mass [kg m^2] (None: 0 with a "
    "mass)\n";

std::string time_run_text() {
  return "A recording in time. run['hub_angle'] is what a sensor read, read-only array (samples,) "
         "in its SI unit.\n\nArguments:\n"
         "  data: a dict or DataFrame of columns, or None; an index that has a name is one\n"
         "  **columns: arrays (samples,), each named by quantity and unit: time_s or time_ms, "
         "torque_N_m, a sensor (hub_angle_rad or hub_angle_deg, hub_velocity_rad_per_s or _rpm, "
         "tip_acceleration_m_per_s2 or _g, tip_displacement_m, tip_deflection_m, 'strain@0.05'), "
         "reference_rad. A header of a CSV file, 'hub_angle [deg]', is a name too\n"
         "  sample_time_s: sampling period [s] in place of time\n" +
         std::string(kRunArguments) +
         "  torque_hold: torque between samples, 'zero' (constant) or 'first' (linear)\n"
         "  initial: the arm at the first sample, 'rest' or 'free'\n"
         "  controller: Controller that made the torque of the reference (None: open loop)\n\n"
         "Raises InputError for a name or unit that is none, and numbers that cannot be.";
}

void add_time_run(py::module_& module) {
  auto time = py::class_<TimeRun>(module, "TimeRun", time_run_text().c_str());
  time.def(py::init(&time_run), py::arg("data") = py::none(), py::kw_only(), py::arg("id") = "run",
           py::arg("sample_time_s") = py::none(), py::arg("purpose") = "",
           py::arg("payload_mass_kg") = py::none(), py::arg("payload_inertia_kg_m2") = py::none(),
           py::arg("torque_hold") = "zero", py::arg("initial") = "rest",
           py::arg("controller") = py::none(), (column_keywords("") + "\n--\n\n").c_str());
  add_record_access(add_run_facts(time), &TimeRun::record);
  time.def_property_readonly(
          "torque_hold",
          [](const TimeRun& self) { return std::string(to_string(self.run.torque_hold)); },
          "Torque between samples: 'zero' (constant) or 'first' (linear).")
      .def_property_readonly(
          "initial", [](const TimeRun& self) { return std::string(to_string(self.run.initial)); },
          "The arm at the first sample: 'rest' or 'free'.")
      .def_property_readonly(
          "controller", [](const TimeRun& self) { return self.run.controller; },
          "The Controller that made the torque; None in open loop.")
      .def("__repr__", [](const TimeRun& self) {
        return fmt::format("<flexarm.TimeRun '{}': {} samples of {:g} s, {}>", self.run.id,
                           self.record.time_s.size(), measured::sampling_period_s(self.record),
                           fmt::join(names_of_channels(self.record), ", "));
      });
}

void add_frequency_run(py::module_& module) {
  const std::string text =
      "Measured frequency responses. run['hub_angle'] is the response of a sensor, read-only "
      "complex array (frequencies,) in its unit per N m, or per unit of the input.\n\nArguments:\n"
      "  data: a dict or DataFrame of columns, or None; an index that has a name is one\n"
      "  **columns: arrays (frequencies,): frequency_Hz, ascending; complex responses to the "
      "torque, named by sensor and unit, hub_angle_rad_per_N_m or "
      "tip_acceleration_m_per_s2_per_N_m; their coherence, hub_angle_coherence [1]\n" +
      std::string(kRunArguments) +
      "  input: 'torque'; 'hub_angle' or 'hub_velocity' of responses to the motion of the hub, "
      "which are named tip_displacement_m_per_rad or tip_displacement_m_per_rad_per_s\n"
      "\nRaises InputError for a name or unit that is none, and numbers that cannot be.";
  auto frequency = py::class_<FrequencyRun>(module, "FrequencyRun", text.c_str());
  add_run_facts(frequency)
      .def(py::init(&frequency_run), py::arg("data") = py::none(), py::kw_only(),
           py::arg("id") = "run", py::arg("purpose") = "", py::arg("payload_mass_kg") = py::none(),
           py::arg("payload_inertia_kg_m2") = py::none(), py::arg("input") = "torque",
           ("frequency_Hz=None, " + column_keywords("_per_N_m") + "\n--\n\n").c_str())
      .def_property_readonly(
          "sensors", [](const FrequencyRun& self) { return names_of(sensors_in(self.record)); },
          "Names of the sensors.")
      .def_property_readonly(
          "units", [](const FrequencyRun& self) { return units_of(sensors_in(self.record)); },
          "Their units; responses are in these per N m, or per unit of the input.")
      .def_property_readonly(
          "input", [](const FrequencyRun& self) { return measured::name_of_input(self.record); },
          "'torque', 'hub_angle' or 'hub_velocity'.")
      .def("__getitem__", of_channel(&measured::FrequencyChannel::response))
      .def("frequency_Hz", of_channel(&measured::FrequencyChannel::frequency_Hz), py::arg("sensor"),
           "f of a sensor's response [Hz], read-only array (frequencies,).\n\nArguments:\n"
           "  sensor: its name")
      .def("coherence", of_channel(&measured::FrequencyChannel::coherence), py::arg("sensor"),
           "Coherence [1] of a sensor's response, NaN where unknown, read-only array "
           "(frequencies,).\n\nArguments:\n  sensor: its name")
      .def("__repr__", [](const FrequencyRun& self) {
        return fmt::format("<flexarm.FrequencyRun '{}': {}>", self.run.id,
                           fmt::join(texts_of(sensors_in(self.record)), ", "));
      });
}

void add_modal_run(py::module_& module) {
  py::class_<ModalEntry>(
      module, "ModalEntry",
      "A measured pole or zero; None: not known.\n\nArguments:\n"
      "  feature: 'pole' or 'zero'\n"
      "  frequency_Hz: undamped natural frequency |s|/2 pi [Hz]\n"
      "  sensor: name of the sensor, which a zero needs\n"
      "  order: number of the flexible pole or zero, from 1 (None: found by the arm file)\n"
      "  frequency_std_Hz: standard deviation of the frequency [Hz]\n"
      "  damping_ratio: -Re s/|s| [1]\n"
      "  damping_ratio_std: its standard deviation [1]")
      .def(py::init(&modal_entry), py::arg("feature"), py::arg("frequency_Hz") = py::none(),
           py::kw_only(), py::arg("sensor") = py::none(), py::arg("order") = py::none(),
           py::arg("frequency_std_Hz") = py::none(), py::arg("damping_ratio") = py::none(),
           py::arg("damping_ratio_std") = py::none())
      .def_property_readonly(
          "feature", [](const ModalEntry& self) { return std::string(to_string(self.feature)); },
          "'pole' or 'zero'.")
      .def_property_readonly(
          "sensor",
          [](const ModalEntry& self) {
            return self.sensor ? std::optional(arm::to_string(*self.sensor)) : std::nullopt;
          },
          "Name of the sensor.")
      .def_readonly("order", &ModalEntry::order, "From 1.")
      .def_readonly("frequency_Hz", &ModalEntry::frequency_Hz, "Natural frequency [Hz].")
      .def_readonly("frequency_std_Hz", &ModalEntry::frequency_std_Hz,
                    "Its standard deviation [Hz].")
      .def_readonly("damping_ratio", &ModalEntry::damping_ratio, "Damping ratio [1].")
      .def_readonly("damping_ratio_std", &ModalEntry::damping_ratio_std,
                    "Its standard deviation [1].");
  const std::string text =
      "A table of measured poles and zeros.\n\nArguments:\n"
      "  entries: a list of ModalEntry or of dicts of its arguments, or a DataFrame of them\n" +
      std::string(kRunArguments) +
      "\nRaises InputError for a number out of its range, a zero without sensor, and one given "
      "twice.";
  auto modal = py::class_<ModalRun>(module, "ModalRun", text.c_str());
  add_run_facts(modal)
      .def(py::init(&modal_run), py::arg("entries"), py::kw_only(), py::arg("id") = "run",
           py::arg("purpose") = "", py::arg("payload_mass_kg") = py::none(),
           py::arg("payload_inertia_kg_m2") = py::none())
      .def_readonly("entries", &ModalRun::table, "A list of ModalEntry.")
      .def("__repr__", [](const ModalRun& self) {
        return fmt::format("<flexarm.ModalRun '{}': {} entries>", self.run.id, self.table.size());
      });
}

}  // namespace

AnyRun as_given(const measured::MeasuredRun& run) {
  if (const auto* record = std::get_if<measured::TimeRecord>(&run.data)) {
    return TimeRun{run.run, *record};
  }
  if (const auto* responses = std::get_if<measured::FrequencyRecord>(&run.data)) {
    return FrequencyRun{run.run, *responses};
  }
  return ModalRun{run.run, std::get<measured::ModalTable>(run.data)};
}

measured::MeasuredRun as_measured(const AnyRun& run) {
  if (const auto* time = std::get_if<TimeRun>(&run)) return {time->run, time->record};
  if (const auto* frequency = std::get_if<FrequencyRun>(&run)) {
    return {frequency->run, frequency->record};
  }
  const auto& modal = std::get<ModalRun>(run);
  return {modal.run, modal.table};
}

void add_measured_runs(py::module_& module) {
  add_time_run(module);
  add_frequency_run(module);
  add_modal_run(module);
  add_pickle<TimeRun, FrequencyRun, ModalEntry, ModalRun>();
}

}  // namespace flexarm::python
