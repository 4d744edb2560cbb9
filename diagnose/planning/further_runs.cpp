#include "diagnose/planning/further_runs.hpp"

#include "arm/arm.hpp"
#include "arm/input_error.hpp"
#include "arm/linear_arm.hpp"
#include "arm/rigid_hub.hpp"
#include "exact_tf/exact_arm.hpp"
#include "response/arm_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::diagnose {

namespace {

using measured::RunKind;

/// Further payloads, as parts of the beam's mass.
constexpr std::array kPayloadParts = {0.25, 1.0};
/// Amplitudes, times that of the run.
constexpr std::array kAmplitudes = {0.25, 4.0};
/// The highest frequency of an input, times the sampling frequency.
constexpr double kHighestInput = 0.4;
/// How far the arm turns in the first pulse of a run in time where there is none to be changed.
constexpr double kTurn_rad = 0.5;
constexpr double kPulse_s = 0.3;
constexpr int kFurtherLines = 200;
/// A response at higher frequencies ends at so many times the highest.
constexpr double kHigher = 4.0;
/// Highest frequency of a response of a hub without a beam [Hz].
constexpr double kHighestOfRigidHub_Hz = 10.0;
/// Poles, and zeros of a sensor, that a modal table may have more.
constexpr int kFurtherRoots = 2;

std::vector<arm::Sensor> further_sensors(const arm::Arm& arm) {
  if (!arm::has_beam(arm)) return {{arm::SensorKind::hub_angle}, {arm::SensorKind::hub_velocity}};
  std::vector<arm::Sensor> all = {{arm::SensorKind::hub_angle},
                                  {arm::SensorKind::hub_velocity},
                                  {arm::SensorKind::tip_acceleration},
                                  {arm::SensorKind::tip_displacement}};
  if (arm.beam.thickness_m) {
    // Where it bends most: near the root, but not on it, where a gauge does not fit.
    const double place_m = std::round(0.05 * arm::linear_arm(arm).length_m * 1e3) * 1e-3;
    all.push_back({arm::SensorKind::strain, place_m});
  }
  return all;
}

double noise_of_others(const PlannedRun& run) {
  double largest = 0.0;
  for (const PlannedSensor& sensor : run.sensors) largest = std::max(largest, sensor.noise);
  return largest > 0.0 ? largest : kPlannedNoise;
}

void scale_amplitude(PlannedRun& run, double factor) {
  if (auto* recorded = std::get_if<std::vector<double>>(&run.torque)) {
    for (double& torque : *recorded) torque *= factor;
    return;
  }
  std::visit(
      [factor](auto& excitation) {
        if constexpr (requires { excitation.amplitude_N_m; }) {
          excitation.amplitude_N_m *= factor;
        } else {
          excitation.rms_N_m *= factor;
        }
      },
      std::get<response::Excitation>(run.torque));
}

/// Highest flexible pole that a run should reach [Hz]: the third, or a frequency at which the
/// inertia of a hub without a beam is all that acts.
double third_pole_Hz(const arm::Arm& arm) {
  if (!arm::has_beam(arm)) return kHighestOfRigidHub_Hz;
  const exact_tf::ExactArm exact(response::take_apart(arm).linear);
  return std::abs(exact.damped_poles(3).flexible.back().first_rad_per_s) / (2.0 * std::numbers::pi);
}

/// A run in time of an arm of which none is planned.
PlannedRun plain_time_run(const arm::Arm& arm, const std::vector<PlannedSensor>& sensors) {
  PlannedRun run;
  run.id = "time";
  run.sensors = sensors;
  for (PlannedSensor& sensor : run.sensors) sensor.noise = kPlannedNoise;
  if (run.sensors.empty()) run.sensors = {{{arm::SensorKind::hub_angle}, kPlannedNoise}};
  const double amplitude = kTurn_rad * arm::total_inertia_kg_m2(arm) / (kPulse_s * kPulse_s);
  run.torque = response::BangBang{.amplitude_N_m = amplitude, .pulse_s = kPulse_s, .pairs = 0};
  run.duration_s = 4.0;
  run.sample_time_s = 2e-3;
  return run;
}

/// Gathers runs under ids of their own.
class Gatherer {
 public:
  explicit Gatherer(const std::vector<PlannedRun>& runs) : runs_(runs) {}

  /// Leaves out an input that does not fit into the run: a multisine of a number of samples that
  /// cannot be transformed.
  void add(PlannedRun run, const std::string& suffix, std::string change) {
    if (run.kind == RunKind::time && !fits(run)) return;
    const std::string like = has(run.id) ? run.id : "";
    run.id = fmt::format("{}-{}", run.id, suffix);
    const std::string first = run.id;
    for (int count = 2; has(run.id); ++count) run.id = fmt::format("{}-{}", first, count);
    run.purpose = measured::Purpose::estimation;
    made_.push_back({std::move(run), like, std::move(change)});
  }
  std::vector<FurtherRun> made() { return std::move(made_); }

