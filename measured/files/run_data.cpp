#include "measured/files/run_data.hpp"

#include "arm/input_error.hpp"
#include "measured/files/foreign_table.hpp"

#include <stdexcept>

namespace flexarm::measured {

RunData read_run(const std::filesystem::path& measurement_file, const Run& run) {
  const std::filesystem::path file = beside(measurement_file, run.file);
  switch (run.kind) {
    case RunKind::time:
      if (run.columns.empty()) return read_time_record(file);
      return time_record_of(read_foreign_table(file), run.columns, arm::shown(file.string()));
    case RunKind::frf:
      return read_frequency_record(file);
    case RunKind::modal:
      return read_modal_table(file);
  }
  throw std::invalid_argument("a run of no kind");
}

}  // namespace flexarm::measured
