#include "response/time/stepped_sine_response.hpp"

#include "arm/input_error.hpp"
#include "response/time/driven_arm.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/simulation_input.hpp"
#include "response/time/sine_correlation.hpp"
#include "response/time/steady_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace flexarm::response {

namespace {

constexpr int kLinearSamples = 64;
constexpr int kNonlinearSamples = 256;
constexpr double kSamplesOfHighestMode = 4.0;
constexpr int kMostSamples = 1 << 16;
constexpr double kMostReadings = 2e8;
/// Driven where a steady state turns out to be none.
constexpr double kFurtherPeriods = 200;

using Samples = std::vector<std::vector<double>>;  // one a sensor

double highest_Hz(const ModalDynamics& arm) {
  return std::sqrt(std::max(0.0, arm.stiffness.maxCoeff())) / (2.0 * std::numbers::pi);
}

bool is_perfect(const SensorImperfections& imperfections) {
  return imperfections == SensorImperfections{};
}

void require_valid(const ArmParts& parts, std::span<const arm::Sensor> sensors,
                   const SteppedSine& sine, const SteppedSineOptions& options,
                   const ModalDynamics& arm) {
  SimulationOptions stepping;
  stepping.substeps = options.substeps;
  const std::array extremes = {sine.offset_N_m + sine.amplitude_N_m,
                               sine.offset_N_m - sine.amplitude_N_m};
  require_simulable(parts, extremes, stepping);
  if (arm.stiffness.minCoeff() < 0.0) {
    throw arm::InputError(
        "stepped-sine: the inverted arm is unstable and has no steady state; use another "
        "excitation");
  }
  if (!options.imperfections.empty() && options.imperfections.size() != sensors.size()) {
    throw arm::InputError(fmt::format("noise: given for {} sensors; must be for all {} or none",
                                      options.imperfections.size(), sensors.size()));
  }
}

/// The cycles that are measured at a frequency.
struct Cycles {
  double frequency_Hz = 0.0;
  double sine_N_m = 0.0;
  int samples_per_period = 0;
  Samples readings;
  SimulationSummary hub = {};                     // reversals, stops and rests
  std::vector<std::complex<double>> values = {};  // one a sensor
  double change = 0.0;                            // SteppedSineSummary::largest_change
};

void drive(DrivenArm& arm, double periods, SteppedSineSummary& summary) {
  for (double done = 0.0; done < periods; done += 1.0) arm.drive_period(nullptr);
  summary.periods += static_cast<std::int64_t>(periods);
}

/// What a run has measured so far.
class Measuring {
 public:
  Measuring(const ArmParts& parts, std::span<const arm::Sensor> sensors, const SteppedSine& sine,
            const SteppedSineOptions& options)
      : sensors_(sensors.begin(), sensors.end()), cycles_(sine.cycles), options_(options) {
    options_.imperfections.resize(sensors.size());
    made_.values.resize(sensors.size());
    made_.coherence.resize(sensors.size());
    made_.noise_deviation.resize(sensors.size());
    kept_.resize(sensors.size());
    for (const arm::Sensor& sensor : sensors) {
      delay_s_.push_back(chain_of(parts.sensor_chains, sensor).delay_s);
    }
  }

  const SineCorrelation& correlation(int samples_per_period) {
    if (!correlation_ || correlation_->samples_per_cycle() != samples_per_period) {
      correlation_.emplace(samples_per_period, cycles_);
    }
    return *correlation_;
  }

  /// Drives the arm through the cycles that are measured.
  Cycles drive(DrivenArm& arm, double frequency_Hz, int samples_per_period) {
    Cycles made{frequency_Hz, arm.sine_N_m(), samples_per_period, Samples(sensors_.size())};
    const SimulationSummary before = arm.summary();
    for (int cycle = 0; cycle < cycles_; ++cycle) arm.drive_period(&made.readings);
    made.hub.reversals = arm.summary().reversals - before.reversals;
    made.hub.stops = arm.summary().stops - before.stops;
    made.hub.stick_time_s = arm.summary().stick_time_s - before.stick_time_s;
    made_.summary.periods += cycles_;
    for (std::size_t j = 0; j < sensors_.size(); ++j) {
      const auto part = correlation(samples_per_period).of(made.readings[j]);
      if (!std::isfinite(std::abs(part.whole))) {
        throw arm::InputError(
            fmt::format("{} at {} Hz: numeric overflow; reduce the torque or the settling time",
                        arm::to_string(sensors_[j]), frequency_Hz));
      }
      made.values.push_back(part.whole / made.sine_N_m * delayed(j, frequency_Hz));
      const auto& first = part.cycles.front();
      const auto& last = part.cycles.back();
      const double size = std::max(std::abs(first), std::abs(last));
      if (size > 0.0) made.change = std::max(made.change, std::abs(last - first) / size);
    }
    return made;
  }

  void add(Cycles cycles) {
    made_.frequency_Hz.push_back(cycles.frequency_Hz);
    sine_N_m_.push_back(cycles.sine_N_m);
    samples_per_period_.push_back(cycles.samples_per_period);
    for (std::size_t j = 0; j < sensors_.size(); ++j) {
      made_.values[j].push_back(cycles.values[j]);
      made_.coherence[j].push_back(std::numeric_limits<double>::quiet_NaN());
      if (!is_perfect(options_.imperfections[j])) keep(j, std::move(cycles.readings[j]));
    }
    auto& summary = made_.summary;
    if (cycles.change > summary.largest_change) {
      summary.largest_change = cycles.change;
      summary.largest_change_Hz = cycles.frequency_Hz;
    }
    if (cycles.change > kSettledChange) ++summary.unsettled;
    summary.measured_s += cycles_ / cycles.frequency_Hz;
    summary.reversals += cycles.hub.reversals;
    summary.stops += cycles.hub.stops;
    summary.stick_time_s += cycles.hub.stick_time_s;
  }

