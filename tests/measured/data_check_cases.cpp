#include "tests/measured/data_check_cases.hpp"

#include "arm/linear_arm.hpp"
#include "compare/described_arm.hpp"
#include "effects/registry/vocabulary.hpp"
#include "response/excitation/excitation.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/simulation.hpp"
#include "response/time/time_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>

namespace flexarm::measured {

namespace {

using arm::Sensor;
using arm::SensorKind;
using response::RandomNumbers;

response::Excitation draw_excitation(RandomNumbers& random, double rms_N_m, double rate_Hz,
                                     double duration_s) {
  const double to_Hz = std::min(log_between(random, 15.0, 120.0), 0.45 * rate_Hz);
  const auto seed = static_cast<std::uint64_t>(1e9 * random.uniform());
  switch (random.below(4)) {
    case 0:
      return response::RandomNoise{rms_N_m, 0.1, to_Hz, seed};
    case 1:
      return response::Multisine{rms_N_m, 0.1, to_Hz, 0.0, chance(random, 0.5) ? 4 : 0, seed};
    case 2:
      return response::BangBang{1.5 * rms_N_m, between(random, 0.15, 0.4),
                                chance(random, 0.5) ? 0.1 : 0.0, chance(random, 0.5) ? 1 : 0};
    default:
      return response::Chirp{
          1.4 * rms_N_m, std::max(0.3, 1.0 / duration_s), to_Hz,
          chance(random, 0.5) ? response::Sweep::linear : response::Sweep::logarithmic};
  }
}

void draw_friction(RandomNumbers& random, double rms_N_m, arm::Arm& arm) {
  const double kind = random.uniform();
  if (kind < 0.25) {
    effects::put(arm, "coulomb_friction", {{"torque", rms_N_m * between(random, 0.05, 0.4)}});
  } else if (kind < 0.45) {
    const double torque = rms_N_m * between(random, 0.05, 0.3);
    effects::put(arm, "stribeck_friction",
                 {{"torque", torque},
                  {"static_torque", torque * between(random, 1.1, 1.6)},
                  {"velocity", between(random, 0.1, 0.5)}});
  } else if (kind < 0.55) {
    effects::put(arm, "quadratic_drag", {{"coefficient", between(random, 0.01, 0.1)}});
  }
}

std::vector<Sensor> draw_sensors(RandomNumbers& random, const arm::Arm& arm,
                                 const CaseNeeds& needs) {
  std::vector<Sensor> sensors;
  const double share = chance(random, 0.3) ? 1.0 : between(random, 0.3, 0.9);
  for (const auto kind :
       {SensorKind::hub_angle, SensorKind::hub_velocity, SensorKind::tip_acceleration,
        SensorKind::tip_displacement, SensorKind::tip_deflection, SensorKind::strain}) {
    const bool needed = std::ranges::count(needs.sensors, kind) > 0;
    if (!chance(random, share) && !needed) continue;
    Sensor sensor{kind, 0.0};
    if (kind == SensorKind::strain) {
      sensor.position_m =
          std::round(100.0 * between(random, 0.02, 0.4) * arm.beam.length_m) / 100.0;
    }
    sensors.push_back(sensor);
  }
  if (sensors.empty()) sensors.push_back({SensorKind::hub_angle, 0.0});
  return sensors;
}

/// As a file that gives so many significant digits.
double rounded(double value, int digits) {
  if (value == 0.0 || digits == 0) return value;
  const double step = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return std::round(value / step) * step;
}

}  // namespace

double between(RandomNumbers& random, double low, double high) {
  return low + (high - low) * random.uniform();
}

double log_between(RandomNumbers& random, double low, double high) {
  return low * std::pow(high / low, random.uniform());
}

bool chance(RandomNumbers& random, double probability) {
  return random.uniform() < probability;
}

double deviation(const std::vector<double>& values) {
  const auto count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / count);
}

arm::Arm draw_arm(RandomNumbers& random) {
  arm::Arm arm = arm::paper_arm();
  if (chance(random, 0.6)) {
    const bool steel = chance(random, 0.3);
    arm.beam = arm::Beam::from_section(between(random, 0.5, 1.2), between(random, 0.015, 0.04),
                                       between(random, 0.0025, 0.005), steel ? 7800.0 : 2710.0,
                                       steel ? 2.0e11 : 7.11e10);
    arm.hub.inertia_kg_m2 = log_between(random, 3e-4, 5e-3);
  } else {
    arm.beam.thickness_m = 0.0032004;
  }
  arm.damping.kelvin_voigt_s = log_between(random, 5e-5, 3e-4);
  arm.hub.viscous_friction_N_m_s_per_rad = log_between(random, 5e-4, 1e-2);
  const double beam_kg = arm.beam.linear_density_kg_per_m() * arm.beam.length_m;
  if (chance(random, 0.5)) arm.payload.mass_kg = beam_kg * log_between(random, 0.05, 0.8);
  return arm;
}

int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::atoi(text);
}

