#include "app/state_space_file.hpp"

#include "arm/input_error.hpp"
#include "measured/files/atomic_file.hpp"
#include "report/json/json_document.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/state_space_export.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace flexarm::app {

void require_state_space_file(const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension != ".json" && extension != ".csv" && extension != ".mat") {
    throw arm::InputError(
        fmt::format("--state-space {}: unknown extension; allowed: .json, .csv, "
                    ".mat",
                    arm::shown(path.string())));
  }
  measured::require_writable(path);
}

void write_state_space(const response::ResponseStudy& study, const std::filesystem::path& path) {
  const report::StateSpaceExport exported{*study.state_space, *study.state_space_response};
  if (path.extension() == ".mat") {
    measured::write_mat_file(report::state_space_mat(exported), path);
  } else if (path.extension() == ".csv") {
    measured::write_atomically(path, report::to_csv(report::state_space_listing(exported.system)));
  } else {
    measured::write_atomically(
        path, report::json_document("flexarm.state_space/1", report::state_space_json(exported)));
  }
}

}  // namespace flexarm::app
