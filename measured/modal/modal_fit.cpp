#include "measured/modal/modal_fit.hpp"

#include "measured/modal/fitted_residues.hpp"
#include "measured/modal/modal_fit_task.hpp"
#include "measured/modal/modes_beyond.hpp"
#include "measured/modal/noise_levels.hpp"
#include "measured/modal/propagated_error.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// What a heavily damped mode is, and how near its column in the chart lies.
constexpr double kHeavy = 0.1;
constexpr double kHeavyTurn = 0.03;
constexpr double kNearColumn = 0.05;
/// Standard errors above 0 of a damping ratio that a free decay shows without a column.
constexpr double kSureDecay = 4.0;
constexpr double kNearDamping = 0.3;
/// Residuals below this share of the reading are rounding, whatever their colour.
constexpr double kOnlyRounding = 1e-6;
/// A fit that leaves less of every sensor has converged, whatever its steps in standard errors.
constexpr double kBelowAnyNoise = 1e-5;
constexpr double kAfterChart = 0.1;  // shares of the progress
constexpr double kOfSearch = 0.55;
constexpr double kHalfWay = 0.55;
constexpr int kWeighings = 3;
/// Frequency over the upper end of the band of a block that is beyond it.
constexpr double kBeyondBand = 1.1;

StabilisationChart chart_of(const ModalFitTask& task, const ModalFitOptions& options) {
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
  std::sort(set.blocks.begin() + (set.rigid ? 1 : 0),
            set.blocks.begin() + static_cast<std::ptrdiff_t>(set.free_blocks()),
            [](const auto& a, const auto& b) { return a.a0_rad2_per_s2 < b.a0_rad2_per_s2; });
}

/// Which poles the chart has a column for: of those near a column the nearest.
std::vector<bool> in_chart(std::span<const StablePole> columns, std::span<const FittedPole> poles,
                           double undamped) {
  std::vector<bool> found(poles.size(), false);
  for (const StablePole& column : columns) {
    double nearest = std::numeric_limits<double>::infinity();
    std::size_t at = poles.size();
    for (std::size_t i = 0; i < poles.size(); ++i) {
      const double off = std::abs(column.frequency_Hz / poles[i].frequency_Hz - 1.0);
      const double damping_off = std::abs(column.damping_ratio - poles[i].damping_ratio);
      const bool near = off <= kNearColumn &&
                        damping_off <= kNearDamping * std::abs(poles[i].damping_ratio) + undamped;
      if (!near || off + damping_off >= nearest) continue;
      nearest = off + damping_off;
      at = i;
    }
    if (at < poles.size()) found[at] = true;
  }
  return found;
}

/// Whether a pole has another one beside it that the chart has a column for.
bool is_beside(const FittedPole& pole, std::span<const FittedPole> poles,
               const std::vector<bool>& charted) {
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (charted[i] && &poles[i] != &pole &&
        std::abs(poles[i].frequency_Hz / pole.frequency_Hz - 1.0) <= kNearColumn) {
      return true;
    }
  }
  return false;
}

/// Tells modes from blocks that the search puts in place of several modes outside the band (damped,
/// residues far from imaginary) or, where the model leaves something unexplained, beside a mode
/// whose damping changes with its amplitude.
void judge_poles(ModalFit& fit, const ModalFitOptions& options, bool unexplained) {
  const auto columns = stable_poles(fit.chart, options.least_stable_orders);
  const auto charted = in_chart(columns, fit.poles, options.stabilisation.undamped);
  for (std::size_t i = 0; i < fit.poles.size(); ++i) {
    FittedPole& pole = fit.poles[i];
    pole.is_mode = false;
    if (!fit.band.contains(pole.frequency_Hz)) continue;
    if (std::abs(pole.damping_ratio) > options.most_damping_ratio) continue;
    const bool is_light = pole.damping_ratio <= kHeavy;
    if (fit.free_decay) {  // without residues
      const bool decays = pole.damping_ratio > kSureDecay * pole.damping_ratio_std;
      pole.is_mode = charted[i] || (decays && is_light);
    } else if (!is_light) {
      pole.is_mode = pole.residue_turn <= kHeavyTurn ||
                     (charted[i] && pole.residue_turn <= options.most_residue_turn);
    } else {
      const bool is_split = unexplained && is_beside(pole, fit.poles, charted);
      pole.is_mode = charted[i] || (pole.residue_turn <= options.most_residue_turn && !is_split);
    }
  }
}

