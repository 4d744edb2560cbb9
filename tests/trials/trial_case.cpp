#include "tests/trials/trial_case.hpp"

#include "measured/files/arm_file.hpp"
#include "measured/files/frequency_record.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/files/time_record.hpp"
#include "tests/trials/dirt.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/frequency_simulation.hpp"
#include "tests/trials/noisy_record.hpp"
#include "tests/trials/rig_case.hpp"
#include "tests/trials/time_simulation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace flexarm::trials {

namespace {

namespace fs = std::filesystem;

/// A modal test knows damping ratios to so many times the noise of its signals.
constexpr double kDampingNoise = 10.0;
/// A pole that is damped more makes no peak that a modal test would find.
constexpr double kMostVisibleDamping = 0.5;
constexpr double kAverages = 16.0;
/// Standard deviations in a modal table are themselves estimates, known to this part.
constexpr double kDeviationKnown = 0.02;

/// A case as it is made.
struct MadeCase {
  const TrialKey& key;
  const TrialArm& of;
  const Dirt& dirt;
};

Recording record_time_run(const MadeCase& made, const World& world, const PlannedRun& run,
                          Random& random, Random& dirt_random, std::uint64_t disturbance_seed) {
  Recording recording;
  TimeOptions options{.sample_time_s = kSampleTime_s, .disturbance_seed = disturbance_seed};
  if (made.dirt.simulation) {
    made.dirt.simulation(made.key.dirt_size, made.of, dirt_random, options);
  }
  const auto& sensors = planned_sensors();
  recording.record = noisy_record(simulate_run(world, sensors, run.torque_N_m, options), sensors,
                                  made.key.noise, random);
  return recording;
}

void write_frequency_run(const World& world, const TrialArm& of, double noise, Random& random,
                         const fs::path& file) {
  const auto frequencies = planned_frequencies_Hz(of, kFrequencyLines);
  const auto& sensors = planned_sensors();
  auto responses = frequency_responses(world, sensors, frequencies);
  // Real and imaginary part: sd^2 = (1 - g)/(2 n g) |G|^2 (Bendat & Piersol).
  const double coherence = 1.0 / (1.0 + 2.0 * kAverages * noise * noise);
  measured::FrequencyRecord record;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    for (auto& value : responses[i]) {
      const double size = std::abs(value);
      const double real = random.normal();
      value += noise * size * std::complex<double>(real, random.normal());
    }
    record.channels.push_back({sensors[i], frequencies, responses[i],
                               std::vector<double>(frequencies.size(), coherence)});
  }
  measured::write_frequency_record(record, file);
}

void write_modal_run(const World& world, double noise, Random& random, const fs::path& file) {
  measured::ModalTable table = poles_and_zeros(world, kModalOrders);
  std::erase_if(table, [](const auto& entry) {
    return entry.damping_ratio.value_or(0.0) > kMostVisibleDamping;
  });
  for (auto& entry : table) {
    const double frequency_std = kFrequencyNoise * noise * *entry.frequency_Hz;
    *entry.frequency_Hz += frequency_std * random.normal();
    entry.frequency_std_Hz = frequency_std * (1.0 + kDeviationKnown * random.normal());
    if (!entry.damping_ratio) continue;
    const double damping_std = kDampingNoise * noise * *entry.damping_ratio;
    *entry.damping_ratio += damping_std * random.normal();
    entry.damping_ratio_std = damping_std * (1.0 + kDeviationKnown * random.normal());
  }
  measured::write_modal_table(table, file);
}

/// The arm of a case: of those in which what is hidden can show.
const TrialArm& choose_arm(const TrialKey& key, Random& random) {
  if (!key.arm.empty()) return find_trial_arm(key.arm);
  const auto& arms = trial_arms();
  const std::size_t drawn = random.below(arms.size());
  for (const std::string& name : key.hidden) {
    const std::string& wanted = find_cause(name).shows_on_arm;
    const auto found =
        std::ranges::find(arms, wanted, [](const TrialArm& one) { return one.arm.name; });
    if (found != arms.end()) return *found;
  }
  return arms[drawn];
}

}  // namespace

std::string TrialKey::name() const {
  if (dirt.empty()) return clean_name();
  const std::string how_much = dirt_size == 1.0 ? "" : fmt::format(" {:g}", dirt_size);
  return clean_name() + "-" + dirt + how_much;
}

