#pragma once

#include "measured/files/run_data.hpp"

#include <pybind11/pybind11.h>
#include <variant>

namespace flexarm::python {

/// The runs of a measurement as Python has them, a class a kind.
struct TimeRun {
  measured::Run run;
  measured::TimeRecord record;
};

struct FrequencyRun {
  measured::Run run;
  measured::FrequencyRecord record;
};

struct ModalRun {
  measured::Run run;
  measured::ModalTable table;
};

using AnyRun = std::variant<TimeRun, FrequencyRun, ModalRun>;

AnyRun as_given(const measured::MeasuredRun& run);
measured::MeasuredRun as_measured(const AnyRun& run);

/// Adds the classes of the runs, and ModalEntry.
void add_measured_runs(pybind11::module_& module);

}  // namespace flexarm::python