DrawnRun draw_run(std::uint64_t seed, const CaseNeeds& needs) {
  constexpr int kModes = 6;
  constexpr double kMostSamples = 16000.0;
  RandomNumbers random(seed, 1);
  arm::Arm arm = needs.arm ? *needs.arm : draw_arm(random);
  DrawnRun run;
  run.length_m = arm.beam.length_m;
  run.total_inertia_kg_m2 = arm::total_inertia_kg_m2(arm);
  run.noise = log_between(random, 0.003, needs.most_noise);
  run.rounded_digits = chance(random, 0.5) ? 0 : 7;
  run.refinement = needs.refinement;

  double rate_Hz = 0.0;
  double duration_s = 0.0;
  do {
    const double rates[] = {200, 250, 400, 500, 1000, 2000};
    rate_Hz = rates[random.below(6)];
    duration_s = std::round(10.0 * log_between(random, 2.0, 20.0)) / 10.0;
  } while (rate_Hz * duration_s > kMostSamples || rate_Hz * duration_s < needs.least_samples ||
           rate_Hz < needs.least_rate_Hz);

  const double rms_N_m = run.total_inertia_kg_m2 * log_between(random, 1.0, 4.0);
  const auto excitation = draw_excitation(random, rms_N_m, rate_Hz, duration_s);
  draw_friction(random, rms_N_m, arm);
  const auto sensors = draw_sensors(random, arm, needs);
  const auto samples = static_cast<std::size_t>(std::llround(rate_Hz * duration_s));
  const auto coarse = response::sample(excitation, {samples, 1.0 / rate_Hz}).torque_N_m;

  const auto finer = static_cast<std::size_t>(needs.refinement);
  std::vector<double> torque_N_m(samples * finer);
  for (std::size_t k = 0; k < torque_N_m.size(); ++k) torque_N_m[k] = coarse[k / finer];
  const auto parts = response::take_apart(arm);
  const auto model = response::time_model(response::make_formulation("assumed_modes", arm, kModes),
                                          parts, kModes, sensors);
  response::SimulationOptions options;
  options.sample_time_s = 1.0 / (rate_Hz * static_cast<double>(finer));
  options.energy = false;
  options.force_tolerance = 1e-8;  // far below any noise
  auto made = response::simulate(model, parts, sensors, torque_N_m, options);
  run.fine.time_s = std::move(made.time_s);
  run.fine.torque_N_m = std::move(torque_N_m);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    run.fine.channels.push_back({sensors[i], std::move(made.channels[i])});
  }
  std::string with;
  for (const auto& [effect, parameters] : arm.effects) with += " " + effect;
  for (const auto& sensor : sensors) with += " " + arm::to_string(sensor);
  run.arm = arm;
  run.description = fmt::format("seed {}: {} {} Hz {} s, noise {:.4f}, l {:.2f}, payload {:.3f}{}",
                                seed, response::name(excitation), rate_Hz, duration_s, run.noise,
                                run.length_m, arm.payload.mass_kg, with);
  return run;
}

void add_line(std::vector<double>& values, double period_s, double frequency_Hz, double amplitude,
              double phase_rad) {
  for (std::size_t k = 0; k < values.size(); ++k) {
    values[k] += amplitude * std::cos(2.0 * std::numbers::pi * frequency_Hz * period_s *
                                          static_cast<double>(k) +
                                      phase_rad);
  }
}

DataCheckOptions known_arm(const DrawnRun& run, std::uint64_t seed) {
  return known_arms(run, seed).with(run.arm.payload);
}

DescribedArms known_arms(const DrawnRun& run, std::uint64_t seed) {
  constexpr double kError = 0.01;
  RandomNumbers random(seed, 3);
  const double size = chance(random, 0.5) ? kError : 0.0;
  const auto wrong = [&](double value) { return value * (1.0 + size * random.normal()); };
  arm::Arm arm = run.arm;
  arm.effects.clear();
  const arm::Beam& beam = run.arm.beam;
  arm.beam = arm::Beam::from_rigidity(beam.length_m, wrong(beam.flexural_rigidity_N_m2()),
                                      wrong(beam.linear_density_kg_per_m()));
  arm.beam.thickness_m = beam.thickness_m;
  arm.hub.inertia_kg_m2 = wrong(arm.hub.inertia_kg_m2);
  return compare::described_arms(arm);
}

void finish(TimeRecord& record, const DrawnRun& run, RandomNumbers& random) {
  for (auto& channel : record.channels) {
    const double noise = run.noise * deviation(channel.values);
    for (auto& value : channel.values) {
      value = rounded(value + noise * random.normal(), run.rounded_digits);
    }
  }
  for (auto& value : record.torque_N_m) value = rounded(value, run.rounded_digits);
}

TimeRecord sampled(const DrawnRun& run, RandomNumbers& random, std::optional<SensorKind> sensor,
                   int late) {
  TimeRecord record;
  const auto stride = static_cast<std::size_t>(run.refinement);
  const std::size_t samples = run.fine.time_s.size() / stride;
  for (const auto& channel : run.fine.channels) record.channels.push_back({channel.sensor, {}});
  for (std::size_t k = 0; k < samples; ++k) {
    const std::size_t at = k * stride;
    record.time_s.push_back(run.fine.time_s[at]);
    record.torque_N_m.push_back(run.fine.torque_N_m[at]);
    for (std::size_t i = 0; i < record.channels.size(); ++i) {
      const bool is_late = sensor && run.fine.channels[i].sensor.kind == *sensor;
      const auto shift = is_late ? static_cast<std::size_t>(late) : 0;
      record.channels[i].values.push_back(run.fine.channels[i].values[at > shift ? at - shift : 0]);
    }
  }
  finish(record, run, random);
  return record;
}

}  // namespace flexarm::measured