std::string TrialKey::clean_name() const {
  const std::string where = arm.empty() ? "" : arm + "-";
  if (rig) {
    const std::string most = size ? strength_name() + "-" : "";
    return fmt::format("time-rig-{}{}{:g}-{}", where, most, 100.0 * noise, number);
  }
  const std::string causes = hidden.empty() ? "none" : fmt::format("{}", fmt::join(hidden, "+"));
  const std::string how_much = hidden.empty() ? "" : strength_name() + "-";
  return fmt::format("{}-{}-{}{}{:g}-{}", measured::to_string(kind), causes, where, how_much,
                     100.0 * noise, number);
}

std::string TrialKey::strength_name() const {
  if (rig && !size) return "rig";
  return size ? fmt::format("{:g}", *size) : std::string(to_string(strength));
}

std::string TrialKey::id() const {
  return fmt::format("{}@{}", name(), seed);
}

std::string TrialKey::folder_name() const {
  constexpr std::size_t kNames = std::size_t{1} << 40;
  return fmt::format("{:010x}", Random(seed, name() + " folder").below(kNames));
}

Truth write_case(const TrialKey& key, const fs::path& folder) {
  if (key.rig) return write_rig_case(key, folder);
  Random random(key.seed, key.clean_name());
  Random dirt_random(key.seed, key.clean_name() + " dirt " + key.dirt);
  const TrialArm& of = choose_arm(key, random);
  const Dirt& dirt = find_dirt(key.dirt);
  std::vector<PlannedRun> runs = plan(of, key.kind, random);
  const double part = std::pow(dirt.strength, key.dirt_size);
  Truth truth{key, of.arm.name, World{of.arm}, {}, {}};
  for (const std::string& name : key.hidden) {
    const Cause& cause = find_cause(name);
    const Chance chance = draw_chance(random);
    const FoundSize found =
        key.size
            ? FoundSize{*key.size, error_at(of, key.kind, runs, cause, chance, *key.size)}
            : find_size(of, key.kind, runs, cause, chance, part * error_of(key.strength, key.kind));
    truth.world = with_hidden(truth.world, of, cause, found.size, chance);
    truth.sizes.push_back(found.size);
    truth.errors.push_back(found.error);
  }

  if (dirt.hide) truth.world = dirt.hide(key.dirt_size, of, truth.world, dirt_random);
  if (dirt.plan) dirt.plan(key.dirt_size, runs);

  fs::create_directories(folder);
  arm::Arm arm = of.arm;
  if (dirt.arm_file) dirt.arm_file(key.dirt_size, dirt_random, arm);
  measured::write_arm_file(arm, folder / "arm.toml");
  measured::Measurement measurement{.name = "trial", .arm = "arm.toml", .runs = {}};
  const MadeCase made{key, of, dirt};
  std::uint64_t run_number = 0;
  for (const PlannedRun& run : runs) {
    const std::string file = run.id + ".csv";
    const measured::Run stated{.id = run.id,
                               .kind = key.kind,
                               .file = file,
                               .purpose = run.purpose,
                               .payload = arm::Payload{run.payload_kg, 0.0}};
    measurement.runs.push_back(stated);
    World world = truth.world;
    world.arm.payload.mass_kg = run.payload_kg;
    ++run_number;
    if (key.kind == measured::RunKind::time) {
      Recording recording =
          record_time_run(made, world, run, random, dirt_random, key.seed * 100 + run_number);
      recording.run = stated;
      if (dirt.recording) dirt.recording(key.dirt_size, dirt_random, recording);
      measurement.runs.back() = recording.run;
      measured::write_time_record(recording.record, folder / file);
    } else if (key.kind == measured::RunKind::frf) {
      write_frequency_run(world, of, key.noise, random, folder / file);
    } else {
      write_modal_run(world, key.noise, random, folder / file);
    }
  }
  measured::write_measurement(measurement, folder / "measurement.toml");
  return truth;
}

nlohmann::ordered_json truth_json(const Truth& truth) {
  nlohmann::ordered_json causes = nlohmann::ordered_json::object();
  for (const HiddenCause& one : truth.world.hidden) {
    causes[one.name] = one.parameters;
    if (!one.sensor.empty()) causes[one.name]["sensor"] = one.sensor;
  }
  nlohmann::ordered_json json = {
      {"id", truth.key.id()}, {"seed", truth.key.seed}, {"arm", truth.arm},      {"causes", causes},
      {"sizes", truth.sizes}, {"errors", truth.errors}, {"dirt", truth.key.dirt}};
  if (truth.rig) {
    json["costs"] = truth.rig->costs;
    json["leading"] = truth.rig->leading();
    json["counts_per_turn"] = truth.rig->counts_per_turn;
    json["validation_floor"] = truth.rig->validation_floor;
  }
  return json;
}

}  // namespace flexarm::trials
