#include "importing/import_request.hpp"

#include "arm/input_error.hpp"
#include "arm/read_word.hpp"
#include "experiment/run_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

namespace flexarm::importing {

namespace {

/// The controller that made the torque. Throws InputError for one without a reference, and the
/// other way round.
std::optional<arm::Controller> controller_of(const ImportRequest& request) {
  const std::string reference = request.file.columns.reference_option();
  if (request.controller.empty() && reference.empty()) return std::nullopt;
  if (request.controller.empty()) {
    throw arm::InputError(
        fmt::format("{}: needs --controller, as in --controller kp=2.5,kd=0.1", reference));
  }
  if (reference.empty()) {
    throw arm::InputError("--controller: needs the column with its reference, --reference COLUMN");
  }
  return experiment::read_controller(request.controller, "--controller");
}

/// The request with the words of its kind and its controller read.
ImportRequest as_read(ImportRequest request) {
  request.runs.controller = request.file.controller = controller_of(request);
  if (!request.kind.empty()) {
    request.file.kind = arm::read_word(
        "--kind", request.kind,
        std::array{measured::RunKind::time, measured::RunKind::frf, measured::RunKind::modal});
  }
  require_valid(request.runs, request.join.is_wanted ? 1 : request.files.size());
  if (!request.join.is_wanted && request.join.grid != "same") {
    throw arm::InputError("--join-grid: needs --join");
  }
  if (request.join.is_wanted && request.runs.id.empty()) {
    request.runs.id = experiment::id_of_file(request.files.front());
  }
  return request;
}

}  // namespace

void require_valid(const ImportRequest& request) {
  as_read(request);
}

Import import_logs(const ImportRequest& asked, const std::function<void()>& read_one) {
  const ImportRequest request = as_read(asked);
  Import made;
  if (request.join.is_wanted) {
    made.files.push_back(import_joined(
        request.files, request.file, request.join,
        request.runs.hold == "first" ? measured::TorqueHold::first : measured::TorqueHold::zero));
  } else {
    FileChoice choice = request.file;
    choice.is_one_of_several = request.files.size() > 1;
    for (const auto& file : request.files) {
      made.files.push_back(import_file(read_file(file, choice), choice));
      read_one();
    }
  }
  std::set<std::string> ids;
  for (const auto& file : made.files) {
    auto more = runs_of(file, request.runs, ids);
    std::ranges::move(more, std::back_inserter(made.runs));
  }
  set_purposes(made.runs, request.runs);
  return made;
}

}  // namespace flexarm::importing
