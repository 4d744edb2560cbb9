#include "measured/modal_fit.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kPi = std::numbers::pi;
/// A coherence is not believed to be closer to 1 than this.
constexpr double kCoherenceRounding = 1e-12;
/// Relative deviation of lines that nothing is known about.
constexpr double kUnknownDeviation = 0.01;
/// What a heavily damped mode is, and how near its column in the chart lies.
constexpr double kHeavy = 0.1;
constexpr double kHeavyTurn = 0.03;
constexpr double kNearColumn = 0.05;
constexpr double kNearDamping = 0.3;
/// Shares of the progress.
constexpr double kAfterChart = 0.1;
constexpr double kAfterSearch = 0.6;

struct Task {
  std::vector<arm::Sensor> sensors;
  std::vector<Stretch> search;  ///< what blocks are searched for in
  std::vector<Stretch> all;
  std::vector<DenominatorEquation> equations;
  FitBand band;
  double angle_period_s = 0.0;  ///< angle of the equations over omega
  double period_s = 0.0;        ///< of samples; 0 for frequency responses
};

void require_options(const ModalFitOptions& options) {
  const auto at_least = [](const char* key, double value, double least) {
    if (!(value >= least)) {
      throw arm::out_of_range(key, value, "", fmt::format("{:g} or more", least));
    }
  };
  at_least("modes", options.modes.value_or(1), 1);
  at_least("most_blocks", options.most_blocks, 1);
  at_least("highest_order", options.highest_order, 2);
  at_least("averages", options.averages, 1.0);
  at_least("search_samples", static_cast<double>(options.search_samples), kLeastSamples);
  if (options.band &&
      !(options.band->from_Hz >= 0.0 && options.band->to_Hz > options.band->from_Hz)) {
    throw arm::InputError(
        fmt::format("band = {:g} to {:g} Hz: must be from 0 or more to something above",
                    options.band->from_Hz, options.band->to_Hz));
  }
}

StabilisationChart chart_of(const Task& task, const ModalFitOptions& options) {
  Index lines = 0;
  for (const auto& equation : task.equations) lines = std::max(lines, equation.angle.size());
  const int highest =
      std::min(options.highest_order, static_cast<int>(std::max<Index>(2, lines / 3)));
  const CommonDenominator denominator(task.equations, highest);
  std::vector<OrderPoles> orders;
  for (int order = 2; order <= highest; order += 2) {
    const DenominatorPoles found = denominator.poles(order);
    OrderPoles at{order, {}, {}};
    std::vector<Index> kept;
    for (Index i = 0; i < found.z.size(); ++i) {
      const std::complex<double> s = std::log(found.z(i)) / task.angle_period_s;
      if (s.imag() <= 0.0 || !std::isfinite(std::abs(s))) continue;
      if (s.real() > options.stabilisation.undamped * std::abs(s)) continue;
      at.s_rad_per_s.push_back(s);
      kept.push_back(i);
    }
    at.residues = found.residues(Eigen::all, kept);
    orders.push_back(std::move(at));
  }
  return stabilisation_chart(orders, task.band.from_Hz, task.band.to_Hz, options.stabilisation);
}

void sort_flexible(BlockSet& set) {
  std::sort(set.blocks.begin() + (set.rigid ? 1 : 0), set.blocks.end(),
            [](const auto& a, const auto& b) { return a.a0_rad2_per_s2 < b.a0_rad2_per_s2; });
}

/// A block damped beyond kHeavy stands for one mode only where its residues are nearly real or the
/// chart has a column for it: the search puts others in place of several modes outside the band.
bool in_chart(const std::vector<StablePole>& columns, const FittedPole& pole) {
  return std::ranges::any_of(columns, [&](const StablePole& column) {
    return std::abs(column.frequency_Hz - pole.frequency_Hz) <= kNearColumn * pole.frequency_Hz &&
           std::abs(column.damping_ratio - pole.damping_ratio) <= kNearDamping * pole.damping_ratio;
  });
}