 private:
  static bool fits(const PlannedRun& run) {
    try {
      torque_of(run);
      return true;
    } catch (const arm::InputError&) {
      return false;
    }
  }
  bool has(const std::string& id) const {
    return std::ranges::find(runs_, id, &PlannedRun::id) != runs_.end() ||
           std::ranges::any_of(made_, [&](const auto& entry) { return entry.run.id == id; });
  }
  const std::vector<PlannedRun>& runs_;
  std::vector<FurtherRun> made_;
};

/// Payloads, which a hub without a beam does not carry.
void add_payloads(Gatherer& all, const arm::Arm& arm, const PlannedRun& run) {
  if (!arm::has_beam(arm)) return;
  const arm::LinearArm linear = arm::linear_arm(arm);
  const double beam_kg = linear.linear_density_kg_per_m * linear.length_m;
  for (const double part : kPayloadParts) {
    PlannedRun loaded = run;
    loaded.payload = run.payload.value_or(arm.payload);
    const double further_kg = std::stod(fmt::format("{:.2g}", part * beam_kg));
    loaded.payload->mass_kg += further_kg;
    all.add(std::move(loaded), fmt::format("{:g}kg", further_kg),
            fmt::format("payload +{:g} kg (known mass)", further_kg));
  }
}

/// What any run may have more: a payload, a sensor.
void add_conditions(Gatherer& all, const arm::Arm& arm, const PlannedRun& run) {
  add_payloads(all, arm, run);
  if (run.kind == RunKind::modal) return;
  for (const arm::Sensor& sensor : further_sensors(arm)) {
    if (std::ranges::find(run.sensors, sensor, &PlannedSensor::sensor) != run.sensors.end()) {
      continue;
    }
    PlannedRun more = run;
    more.sensors.push_back({sensor, noise_of_others(run)});
    all.add(std::move(more), arm::to_string(sensor),
            fmt::format("additional sensor {}", arm::to_string(sensor)));
  }
}

void add_roots(Gatherer& all, const PlannedRun& run) {
  PlannedRun more = run;
  more.poles += kFurtherRoots;
  for (PlannedSensor& sensor : more.sensors) sensor.zeros += kFurtherRoots;
  all.add(std::move(more), "more", fmt::format("{} more poles and zeros", kFurtherRoots));
  // Zeros at the hub are the poles of the clamped arm: what does not depend on the hub.
  const arm::Sensor hub{arm::SensorKind::hub_angle};
  if (std::ranges::find(run.sensors, hub, &PlannedSensor::sensor) != run.sensors.end()) return;
  PlannedRun with_zeros = run;
  with_zeros.sensors.push_back({hub, run.noise, std::max(1, run.poles - 1)});
  all.add(std::move(with_zeros), "zeros", "additional zeros of hub_angle");
}

void add_in_time(Gatherer& all, const PlannedRun& run) {
  const double rms = response::rms_N_m(torque_of(run));
  all.add(run, "again", "repetition");
  for (const double factor : kAmplitudes) {
    PlannedRun scaled = run;
    scale_amplitude(scaled, factor);
    all.add(std::move(scaled), fmt::format("times-{:g}", factor),
            fmt::format("torque x {:g}", factor));
  }
  if (std::holds_alternative<response::Excitation>(run.torque)) {
    PlannedRun longer = run;
    longer.duration_s *= 4.0;
    all.add(std::move(longer), "longer", "duration x 4");
  }
  const auto with_input = [&](const response::Excitation& input, double sample_time_s,
                              const std::string& suffix, std::string change) {
    PlannedRun other = run;
    other.torque = input;
    other.sample_time_s = sample_time_s;
    all.add(std::move(other), suffix, std::move(change));
  };
  const double period_s = run.sample_time_s;
  const double low_Hz = 1.0 / run.duration_s;
  const auto multisine = [&](double sample_time_s) {
    return response::Multisine{
        .rms_N_m = rms, .from_Hz = low_Hz, .to_Hz = kHighestInput / sample_time_s};
  };
  with_input(multisine(period_s), period_s, "multisine",
             fmt::format("multisine to {:.3g} Hz", kHighestInput / period_s));
  with_input(multisine(0.5 * period_s), 0.5 * period_s, "faster",
             fmt::format("multisine to {:.3g} Hz, sampling frequency x 2",
                         2.0 * kHighestInput / period_s));
  with_input(response::BangBang{.amplitude_N_m = rms, .pulse_s = run.duration_s / 8.0, .pairs = 0},
             period_s, "bang-bang", "bang-bang pulses");
  with_input(response::Step{.amplitude_N_m = rms}, period_s, "step", "step torque");
}

}  // namespace