void describe_poles(ModalFit& fit, const BlockFit& best) {
  for (std::size_t m = 0; m < fit.blocks.free_blocks(); ++m) {
    const SecondOrderBlock& block = fit.blocks.blocks[m];
    const Index at = fit.blocks.first_parameter(m);
    const double deviation = std::sqrt(fit.covariance(at, at));
    if (fit.blocks.is_rigid(m)) {
      fit.rigid_a1_rad_per_s = block.a1_rad_per_s;
      fit.rigid_a1_std_rad_per_s = deviation;
      continue;
    }
    FittedPole pole{.frequency_Hz = block.omega_rad_per_s() / (2.0 * std::numbers::pi),
                    .damping_ratio = block.damping_ratio(),
                    .damping_ratio_std = std::sqrt(fit.covariance(at + 1, at + 1)),
                    .s_rad_per_s = block.poles_rad_per_s()};
    pole.frequency_std_Hz = pole.frequency_Hz * deviation;
    pole.residue_turn = residue_turn(best, m, 0.0);
    fit.poles.push_back(pole);
  }
}

std::size_t first_flexible(const ModalFit& fit) {
  return fit.blocks.rigid ? 1 : 0;
}

/// Lightly damped ones: a phase that heavy damping turns is no delay's.
std::vector<std::size_t> mode_blocks(const ModalFit& fit) {
  std::vector<std::size_t> blocks;
  for (std::size_t i = 0; i < fit.poles.size(); ++i) {
    if (fit.poles[i].is_mode && fit.poles[i].damping_ratio <= kHeavy) {
      blocks.push_back(first_flexible(fit) + i);
    }
  }
  return blocks;
}

FittedNumerator numerator_of(const FittedTransfer& transfer, const MatrixXd& covariance,
                             std::size_t block) {
  const auto at = transfer.numerator(block);
  const auto gradient = transfer.numerator_gradient(block);
  return {at.b1, at.b0, propagated_error(gradient.row(0), covariance),
          propagated_error(gradient.row(1), covariance)};
}

void describe_sensors(ModalFit& fit, const BlockFit& blocks, const ResidualStudy& study) {
  for (std::size_t j = 0; j < blocks.models.size(); ++j) {
    const FittedTransfer& transfer = fit.transfers[j];
    const MatrixXd covariance = fit.covariance_of(j);
    FittedSensor sensor;
    sensor.sensor = blocks.models[j].sensor;
    for (std::size_t m = 0; m < fit.blocks.free_blocks(); ++m) {
      sensor.numerators.push_back(numerator_of(transfer, covariance, m));
    }
    const auto& columns = blocks.models[j].columns;
    const Index shared = blocks.models[j].shared;
    if (shared > 0 &&
        columns[static_cast<std::size_t>(shared - 1)].kind == SensorColumn::Kind::remainder) {
      sensor.remainder = transfer.beta().tail<1>()(0);
      sensor.remainder_std = std::sqrt(covariance.bottomRightCorner<1, 1>()(0));
    }
    sensor.zeros = fitted_zeros(transfer, covariance, fit.band.from_Hz, fit.band.to_Hz);
    sensor.residual = study.sensors[j];
    fit.sensors.push_back(std::move(sensor));
  }
}

/// Where blocks begin to lie beyond the band [rad/s]; infinite for frequency responses.
double beyond_band_rad_per_s(const ModalFitTask& task) {
  return task.in_time ? 2.0 * std::numbers::pi * kBeyondBand * task.band.to_Hz
                      : std::numeric_limits<double>::infinity();
}

/// What a search and the fit after it came to.
struct Attempt {
  BlockFit best;
  std::vector<OrderTrial> trials;
  std::string reason;
  std::vector<MovedBlock> aliases;
  ColumnChoices choices;
};

