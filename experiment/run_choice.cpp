#include "experiment/run_choice.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"
#include "arm/range.hpp"
#include "measured/files/controller_keys.hpp"
#include "measured/files/key_values.hpp"
#include "measured/files/time_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

namespace flexarm::experiment {

namespace {

using arm::InputError;
using response::Excitation;
using response::ExcitationKey;
using response::kSteppedSine;
using response::Multisine;
using response::SampleGrid;
using response::SteppedSine;

constexpr std::string_view kIdCharacters =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";

/// Characters of an id that is made of a file's name: names of outputs begin with it.
constexpr std::size_t kLongestFileId = 48;

/// A day at a microsecond would be 86 times this.
/// A run is kept in memory with its text, some 100 bytes a sample.
constexpr double kMostSamples = 2e7;

/// An excitation as it was typed, and what else a run may be told.
struct TypedRun {
  Excitation excitation;
  std::optional<SteppedSine> stepped_sine;  ///< in place of it
  std::string id;
  std::optional<double> payload_kg;
  std::optional<measured::Purpose> purpose;
};

double read_payload(std::string_view value) {
  const auto mass_kg = arm::parse_number<double>(value);
  if (!mass_kg || !arm::kNotNegative.contains(*mass_kg)) {
    throw InputError(fmt::format("payload = {} kg: must be {}", arm::shown(value),
                                 to_string(arm::kNotNegative)));
  }
  return *mass_kg;
}

using Keys = measured::KeyValues;

Keys read_keys(std::string_view text) {
  return measured::read_key_values(text, "KEY=VALUE, separated by commas");
}

/// Sets what any run may be told, and takes it out of the keys.
void take_common_keys(TypedRun& run, Keys& keys) {
  std::erase_if(keys, [&](const auto& entry) {
    const auto& [key, value] = entry;
    if (key == "id") {
      run.id = require_id(value);
    } else if (key == "payload") {
      run.payload_kg = read_payload(value);
    } else if (key == "purpose") {
      run.purpose = read_purpose(value);
    } else {
      return false;
    }
    return true;
  });
}

TypedRun read_run(const std::string& text, std::uint64_t seed) {
  const std::vector<std::string> common = {"id", "payload", "purpose"};
  const auto colon = std::min(text.find(':'), text.size());
  const std::string kind = text.substr(0, colon);
  TypedRun run;
  if (kind != kSteppedSine) {
    run.excitation = response::excitation_of(kind, {std::string(kSteppedSine)});
  }
  Keys keys = read_keys(std::string_view(text).substr(std::min(colon + 1, text.size())));
  take_common_keys(run, keys);
  if (kind == kSteppedSine) {
    run.stepped_sine = response::stepped_sine_of(keys, common);
    frequencies_Hz(*run.stepped_sine);  // throws for what cannot be
    return run;
  }
  for (const auto& [key, value] : keys) set_key(run.excitation, key, value, common);
  const bool has_seed =
      std::ranges::count(keys_of(run.excitation), "seed", &ExcitationKey::name) > 0;
  if (has_seed && std::ranges::count(keys, "seed", &Keys::value_type::first) == 0) {
    set_key(run.excitation, "seed", fmt::format("{}", seed));
  }
  return run;
}

SampleGrid grid_of(double duration_s, double period_s, const arm::OptionSpelling& spelled) {
  arm::require_in_range(spelled("duration"), duration_s, "s", arm::kPositive);
  arm::require_in_range(spelled("period"), period_s, "s", arm::kPositive);
  const double samples = std::round(duration_s / period_s);
  if (samples < 2.0 || samples > kMostSamples) {
    throw InputError(fmt::format("{} = {} s at {} = {} s: {:.6g} samples; must be from 2 to {:g}",
                                 spelled("duration"), duration_s, spelled("period"), period_s,
                                 samples, kMostSamples));
  }
  return {static_cast<std::size_t>(samples), period_s};
}

std::vector<double> times_of(const SampleGrid& grid) {
  std::vector<double> times(grid.samples);
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = grid.time_s(k);
  return times;
}

std::vector<RoundedKey> differences(const std::vector<ExcitationKey>& typed,
                                    const std::vector<ExcitationKey>& taken) {
  std::vector<RoundedKey> rounded;
  for (std::size_t i = 0; i < typed.size(); ++i) {
    if (typed[i].value == taken[i].value) continue;
    rounded.push_back({typed[i].name, typed[i].unit, typed[i].value, taken[i].value});
  }
  return rounded;
}

/// The run without its payload.
PlannedRun plan(TypedRun& run, double duration_s, double period_s,
                const arm::OptionSpelling& spelled) {
  if (run.stepped_sine) {
    const std::string kind(kSteppedSine);
    return {run.id.empty() ? kind : run.id,
            kind,
            keys_of(*run.stepped_sine),
            {},
            {},
            {},
            run.purpose,
            {},
            {},
            run.stepped_sine};
  }
  const auto grid = grid_of(duration_s, period_s, spelled);
  auto* multisine = std::get_if<Multisine>(&run.excitation);
  if (multisine && multisine->period_s == 0.0) multisine->period_s = grid.duration_s();
  const std::string kind(name(run.excitation));
  auto torque = sample(run.excitation, grid);
  const auto keys = keys_of(in_whole_samples(run.excitation, grid));
  return {run.id.empty() ? kind : run.id,
          kind,
          keys,
          times_of(grid),
          std::move(torque),
          {},
          run.purpose,
          differences(keys_of(run.excitation), keys)};
}

PlannedRun run_of_file(const std::string& file) {
  measured::TimeRecord record = measured::read_time_record(file);
  return {id_of_file(file),
          std::filesystem::path(file).filename().string(),
          {},
          std::move(record.time_s),
          {std::move(record.torque_N_m), {}, {}},
          {},
          {},
          {}};
}

PlannedRun run_of_torque(const measured::TimeRecord& record) {
  PlannedRun run;
  run.id = "torque";
  run.excitation = run.id;
  run.time_s = record.time_s;
  run.torque.torque_N_m = record.torque_N_m;
  return run;
}

/// The run in closed loop whose reference would be the torque of `run`.
PlannedRun in_closed_loop(PlannedRun run, const arm::Controller& controller) {
  const std::string unit(arm::unit(controller.sensors.front()));
  for (auto& key : run.keys) {
    if (key.unit == "N m") key.unit = unit;
  }
  run.reference = {unit, std::move(run.torque.torque_N_m)};
  run.torque = {};
  run.controller = controller;
  return run;
}

PlannedRun run_of_reference_file(const std::string& file, const arm::Controller& controller) {
  measured::TimeRecord record = measured::read_reference(file);
  const arm::Sensor& sensor = controller.sensors.front();
  if (std::holds_alternative<arm::PidController>(controller.law) &&
      record.reference.unit != arm::unit(sensor)) {
    throw InputError(fmt::format("{}: reference in {}; must be in {}, the unit of {}",
                                 arm::shown(file), record.reference.unit, arm::unit(sensor),
                                 arm::to_string(sensor)));
  }
  PlannedRun run;
  run.id = id_of_file(file);
  run.excitation = std::filesystem::path(file).filename().string();
  run.time_s = std::move(record.time_s);
  run.reference = std::move(record.reference);
  run.controller = controller;
  return run;
}

/// "random", "random-2", ...: ids that were not typed are counted where they are in use.
void count_equal_ids(std::vector<PlannedRun>& runs) {
  std::set<std::string> used;
  for (const auto& run : runs) {
    if (!run.id_typed_in.empty() && !used.insert(run.id).second) {
      throw InputError(fmt::format("{}: id = {}: is that of another run", run.id_typed_in, run.id));
    }
  }
  for (auto& run : runs) {
    if (!run.id_typed_in.empty()) continue;
    const std::string first = run.id;
    for (int count = 2; !used.insert(run.id).second; ++count) {
      run.id = fmt::format("{}-{}", first, count);
    }
  }
}

}  // namespace

arm::Controller read_controller(const std::string& text, const std::string& option) {
  if (text.find('=') != std::string::npos) {
    return measured::parse_controller_keys(text, option);
  }
  return measured::read_controller_file(text);
}

std::string require_id(const std::string& id) {
  const bool is_hidden = id.starts_with('.');
  if (id.empty() || is_hidden || id.find_first_not_of(kIdCharacters) != std::string::npos) {
    throw InputError(fmt::format(
        "id = {}: must be letters, digits, - _ and ., because it is a file name", arm::shown(id)));
  }
  return id;
}

measured::Purpose read_purpose(std::string_view value) {
  for (const auto purpose : {measured::Purpose::estimation, measured::Purpose::validation}) {
    if (value == to_string(purpose)) return purpose;
  }
  throw InputError(fmt::format(
      "purpose = {}: must be estimation or validation{}", arm::shown(value),
      arm::did_you_mean(value, std::array<std::string, 2>{"estimation", "validation"})));
}

std::string id_of_file(const std::string& file) {
  const std::string stem = std::filesystem::path(file).stem().string();
  std::string id;
  for (const char c : stem) {
    if (kIdCharacters.find(c) != std::string_view::npos) {
      id += c;
    } else if (!id.empty() && id.back() != '-') {
      id += '-';
    }
  }
  id.resize(std::min(id.size(), kLongestFileId));
  while (id.ends_with('-')) id.pop_back();
  return id.empty() || id.front() == '.' ? "run" + id : id;
}

std::vector<PlannedRun> RunChoice::runs(const arm::Arm& arm,
                                        const std::vector<double>& payload_masses_kg) const {
  std::vector<std::string> typed = excitations;
  if (typed.empty() && torque_files.empty() && torque_records.empty() && references.empty() &&
      reference_records.empty()) {
    typed = {"bang-bang"};
  }
  const bool has_reference = !references.empty() || !reference_records.empty();
  if (has_reference != (loop || !controller.empty())) {
    throw InputError(fmt::format("{}: needs {}",
                                 spelled(has_reference ? "reference" : "controller"),
                                 spelled(has_reference ? "controller" : "reference")));
  }
  const auto is_file = [](const std::string& text) {
    return text.ends_with(".csv") || std::filesystem::is_regular_file(text);
  };
  const bool has_sampled = !typed.empty() || !std::ranges::all_of(references, is_file);
  if (!has_sampled && (duration_s || period_s)) {
    throw InputError(fmt::format("{}: only with {}; a torque file has its own",
                                 spelled(duration_s ? "duration" : "period"),
                                 spelled("excitation")));
  }
  std::vector<PlannedRun> plain;
  const auto is_stepped = [](const std::string& text) {
    return text.substr(0, text.find(':')) == kSteppedSine;
  };
  if (!typed.empty() && references.empty() && (duration_s || period_s) &&
      std::ranges::all_of(typed, is_stepped)) {
    throw InputError(
        fmt::format("{}: not with a stepped sine", spelled(duration_s ? "duration" : "period")));
  }
  const auto add_typed = [&](const std::string& option, const std::string& text,
                             std::uint64_t own_seed) {
    TypedRun run;
    try {
      run = read_run(text, own_seed);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{} {}: {}", option, arm::shown(text), error.what()));
    }
    PlannedRun planned = plan(run, duration_s.value_or(kDefaultDuration_s),
                              period_s.value_or(kDefaultPeriod_s), spelled);
    if (!run.id.empty()) planned.id_typed_in = fmt::format("{} {}", option, arm::shown(text));
    if (run.payload_kg) {
      if (!payload_masses_kg.empty()) {
        throw InputError(
            fmt::format("{}: applies to all runs; not together with the key payload of {}",
                        spelled("payload-mass"), option));
      }
      planned.payload = arm::Payload{*run.payload_kg, arm.payload.inertia_kg_m2};
    }
    plain.push_back(std::move(planned));
  };
  for (std::size_t i = 0; i < typed.size(); ++i) {
    add_typed(spelled("excitation"), typed[i], seed + i);
  }
  for (const auto& file : torque_files) plain.push_back(run_of_file(file));
  for (const auto& record : torque_records) plain.push_back(run_of_torque(record));
  if (has_reference) {
    const arm::Controller chosen =
        loop ? *loop : read_controller(controller, spelled("controller"));
    for (std::size_t i = 0; i < references.size(); ++i) {
      if (is_stepped(references[i])) {
        throw InputError(fmt::format("{} stepped-sine: only for {}", spelled("reference"),
                                     spelled("excitation")));
      }
      if (is_file(references[i])) {
        plain.push_back(run_of_reference_file(references[i], chosen));
        continue;
      }
      add_typed(spelled("reference"), references[i], seed + typed.size() + i);
      plain.back() = in_closed_loop(std::move(plain.back()), chosen);
    }
    for (const auto& record : reference_records) {
      PlannedRun run = run_of_torque(record);
      run.id = "reference";
      run.excitation = run.id;
      run.torque.torque_N_m = record.reference.values;
      plain.push_back(in_closed_loop(std::move(run), chosen));
    }
  }

  std::vector<PlannedRun> runs;
  for (const double mass_kg : payload_masses_kg) {
    for (const auto& run : plain) {
      runs.push_back(run);
      runs.back().payload = arm::Payload{mass_kg, arm.payload.inertia_kg_m2};
      if (payload_masses_kg.size() > 1) runs.back().id += fmt::format("-{}kg", mass_kg);
    }
  }
  if (payload_masses_kg.empty()) runs = std::move(plain);
  count_equal_ids(runs);
  return runs;
}

}  // namespace flexarm::experiment