void describe_poles(ModalFit& fit, const BlockFit& best, const ModalFitOptions& options) {
  const auto columns = stable_poles(fit.chart, options.least_stable_orders);
  for (std::size_t m = 0; m < fit.blocks.blocks.size(); ++m) {
    const SecondOrderBlock& block = fit.blocks.blocks[m];
    const Index at = fit.blocks.first_parameter(m);
    const double deviation = std::sqrt(fit.covariance(at, at));
    if (fit.blocks.is_rigid(m)) {
      fit.rigid_a1_rad_per_s = block.a1_rad_per_s;
      fit.rigid_a1_std_rad_per_s = deviation;
      continue;
    }
    FittedPole pole{.frequency_Hz = block.omega_rad_per_s() / (2.0 * kPi),
                    .damping_ratio = block.damping_ratio(),
                    .damping_ratio_std = std::sqrt(fit.covariance(at + 1, at + 1)),
                    .s_rad_per_s = block.poles_rad_per_s()};
    pole.frequency_std_Hz = pole.frequency_Hz * deviation;
    pole.residue_turn = residue_turn(best, m);
    pole.is_mode = fit.band.contains(pole.frequency_Hz) &&
                   pole.damping_ratio <= options.most_damping_ratio &&
                   pole.residue_turn <= options.most_residue_turn &&
                   (pole.damping_ratio <= kHeavy || pole.residue_turn <= kHeavyTurn ||
                    in_chart(columns, pole));
    fit.poles.push_back(pole);
  }
}

/// Standard errors of a block's numerator; it is linear in the sensor's beta but for a0 and a1, so
/// differences of one standard error are its derivatives.
FittedNumerator numerator_of(const FittedTransfer& transfer, const MatrixXd& covariance,
                             std::size_t block) {
  const auto at = transfer.numerator(block);
  const Eigen::VectorXd values = transfer.values();
  Eigen::RowVectorXd d1 = Eigen::RowVectorXd::Zero(values.size());
  Eigen::RowVectorXd d0 = d1;
  for (Index i = 0; i < values.size(); ++i) {
    const double step = std::sqrt(covariance(i, i));
    if (!(step > 0.0)) continue;
    Eigen::VectorXd moved = values;
    moved(i) += step;
    const auto above = transfer.with(moved).numerator(block);
    moved(i) -= 2.0 * step;
    const auto below = transfer.with(moved).numerator(block);
    d1(i) = (above.b1 - below.b1) / (2.0 * step);
    d0(i) = (above.b0 - below.b0) / (2.0 * step);
  }
  return {at.b1, at.b0, std::sqrt(std::max(0.0, d1.dot(d1 * covariance))),
          std::sqrt(std::max(0.0, d0.dot(d0 * covariance)))};
}

void describe_sensors(ModalFit& fit, const BlockFit& blocks, const ResidualStudy& study) {
  for (std::size_t j = 0; j < blocks.models.size(); ++j) {
    const FittedTransfer& transfer = fit.transfers[j];
    const MatrixXd covariance = fit.covariance_of(j);
    FittedSensor sensor;
    sensor.sensor = blocks.models[j].sensor;
    for (std::size_t m = 0; m < fit.blocks.blocks.size(); ++m) {
      sensor.numerators.push_back(numerator_of(transfer, covariance, m));
    }
    const auto& last =
        blocks.models[j].columns[static_cast<std::size_t>(blocks.models[j].shared - 1)];
    if (last.kind == SensorColumn::Kind::remainder) {
      sensor.remainder = transfer.beta().tail<1>()(0);
      sensor.remainder_std = std::sqrt(covariance.bottomRightCorner<1, 1>()(0));
    }
    sensor.zeros = fitted_zeros(transfer, covariance, fit.band.from_Hz, fit.band.to_Hz);
    sensor.residual = study.sensors[j];
    fit.sensors.push_back(std::move(sensor));
  }
}