std::string input_of(const PlannedRun& run) {
  if (run.kind == RunKind::modal) return "poles and zeros";
  if (run.kind == RunKind::frf) {
    const auto frequencies = frequencies_of(run);
    return fmt::format("frequency response {:.3g} to {:.3g} Hz", frequencies.front(),
                       frequencies.back());
  }
  const auto* excitation = std::get_if<response::Excitation>(&run.torque);
  return excitation == nullptr ? "recorded torque" : std::string(response::name(*excitation));
}

std::vector<FurtherRun> further_runs(const arm::Arm& arm, const std::vector<PlannedRun>& runs) {
  Gatherer all(runs);
  const auto first = [&](RunKind kind) { return std::ranges::find(runs, kind, &PlannedRun::kind); };
  const auto in_time = first(RunKind::time);
  const auto frf = first(RunKind::frf);
  const auto modal = first(RunKind::modal);
  std::vector<PlannedSensor> sensors;
  if (!runs.empty()) sensors = runs.front().sensors;
  if (in_time != runs.end()) {
    add_in_time(all, *in_time);
    add_conditions(all, arm, *in_time);
  } else {
    all.add(plain_time_run(arm, sensors), "pulses", "time run with bang-bang pulses");
  }
  PlannedRun swept;
  if (frf != runs.end()) {
    swept = *frf;
    add_conditions(all, arm, swept);
  } else {
    swept.id = "frf";
    swept.kind = RunKind::frf;
    swept.sensors = sensors;
    if (in_time != runs.end()) swept.payload = in_time->payload;
    for (PlannedSensor& sensor : swept.sensors) sensor.noise = kPlannedNoise;
    if (swept.sensors.empty()) {
      swept.sensors = {{{arm::SensorKind::hub_angle}, kPlannedNoise}};
    }
    const double pole_Hz = third_pole_Hz(arm);
    swept.frequencies = PlannedBand{0.01 * pole_Hz, 1.5 * pole_Hz, kFurtherLines};
    all.add(swept, "low", fmt::format("frequency response to {:.3g} Hz", 1.5 * pole_Hz));
  }
  const double highest_Hz = frequencies_of(swept).back();
  swept.frequencies = PlannedBand{0.25 * highest_Hz, kHigher * highest_Hz, kFurtherLines};
  all.add(swept, "high", fmt::format("frequency response to {:.3g} Hz", kHigher * highest_Hz));
  if (modal != runs.end()) {
    add_conditions(all, arm, *modal);
    add_roots(all, *modal);
  }
  return all.made();
}

std::vector<PlannedRun> planned_as_measured(const Problem& problem) {
  std::vector<PlannedRun> made;
  const Experiment& experiment = problem.experiment();
  for (std::size_t r = 0; r < experiment.runs.size(); ++r) {
    const auto& [run, data] = experiment.runs[r];
    if (!problem.estimation_runs()[r] || run.kind == RunKind::modal) continue;
    const auto* responses = std::get_if<measured::FrequencyRecord>(&data);
    if (responses != nullptr && responses->input) continue;  // plans are of torques
    PlannedRun planned;
    planned.id = run.id;
    planned.purpose = run.purpose;
    planned.kind = run.kind;
    planned.payload = run.payload;
    planned.torque_hold = run.torque_hold;
    for (const ObservedChannel& channel : problem.observations().channels) {
      if (channel.run != r || channel.sensor == kTorqueChannel) continue;
      // Of a response the noise of a channel is that of real and imaginary part together.
      const double parts = run.kind == RunKind::frf ? std::numbers::sqrt2 : 1.0;
      planned.sensors.push_back({arm::parse_sensor(channel.sensor), channel.noise / parts});
    }
    if (const auto* record = std::get_if<measured::TimeRecord>(&data)) {
      std::vector<double> torque = record->torque_N_m;
      torque.resize(std::min(torque.size(), kMostFurtherSamples));
      planned.sample_time_s = measured::sampling_period_s(*record);
      planned.duration_s = static_cast<double>(torque.size()) * planned.sample_time_s;
      planned.torque = std::move(torque);
    } else {
      planned.frequencies = responses->channels.front().frequency_Hz;
    }
    made.push_back(std::move(planned));
  }
  return made;
}

}  // namespace flexarm::diagnose
