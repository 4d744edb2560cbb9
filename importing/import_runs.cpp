#include "importing/import_runs.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/range.hpp"
#include "arm/read_word.hpp"
#include "experiment/run_choice.hpp"
#include "measured/files/decimation.hpp"
#include "measured/files/even_record.hpp"
#include "measured/files/record_range.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

namespace flexarm::importing {

namespace {

using arm::InputError;
using experiment::id_of_file;
using experiment::read_purpose;
using experiment::require_id;
using measured::Clock;
using measured::InitialState;
using measured::RecordRange;
using measured::TimeRecord;
using measured::TorqueHold;

/// A part of a file that becomes a run.
struct Part {
  std::string id;
  std::optional<RecordRange> range;
  std::string option;  ///< stands in front of an error
};

constexpr std::string_view kRows = "rows:";

RecordRange read_range(const std::string& option, std::string_view text, bool by_rows) {
  try {
    return measured::parse_range(text, by_rows);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

std::string read_id(const std::string& option, const std::string& text) {
  try {
    return require_id(text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", option, error.what()));
  }
}

Part read_part(const std::string& text) {
  const std::string option = fmt::format("--run {}", arm::shown(text));
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("{}: must be ID=FROM:TO, times in s, or ID=rows:FROM:TO", option));
  }
  std::string_view range = std::string_view(text).substr(equals + 1);
  const bool by_rows = range.starts_with(kRows);
  if (by_rows) range.remove_prefix(kRows.size());
  return {read_id(option, text.substr(0, equals)), read_range(option, range, by_rows), option};
}

std::vector<Part> parts_of(const RunsChoice& choice, const std::string& file_id) {
  std::vector<Part> parts;
  for (const auto& text : choice.runs) parts.push_back(read_part(text));
  if (!parts.empty()) return parts;
  const std::string id = choice.id.empty() ? file_id : require_id(choice.id);
  if (!choice.rows.empty()) {
    const std::string option = fmt::format("--rows {}", arm::shown(choice.rows));
    return {{id, read_range("--rows", choice.rows, true), option}};
  }
  if (!choice.times.empty()) {
    const std::string option = fmt::format("--times {}", arm::shown(choice.times));
    return {{id, read_range("--times", choice.times, false), option}};
  }
  return {{id, std::nullopt, ""}};
}

/// The id, or the first of id-2, id-3, ... that is free.
std::string unused_id(const std::string& id, std::set<std::string>& used_ids) {
  std::string unused = id;
  for (int k = 2; !used_ids.insert(unused).second; ++k) unused = fmt::format("{}-{}", id, k);
  return unused;
}

TorqueHold hold_of(const RunsChoice& choice) {
  if (choice.hold.empty()) return TorqueHold::zero;
  return arm::read_word("--hold", choice.hold, std::array{TorqueHold::zero, TorqueHold::first});
}

measured::Run run_of(const RunsChoice& choice) {
  measured::Run run;
  run.torque_hold = hold_of(choice);
  if (!choice.initial.empty()) {
    run.initial = arm::read_word("--initial", choice.initial,
                                 std::array{InitialState::rest, InitialState::free});
  }
  if (choice.payload_mass_kg || choice.payload_inertia_kg_m2) {
    const double mass_kg = choice.payload_mass_kg.value_or(0.0);
    const double inertia_kg_m2 = choice.payload_inertia_kg_m2.value_or(0.0);
    arm::require_in_range("--payload-mass", mass_kg, "kg", arm::kNotNegative);
    arm::require_in_range("--payload-inertia", inertia_kg_m2, "kg m^2", arm::kNotNegative);
    run.payload = arm::Payload{mass_kg, inertia_kg_m2};
  }
  if (choice.controller) {
    run.controller = choice.controller;
    run.reference = measured::ColumnMapping{std::string(measured::kReferenceColumn), "", 1.0};
  }
  return run;
}

/// Whether the controller's torque depends on what was before its first sample.
bool has_memory(const arm::Controller& controller) {
  if (const auto* law = std::get_if<arm::PidController>(&controller.law)) return law->ki != 0.0;
  return !std::get<arm::StateSpaceController>(controller.law).a.empty();
}

/// Cuts the stretch in front of the first sample that the controller took, which it does at
/// `file_start_s` and every period from there; a clock that was set back begins anew.
void begin_with_controller(TimeRecord& stretch, std::vector<std::string>& notes,
                           const arm::Controller& controller, double file_start_s) {
  const double period_s = measured::sampling_period_s(stretch);
  long samples_per_period = 1;
  try {
    samples_per_period = arm::samples_per_period(controller, period_s);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--controller: {}", error.what()));
  }
  const double since_start_s = stretch.time_s.front() - file_start_s;
  const long behind =
      since_start_s < 0.0 ? 0 : std::lround(since_start_s / period_s) % samples_per_period;
  if (behind == 0) return;
  const auto skipped = static_cast<std::size_t>(samples_per_period - behind);
  const std::size_t samples = stretch.time_s.size();
  if (samples < skipped + 2) {
    throw InputError(fmt::format("{} samples; the controller takes its first one after {} of them",
                                 samples, skipped));
  }
  stretch = measured::samples_of(stretch, skipped, samples);
  notes.push_back(fmt::format("{} sample{} left out in front of the first one of the controller",
                              skipped, skipped == 1 ? "" : "s"));
}

/// The records that one part of a file becomes.
std::vector<ImportedRun> runs_of_part(const ImportedFile& file, const Part& part,
                                      const RunsChoice& choice) {
  const auto& record = std::get<TimeRecord>(file.data);
  const double file_start_s = file.start_s.value_or(record.time_s.front());
  std::size_t first = 0;
  const TimeRecord wanted =
      part.range ? measured::part_of(record, *part.range, first, file.rows) : record;
  measured::EvenOptions options;
  options.clock = arm::read_word("--clock", choice.clock, std::array{Clock::stamped, Clock::even});
  options.torque_hold = hold_of(choice);
  options.longest_filled_gap = static_cast<std::size_t>(choice.longest_filled_gap);
  options.period_s = file.period_s;
  measured::EvenRecords even = measured::make_even(wanted, options);
  bool has_start = first == 0 && even.has_first_sample && !file.is_driven_before;
  if (choice.decimation && even.stretches.size() > 1) {
    const std::size_t fewest =
        measured::fewest_samples(static_cast<std::size_t>(*choice.decimation));
    if (even.stretches.front().time_s.size() < fewest) has_start = false;
    const auto left_out = std::erase_if(
        even.stretches, [&](const TimeRecord& stretch) { return stretch.time_s.size() < fewest; });
    if (left_out > 0) {
      even.notes.push_back(
          fmt::format("{} of the stretches left out: shorter than the {} samples "
                      "that --decimate needs",
                      left_out, fewest));
    }
    if (even.stretches.empty()) {
      throw InputError(fmt::format("--decimate: no stretch has the {} samples needed", fewest));
    }
  }
  std::vector<ImportedRun> runs;
  for (auto& stretch : even.stretches) {
    ImportedRun run{run_of(choice), {}, file.file, {}};
    run.run.id =
        even.stretches.size() == 1 ? part.id : fmt::format("{}-{}", part.id, runs.size() + 1);
    bool is_start = has_start && runs.empty();
    if (runs.empty()) run.notes = even.notes;
    if (choice.decimation) {
      const auto factor = static_cast<std::size_t>(*choice.decimation);
      stretch = measured::decimated(stretch, factor);
      run.run.torque_hold = TorqueHold::first;
      is_start = false;
      run.notes.push_back(fmt::format(
          "torque and sensors through a zero-phase low-pass, then every {} samples one, up to "
          "{:.4g} Hz; the torque now has a first-order hold",
          factor, 0.4 / measured::sampling_period_s(stretch)));
    }
    if (choice.initial.empty() && !is_start) {
      run.run.initial = InitialState::free;
      run.notes.emplace_back("initial state free: the run does not begin where the file does");
    }
    if (choice.controller) {
      begin_with_controller(stretch, run.notes, *choice.controller, file_start_s);
      if (!is_start && has_memory(*choice.controller)) {
        run.notes.emplace_back(
            "the state of the controller at the first sample is not known and taken as 0");
      }
    }
    run.data = std::move(stretch);
    runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

void require_valid(const RunsChoice& choice, std::size_t files) {
  const auto require = [](bool is_so, const std::string& line) {
    if (!is_so) throw InputError(line);
  };
  require(choice.runs.empty() || (choice.rows.empty() && choice.times.empty()),
          "--run: not together with --rows or --times");
  require(choice.rows.empty() || choice.times.empty(), "--rows: not together with --times");
  require(choice.runs.empty() || files == 1, "--run: needs a single file");
  require(choice.runs.empty() || choice.id.empty(), "--id: not together with --run");
  require(choice.id.empty() || files == 1,
          "--id: needs a single file; the runs of several are named after them");
  require(choice.purpose.empty() || choice.validation.empty(),
          "--purpose: not together with --validation");
  require(!choice.decimation || *choice.decimation >= 2,
          fmt::format("--decimate {}: must be 2 or more", choice.decimation.value_or(0)));
  require(choice.longest_filled_gap >= 0,
          fmt::format("--fill-gaps {}: must be 0 or more", choice.longest_filled_gap));
  require(!choice.decimation || choice.hold != "zero",
          "--hold zero: not together with --decimate; a filtered torque has a first-order hold");
  require(!choice.controller || choice.hold != "first",
          "--hold first: not together with --controller, which holds its torque between its "
          "samples");
  require(!choice.controller || !choice.decimation,
          "--decimate: not together with --controller; a filtered torque is not what the "
          "controller commanded and held");
  run_of(choice);
  arm::read_word("--clock", choice.clock, std::array{Clock::stamped, Clock::even});
  if (!choice.purpose.empty()) read_purpose(choice.purpose);
  parts_of(choice, "run");
}

std::vector<ImportedRun> runs_of(const ImportedFile& file, const RunsChoice& choice,
                                 std::set<std::string>& used_ids) {
  std::vector<ImportedRun> runs;
  const auto parts = parts_of(choice, id_of_file(file.file));
  if (std::holds_alternative<TimeRecord>(file.data)) {
    for (const auto& part : parts) {
      try {
        auto more = runs_of_part(file, part, choice);
        std::ranges::move(more, std::back_inserter(runs));
      } catch (const InputError& error) {
        const std::string line =
            part.option.empty() ? error.what() : fmt::format("{}: {}", part.option, error.what());
        throw arm::located(InputError(line), arm::shown(file.file), 0);
      }
    }
  } else {
    if (parts.front().range || choice.decimation) {
      throw InputError(
          fmt::format("{}: ranges and --decimate are for time signals", arm::shown(file.file)));
    }
    runs.push_back({run_of(choice), file.data, file.file, {}});
    runs.back().run.id = parts.front().id;
  }
  for (auto& run : runs) {
    run.run.id = unused_id(run.run.id, used_ids);
    run.run.file = run.run.id + ".csv";
    run.run.kind = file.kind;
  }
  return runs;
}

void set_purposes(std::vector<ImportedRun>& runs, const RunsChoice& choice) {
  std::vector<std::string> ids;
  for (auto& run : runs) {
    ids.push_back(run.run.id);
    if (!choice.purpose.empty()) run.run.purpose = read_purpose(choice.purpose);
    if (!choice.validation.empty()) run.run.purpose = measured::Purpose::estimation;
  }
  for (const auto& id : choice.validation) {
    const auto place = std::ranges::find(ids, id);
    if (place == ids.end()) {
      throw InputError(fmt::format("--validation {}: no run of this id{}; runs: {}", arm::shown(id),
                                   arm::did_you_mean(id, ids), fmt::join(ids, ", ")));
    }
    runs[static_cast<std::size_t>(place - ids.begin())].run.purpose = measured::Purpose::validation;
  }
}

}  // namespace flexarm::importing