ModalFit fit_task(const Task& task, const ModalFitOptions& options) {
  ModalFit fit;
  fit.band = task.band;
  const auto report = [&](double fraction) {
    return !options.progress || options.progress(fraction);
  };
  fit.chart = chart_of(task, options);
  const ColumnChoices choices{.undamped_residues = options.undamped_residues,
                              .static_remainder = options.static_remainder,
                              .offset = options.offset};
  ProjectionOptions projection{.most_iterations = options.most_iterations};
  int passes = 0;
  projection.go_on = [&] {
    ++passes;
    return report(kAfterChart + (kAfterSearch - kAfterChart) * (1.0 - 1.0 / (1.0 + 0.03 * passes)));
  };
  const BlockSearch search = search_blocks(
      task.search, task.sensors, stable_poles(fit.chart, options.least_stable_orders), choices,
      {.band = task.band,
       .rigid = options.rigid_body,
       .modes = options.modes,
       .most_blocks = options.most_blocks,
       .bic_margin = options.bic_margin,
       .sampled = task.period_s > 0.0},
      projection);
  fit.order_trials = search.trials;
  fit.order_reason = search.reason;
  passes = 0;
  projection.go_on = [&] {
    ++passes;
    return report(kAfterSearch + (1.0 - kAfterSearch) * (1.0 - 1.0 / (1.0 + 0.2 * passes)));
  };
  BlockSet blocks = search.blocks;
  sort_flexible(blocks);
  BlockFit best = fit_blocks(task.all, task.sensors, blocks, choices, projection);
  if (task.period_s > 0.0) {
    fit.aliases = place_aliases(best, task.period_s, options.torque_hold, blocks);
    if (!fit.aliases.empty() && !best.cancelled) {
      sort_flexible(blocks);
      best = fit_blocks(task.all, task.sensors, blocks, choices, projection);
    }
  }
  fit.blocks = best.blocks;
  fit.iterations = best.iterations;
  fit.converged = best.converged;
  fit.cancelled = best.cancelled;
  const ResidualStudy study = study_residuals(task.all, best);
  const bool coloured = !std::ranges::all_of(study.sensors, &ResidualQuality::is_noise);
  fit.robust_covariance = options.robust.value_or(coloured);
  fit.covariance = fit.robust_covariance ? study.robust_covariance : joint_covariance(best);
  fit.parameters.resize(fit.covariance.rows());
  fit.parameters.head(fit.blocks.parameters()) = fit.blocks.theta();
  Index at = fit.blocks.parameters();
  for (std::size_t j = 0; j < best.models.size(); ++j) {
    const Index shared = best.models[j].shared;
    fit.transfers.emplace_back(fit.blocks, best.models[j], best.sensors[j].beta.head(shared));
    fit.parameters.segment(at, shared) = fit.transfers.back().beta();
    at += shared;
  }
  describe_poles(fit, best, options);
  describe_sensors(fit, best, study);
  report(1.0);
  return fit;
}

/// Standard deviation of real and imaginary part of each line.
std::vector<double> deviations(const FrequencyChannel& channel, std::size_t index,
                               const ModalFitOptions& options) {
  if (index < options.response_std.size() && !options.response_std[index].empty()) {
    const auto& given = options.response_std[index];
    const bool usable = given.size() == channel.response.size() &&
                        std::ranges::all_of(given, [](double d) { return d > 0.0; });
    if (!usable) {
      throw arm::InputError(fmt::format("response_std of {}: must be above 0, one a frequency",
                                        arm::to_string(channel.sensor)));
    }
    return given;
  }
  std::vector<double> deviation;
  for (std::size_t k = 0; k < channel.response.size(); ++k) {
    const double coherence = std::min(channel.coherence[k], 1.0 - kCoherenceRounding);
    const double relative =
        std::isnan(coherence) ? kUnknownDeviation
                              : std::sqrt((1.0 - coherence) / (2.0 * options.averages * coherence));
    deviation.push_back(relative * std::abs(channel.response[k]));
    if (!(deviation.back() > 0.0)) deviation.back() = std::numeric_limits<double>::infinity();
  }
  return deviation;
}

void require_record(const TimeRecord& record) {
  if (record.time_s.size() < kLeastSamples) {
    throw arm::InputError(fmt::format("samples = {}: too few to fit; must be {} or more",
                                      record.time_s.size(), kLeastSamples));
  }
  if (record.channels.empty()) throw arm::InputError("a record without a sensor cannot be fitted");
  if (std::ranges::all_of(record.torque_N_m, [](double u) { return u == 0.0; })) {
    throw arm::InputError("torque is zero at every sample: there is no response to fit");
  }
}

Index sensor_index(std::vector<arm::Sensor>& sensors, const arm::Sensor& sensor) {
  const auto at = std::ranges::find(sensors, sensor);
  const auto index = static_cast<Index>(at - sensors.begin());
  if (at == sensors.end()) sensors.push_back(sensor);
  return index;
}

}  // namespace

Index ModalFit::first_parameter(std::size_t sensor) const {
  Index first = blocks.parameters();
  for (std::size_t j = 0; j < sensor; ++j) first += transfers[j].beta().size();
  return first;
}

MatrixXd ModalFit::covariance_of(std::size_t sensor) const {
  std::vector<Index> at;
  for (Index i = 0; i < blocks.parameters(); ++i) at.push_back(i);
  for (Index i = 0; i < transfers[sensor].beta().size(); ++i) {
    at.push_back(first_parameter(sensor) + i);
  }
  return covariance(at, at);
}

std::optional<std::size_t> ModalFit::find(arm::SensorKind kind) const {
  const auto at = std::ranges::find_if(
      sensors, [kind](const FittedSensor& sensor) { return sensor.sensor.kind == kind; });
  if (at == sensors.end()) return std::nullopt;
  return static_cast<std::size_t>(at - sensors.begin());
}

