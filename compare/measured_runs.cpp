#include "compare/measured_runs.hpp"

#include "arm/input_error.hpp"
#include "compare/simulated_run.hpp"
#include "measured/files/time_record.hpp"
#include "measured/spectra/robust.hpp"
#include "response/arm_parts.hpp"
#include "response/formulation_maker.hpp"
#include "response/time/arm_simulator.hpp"
#include "response/time/time_model.hpp"
#include "response/truncation.hpp"

#include <Eigen/Core>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

namespace flexarm::compare {

namespace {

using Eigen::Index;

/// Weight of readings in the estimate of a free initial state, relative to the deviation of their
/// signal: small enough that the prior of the state does not count beside a run of readings.
constexpr double kReadingDeviation = 0.01;

/// Flexible modes of a record of any length, and of a short one: the responses from all initial
/// states of a free run are kept, 0.5 GB for 250,000 samples of three sensors.
constexpr int kLeastAffordable = 16;
constexpr int kMostAffordable = 40;

/// The values at samples that are readings.
std::vector<double> readings_of(const std::vector<double>& values,
                                const std::vector<std::size_t>& left_out) {
  std::vector<double> readings;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (!std::ranges::binary_search(left_out, k)) readings.push_back(values[k]);
  }
  return readings;
}

double nrmse_percent_of(const MeasuredSignal& signal) {
  const auto measured = readings_of(signal.measured, signal.left_out);
  const auto simulated = readings_of(signal.simulated, signal.left_out);
  const auto count = std::ssize(measured);
  const Eigen::Map<const Eigen::ArrayXd> y(measured.data(), count);
  const Eigen::Map<const Eigen::ArrayXd> yhat(simulated.data(), count);
  constexpr double kRounding = 1e-12;  // of the mean of a constant signal
  const double spread = count > 0 ? (y - y.mean()).matrix().norm() : 0.0;
  return spread > kRounding * y.matrix().norm() ? 100.0 * (y - yhat).matrix().norm() / spread
                                                : std::numeric_limits<double>::quiet_NaN();
}

/// The channels of the run without their simulation, the torque of a closed loop behind them.
std::vector<MeasuredSignal> signals_of(const measured::TimeRecord& record, bool closed_loop) {
  std::vector<MeasuredSignal> signals;
  for (const auto& channel : record.channels) {
    signals.push_back({arm::to_string(channel.sensor),
                       std::string(arm::unit(channel.sensor)),
                       channel.values,
                       {},
                       channel.left_out});
  }
  if (closed_loop) signals.push_back({"torque", "N m", record.torque_N_m, {}});
  return signals;
}

}  // namespace

MeasuredTimeRun run_beside_simulation(const arm::Arm& arm, const measured::MeasuredRun& run,
                                      const arm::Deadline& deadline) try {
  arm::require_time(deadline);
  const auto& record = std::get<measured::TimeRecord>(run.data);
  arm::Arm loaded = arm;
  if (run.run.payload) loaded.payload = *run.run.payload;
  MeasuredTimeRun compared;
  compared.run = run.run.id;
  compared.payload = loaded.payload;
  compared.closed_loop = run.run.controller.has_value();
  compared.free_start = run.run.initial == measured::InitialState::free;
  compared.time_s = record.time_s;
  compared.torque_N_m = record.torque_N_m;
  if (compared.closed_loop) compared.reference = record.reference;
  compared.signals = signals_of(record, compared.closed_loop);

  std::vector<arm::Sensor> sensors;
  for (const auto& channel : record.channels) sensors.push_back(channel.sensor);
  auto parts = response::take_apart(loaded);
  // A torque that is logged late acts at once in a loop.
  const double logged_late_s = std::max(0.0, -parts.actuator.delay_s);
  if (compared.closed_loop) parts.actuator.delay_s = std::max(0.0, parts.actuator.delay_s);
  const double period_s = measured::sampling_period_s(record);
  const auto hold = run.run.torque_hold == measured::TorqueHold::zero ? response::TorqueHold::zero
                                                                      : response::TorqueHold::first;
  const int modes = response::truncation_in_time(
                        loaded, sensors, record.torque_N_m, period_s, hold,
                        {.most = response::affordable_modes(parts, record.time_s.size(),
                                                            kLeastAffordable, kMostAffordable)})
                        .modes;
  const auto model =
      response::time_model(response::formulation_of_fit(parts.linear), parts, modes, sensors, true);
  const response::ArmSimulator simulation(model, parts, sensors,
                                          response::options_of_fit(period_s, hold));
  const auto samples = static_cast<Index>(record.time_s.size());
  const auto readings = samples * static_cast<Index>(sensors.size());
  Eigen::VectorXd measured(readings);
  Eigen::VectorXd deviations(readings);
  for (Index c = 0; c < static_cast<Index>(sensors.size()); ++c) {
    const auto& channel = record.channels[static_cast<std::size_t>(c)];
    measured.segment(c * samples, samples) = Eigen::VectorXd::Map(channel.values.data(), samples);
    const double size = measured::standard_deviation(readings_of(channel.values, channel.left_out));
    deviations.segment(c * samples, samples)
        .setConstant(size > 0.0 ? kReadingDeviation * size
                                : std::numeric_limits<double>::infinity());
    for (const std::size_t k : channel.left_out) {
      deviations(c * samples + static_cast<Index>(k)) = std::numeric_limits<double>::infinity();
    }
  }
  const Eigen::VectorXd simulated =
      simulated_run(simulation, run, logged_late_s, measured, deviations, deadline);
  for (std::size_t c = 0; c < compared.signals.size(); ++c) {
    const auto values = simulated.segment(static_cast<Index>(c) * samples, samples);
    compared.signals[c].simulated.assign(values.begin(), values.end());
    compared.signals[c].nrmse_percent = nrmse_percent_of(compared.signals[c]);
  }
  return compared;
} catch (const arm::InputError& error) {
  throw arm::InputError(fmt::format("run {}: {}", run.run.id, error.what()));
}

}  // namespace flexarm::compare