/// Searches for blocks, then fits them to all data; `report` takes the share done.
Attempt attempt(const ModalFitTask& task, const ModalFitOptions& options,
                const ColumnChoices& choices, const StabilisationChart& chart,
                const std::function<bool(double)>& report) {
  Attempt made;
  made.choices = choices;
  ProjectionOptions projection{.most_iterations = options.most_iterations};
  int passes = 0;
  projection.go_on = [&] {
    ++passes;
    return report(kOfSearch * (1.0 - 1.0 / (1.0 + 0.03 * passes)));
  };
  BlockSearch search = search_blocks(task.search, task.sensors,
                                     stable_poles(chart, options.least_stable_orders), choices,
                                     {.band = task.band,
                                      .rigid = options.rigid_body,
                                      .modes = options.modes,
                                      .most_blocks = options.most_blocks,
                                      .bic_margin = options.bic_margin,
                                      .highest_Hz = task.highest_Hz},
                                     projection);
  made.trials = std::move(search.trials);
  made.reason = std::move(search.reason);
  passes = 0;
  projection.go_on = [&] {
    ++passes;
    return report(kOfSearch + (1.0 - kOfSearch) * (1.0 - 1.0 / (1.0 + 0.2 * passes)));
  };
  BlockSet blocks = search.blocks;
  sort_flexible(blocks);
  made.best = fit_blocks(task.all, task.sensors, blocks, choices, projection);
  if (task.period_s > 0.0) {
    made.aliases = place_aliases(made.best, task.period_s, options.torque_hold, blocks);
    if (!made.aliases.empty() && !made.best.cancelled) {
      sort_flexible(blocks);
      made.best = fit_blocks(task.all, task.sensors, blocks, choices, projection);
    }
  }
  return made;
}

/// Where noisy data leave a block beyond the band, the same with undamped residues for such blocks
/// and what jumps of the torque excite at once is tried, and the better of the two by BIC taken:
/// samples next to half the sampling frequency tell one number of a residue, and two make zeros
/// that might be anywhere.
Attempt search_and_fit(const ModalFitTask& task, const ModalFitOptions& options,
                       const StabilisationChart& chart, double from, double to) {
  const auto part = [&](double begin, double end) {
    return [&options, begin, end](double share) {
      return !options.progress || options.progress(begin + (end - begin) * share);
    };
  };
  ColumnChoices choices{.undamped_residues = options.undamped_residues,
                        .static_remainder = options.static_remainder,
                        .offset = options.offset,
                        .jumps = false,
                        .forced = task.forced};
  const double limit = beyond_band_rad_per_s(task);
  const double middle = 0.5 * (from + to);
  Attempt whole = attempt(task, options, choices, chart, part(from, middle));
  const bool beyond = std::ranges::any_of(
      whole.best.blocks.blocks,
      [&](const SecondOrderBlock& block) { return block.omega_rad_per_s() > limit; });
  if (!beyond || whole.best.cancelled || options.undamped_residues) return whole;
  choices.undamped_above_rad_per_s = limit;
  choices.jumps = options.torque_hold == TorqueHold::zero;
  Attempt undamped = attempt(task, options, choices, chart, part(middle, to));
  if (undamped.best.cancelled || undamped.best.bic() < whole.best.bic()) return undamped;
  return whole;
}

/// Places in `ModalFit::parameters` of a block's numerators, all sensors'.
std::vector<Index> numerator_places(const ModalFit& fit, std::size_t block) {
  std::vector<Index> places;
  for (std::size_t j = 0; j < fit.transfers.size(); ++j) {
    const auto& columns = fit.transfers[j].model().columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].kind != SensorColumn::Kind::forced || columns[i].block != block) continue;
      places.push_back(fit.first_parameter(j) + static_cast<Index>(i));
    }
  }
  return places;
}

/// Heavily damped blocks, and those within the band, that are no modes may stand for a mode far
/// beyond half the sampling frequency, of which samples show the ring that folds down: then they
/// are no part of G. What the fit without such a block would differ by, to first order -C_pb
/// C_bb^-1 b with b its numerators, counts as an error.
void count_unsure_blocks(ModalFit& fit) {
  MatrixXd counted = fit.covariance;
  for (std::size_t i = 0; i < fit.poles.size(); ++i) {
    const FittedPole& pole = fit.poles[i];
    const bool far = pole.frequency_Hz > fit.band.to_Hz && pole.damping_ratio <= kHeavy;
    if (pole.is_mode || far) continue;
    const auto places = numerator_places(fit, first_flexible(fit) + i);
    Eigen::VectorXd change = Eigen::VectorXd::Zero(fit.parameters.size());
    change(places) = -fit.parameters(places);
    counted += change * change.transpose();
  }
  fit.covariance = counted;
}

/// Whether more than this share of the reading of some sensor is left.
bool leaves_more(const ResidualStudy& study, double share) {
  return !std::ranges::all_of(study.sensors,
                              [&](const auto& left) { return left.relative <= share; });
}