  /// Adds noise, now that the size of all readings is known.
  void impair() {
    for (std::size_t j = 0; j < sensors_.size(); ++j) {
      SensorImperfections at = options_.imperfections[j];
      if (is_perfect(at)) continue;
      RandomNumbers random(options_.noise_seed,
                           options_.first_noise_stream + static_cast<std::uint32_t>(j));
      at.noise = std::hypot(at.noise, at.relative_noise * root_mean_square(j));
      at.relative_noise = 0.0;
      made_.noise_deviation[j] = at.noise;
      for (std::size_t k = 0; k < kept_[j].size(); ++k) {
        response::impair(kept_[j][k], at, random);
        const auto part = correlation(samples_per_period_[k]).of(kept_[j][k]);
        made_.values[j][k] = part.whole / sine_N_m_[k] * delayed(j, made_.frequency_Hz[k]);
        made_.coherence[j][k] = coherence_of(part.cycles);
      }
    }
  }

  SteppedSineResponse& made() { return made_; }

 private:
  /// exp(-i omega delay): the cycles measured of a delayed sensor begin that much later.
  std::complex<double> delayed(std::size_t sensor, double frequency_Hz) const {
    const double turns = std::fmod(frequency_Hz * delay_s_[sensor], 1.0);
    return std::polar(1.0, -2.0 * std::numbers::pi * turns);
  }

  void keep(std::size_t sensor, std::vector<double> readings) {
    readings_ += static_cast<double>(readings.size());
    if (readings_ > kMostReadings) {
      throw arm::InputError(
          fmt::format("stepped-sine.cycles = {}: more than {:g} samples with noise; use fewer "
                      "cycles or frequencies",
                      cycles_, kMostReadings));
    }
    kept_[sensor].push_back(std::move(readings));
  }

  double root_mean_square(std::size_t sensor) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < sine_N_m_.size(); ++k) {
      sum += 0.5 * std::norm(made_.values[sensor][k] * sine_N_m_[k]);
    }
    return sine_N_m_.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(sine_N_m_.size()));
  }

  std::vector<arm::Sensor> sensors_;
  int cycles_;
  SteppedSineOptions options_;
  std::optional<SineCorrelation> correlation_;
  std::vector<double> delay_s_;   // one a sensor
  std::vector<double> sine_N_m_;  // one a frequency, as is samples_per_period_
  std::vector<int> samples_per_period_;
  std::vector<Samples> kept_;  // of sensors with noise: samples of each frequency
  double readings_ = 0.0;
  SteppedSineResponse made_;
};

}  // namespace

int samples_per_period(bool is_linear, double frequency_Hz, double highest_Hz) {
  if (is_linear) return kLinearSamples;
  const double needed = std::ceil(kSamplesOfHighestMode * highest_Hz / frequency_Hz);
  return static_cast<int>(
      std::clamp(needed, double{kNonlinearSamples}, static_cast<double>(kMostSamples)));
}

SteppedSineResponse measure_stepped_sine(const arm::ModalModel& model, const ArmParts& parts,
                                         std::span<const arm::Sensor> sensors,
                                         const SteppedSine& sine, const SteppedSineOptions& options,
                                         const SimulationProgress& progress) {
  const std::vector<double> frequencies = frequencies_Hz(sine);
  const ModalDynamics arm = modal_dynamics(model, parts, sensors);
  require_valid(parts, sensors, sine, options, arm);
  const bool is_linear =
      parts.hub.friction.empty() && parts.hub.smooth.empty() && parts.beam_forces.empty();
  // Wherever it stands the arm is the same: an angle that has grown costs digits.
  const bool turns_freely = arm.stiffness(0) == 0.0 && parts.hub.smooth.empty();
  Measuring measuring(parts, sensors, sine, options);
  auto& summary = measuring.made().summary;
  summary.least_samples_per_period = kMostSamples;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(arm.size());
  bool is_held = !parts.hub.friction.empty();
  for (std::size_t k = 0; k < frequencies.size() && summary.completed; ++k) {
    const SineDrive torque{sine.amplitude_N_m, sine.offset_N_m, frequencies[k]};
    const bool has_harmonics = !is_linear || clips(parts.actuator, torque);
    const int samples = samples_per_period(!has_harmonics, frequencies[k], highest_Hz(arm));
    DrivenArm driven(arm, model, parts, sensors, torque, samples, options.substeps);
    if (turns_freely) state(0) = 0.0;
    if (sine.settle_s) {
      driven.put(state, is_held);
      drive(driven, std::ceil(*sine.settle_s * frequencies[k]), summary);
    } else {
      // A linear arm forgets: from rest a free one does not carry its drift along.
      if (is_linear) state.setZero();
      summary.periods += find_steady_state(driven, state, is_held).periods;
    }
    Cycles cycles = measuring.drive(driven, frequencies[k], samples);
    if (!sine.settle_s && !is_linear && cycles.change > kSettledChange) {
      drive(driven, kFurtherPeriods, summary);
      cycles = measuring.drive(driven, frequencies[k], samples);
    }
    measuring.add(std::move(cycles));
    state = driven.state();
    is_held = driven.is_held();
    summary.least_samples_per_period = std::min(summary.least_samples_per_period, samples);
    summary.most_samples_per_period = std::max(summary.most_samples_per_period, samples);
    if (progress &&
        !progress(static_cast<double>(k + 1) / static_cast<double>(frequencies.size()))) {
      summary.completed = k + 1 == frequencies.size();
    }
  }
  measuring.impair();
  return std::move(measuring.made());
}

}  // namespace flexarm::response