ModalFit fit_modes(std::span<const TimeRecord> records, const ModalFitOptions& options) {
  require_options(options);
  if (records.empty()) throw arm::InputError("no record to fit");
  Task task;
  for (const TimeRecord& record : records) require_record(record);
  task.period_s = sampling_period_s(records.front());
  task.band = options.band.value_or(excited_band(records.front()));
  for (const TimeRecord& record : records.subspan(1)) {
    if (!options.band) task.band.to_Hz = std::max(task.band.to_Hz, excited_band(record).to_Hz);
  }
  if (task.band.to_Hz > 0.5 / task.period_s * (1.0 + 1e-9)) {
    throw arm::out_of_range("band", task.band.to_Hz, "Hz", "half the sampling frequency or less");
  }
  task.angle_period_s = 0.5 / task.band.to_Hz;
  for (std::size_t r = 0; r < records.size(); ++r) {
    const TimeRecord& record = records[r];
    std::vector<Index> sensors;
    for (const Channel& channel : record.channels) {
      sensors.push_back(sensor_index(task.sensors, channel.sensor));
    }
    const InitialState initial = options.initial.empty()
                                     ? InitialState::rest
                                     : options.initial[std::min(r, options.initial.size() - 1)];
    task.all.push_back(
        time_stretch(record, sensors, options.torque_hold, initial, record.time_s.size()));
    task.search.push_back(
        time_stretch(record, sensors, options.torque_hold, initial, options.search_samples));
    for (auto& equation :
         time_equations(record, options.rigid_body, task.band, options.search_samples)) {
      task.equations.push_back(std::move(equation));
    }
  }
  return fit_task(task, options);
}

ModalFit fit_modes(const FrequencyRecord& record, const ModalFitOptions& options) {
  require_options(options);
  if (record.channels.empty()) throw arm::InputError("no frequency response to fit");
  Task task;
  task.band = {std::numeric_limits<double>::infinity(), 0.0};
  for (const FrequencyChannel& channel : record.channels) {
    task.band.from_Hz = std::min(task.band.from_Hz, channel.frequency_Hz.front());
    task.band.to_Hz = std::max(task.band.to_Hz, channel.frequency_Hz.back());
  }
  if (options.band) task.band = *options.band;
  task.angle_period_s = 0.5 / task.band.to_Hz;
  for (std::size_t j = 0; j < record.channels.size(); ++j) {
    const FrequencyChannel& channel = record.channels[j];
    if (channel.frequency_Hz.size() < kLeastSamples / 4) {
      throw arm::InputError(fmt::format("{}: {} frequencies are too few to fit; must be {} or more",
                                        arm::to_string(channel.sensor), channel.frequency_Hz.size(),
                                        kLeastSamples / 4));
    }
    const std::vector<double> deviation = deviations(channel, j, options);
    task.sensors.push_back(channel.sensor);
    task.equations.push_back(frequency_equation(channel, deviation, options.rigid_body, task.band));
    task.all.push_back(frequency_stretch(channel, static_cast<Index>(j), deviation));
  }
  task.search = task.all;
  return fit_task(task, options);
}

ModalTable modal_table(const ModalFit& fit, double most_damping_ratio) {
  ModalTable table;
  int order = 0;
  const auto above_zero = [](double deviation) {
    return std::isfinite(deviation) ? std::optional(deviation) : std::nullopt;
  };
  for (const FittedPole& pole : fit.poles) {
    if (!pole.is_mode) continue;
    table.push_back({.sensor = std::nullopt,
                     .feature = Feature::pole,
                     .order = ++order,
                     .frequency_Hz = pole.frequency_Hz,
                     .frequency_std_Hz = above_zero(pole.frequency_std_Hz),
                     .damping_ratio = pole.damping_ratio,
                     .damping_ratio_std = above_zero(pole.damping_ratio_std)});
  }
  for (const FittedSensor& sensor : fit.sensors) {
    order = 0;
    for (const FittedZero& zero : sensor.zeros) {
      if (!zero.in_band || std::abs(zero.damping_ratio) > most_damping_ratio) continue;
      table.push_back({.sensor = sensor.sensor,
                       .feature = Feature::zero,
                       .order = ++order,
                       .frequency_Hz = zero.frequency_Hz,
                       .frequency_std_Hz = above_zero(zero.frequency_std_Hz),
                       .damping_ratio = zero.damping_ratio,
                       .damping_ratio_std = above_zero(zero.damping_ratio_std)});
    }
  }
  return table;
}

}  // namespace flexarm::measured