ModalFit fit_task(ModalFitTask task, const ModalFitOptions& options) {
  ModalFit fit;
  fit.band = task.band;
  fit.free_decay = !task.forced;
  fit.chart = chart_of(task, options);
  const bool several_runs = task.in_time && task.all.size() > 1;
  const double middle = several_runs ? kHalfWay : 1.0;
  ProjectionOptions projection{.most_iterations = options.most_iterations};
  if (options.progress) projection.go_on = [&] { return options.progress(1.0); };
  Attempt found = search_and_fit(task, options, fit.chart, kAfterChart, middle);
  BlockFit& best = found.best;
  if (several_runs && !best.cancelled && weigh_runs(best, task.all)) {
    weigh_runs(best, task.search);
    found = search_and_fit(task, options, fit.chart, middle, 1.0);
    // The first weights count what a loud run bent the fit of a quiet one by.
    for (int round = 0; round < kWeighings && !best.cancelled; ++round) {
      weigh_runs(best, task.all);
      best = fit_blocks(task.all, task.sensors, best.blocks, found.choices, projection);
    }
  }
  fit.order_trials = found.trials;
  fit.order_reason = found.reason;
  fit.aliases = found.aliases;
  fit.cancelled = best.cancelled;
  if (fit.cancelled) return fit;
  ResidualStudy study = study_residuals(task.all, best);
  if (task.forced && leaves_more(study, kOnlyRounding)) {
    ModesBeyond beyond = with_modes_beyond(best, found.choices, fit.band);
    beyond.choices.jumps = options.torque_hold == TorqueHold::zero;
    best = fit_blocks(task.all, task.sensors, beyond.blocks, beyond.choices, projection);
    BlockSet ascending = best.blocks;
    sort_flexible(ascending);
    if (ascending.theta() != best.blocks.theta()) {
      best = fit_blocks(task.all, task.sensors, ascending, beyond.choices, projection);
    }
    study = study_residuals(task.all, best);
  }
  fit.cancelled = best.cancelled;
  fit.iterations = best.iterations;
  fit.converged = best.converged || !leaves_more(study, kBelowAnyNoise);
  fit.blocks = best.blocks;
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
  if (options.covariance) fit.covariance = options.covariance(fit);
  describe_poles(fit, best);
  const bool unexplained = std::ranges::any_of(study.sensors, [](const ResidualQuality& residual) {
    return !residual.is_noise() && residual.relative > kOnlyRounding;
  });
  judge_poles(fit, options, unexplained);
  fit.delay_s = residue_delay_s(best, mode_blocks(fit));
  if (fit.delay_s > 0.0) {
    for (std::size_t i = 0; i < fit.poles.size(); ++i) {
      fit.poles[i].residue_turn = residue_turn(best, first_flexible(fit) + i, fit.delay_s);
    }
    judge_poles(fit, options, unexplained);
  }
  if (task.forced && leaves_more(study, kOnlyRounding)) count_unsure_blocks(fit);
  describe_sensors(fit, best, study);
  if (options.progress) options.progress(1.0);
  return fit;
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
  return fit_task(time_task(records, options), options);
}

ModalFit fit_modes(const FrequencyRecord& record, const ModalFitOptions& options) {
  return fit_task(frequency_task(record, options), options);
}

ModalTable modal_table(const ModalFit& fit, double most_damping_ratio) {
  ModalTable table;
  const auto above_zero = [](double deviation) {
    return std::isfinite(deviation) ? std::optional(deviation) : std::nullopt;
  };
  for (const FittedPole& pole : fit.poles) {
    if (!pole.is_mode) continue;
    table.push_back({.sensor = std::nullopt,
                     .feature = Feature::pole,
                     .order = {},
                     .frequency_Hz = pole.frequency_Hz,
                     .frequency_std_Hz = above_zero(pole.frequency_std_Hz),
                     .damping_ratio = pole.damping_ratio,
                     .damping_ratio_std = above_zero(pole.damping_ratio_std)});
  }
  for (const FittedSensor& sensor : fit.sensors) {
    for (const FittedZero& zero : sensor.zeros) {
      if (!zero.in_band || !zero.is_told) continue;
      if (std::abs(zero.damping_ratio) > most_damping_ratio) continue;
      table.push_back({.sensor = sensor.sensor,
                       .feature = Feature::zero,
                       .order = {},
                       .frequency_Hz = zero.frequency_Hz,
                       .frequency_std_Hz = above_zero(zero.frequency_std_Hz),
                       .damping_ratio = zero.damping_ratio,
                       .damping_ratio_std = above_zero(zero.damping_ratio_std)});
    }
  }
  return table;
}

}  // namespace flexarm::measured
