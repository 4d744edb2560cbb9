#include "measured/modal/block_search.hpp"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A residual below this times the reading is what rounding leaves of noise-free data.
constexpr double kNothingLeft = 1e-9;
/// Damping ratios and frequencies of the grid; their bands overlap at half power.
constexpr double kGridDamping[] = {0.1, 0.5};
constexpr int kGridFrequencies = 10;
/// LM iterations of a trial; the fit on all data ends properly.
constexpr int kTrialIterations = 15;

/// The rigid body's corner lies below this share of the lowest mode.
constexpr double kSlowRigidBody = 0.1;
/// A block without which BIC rises by more than this, the others as they are, stays.
constexpr double kWorthRefitting = 1000.0;

struct Candidate {
  SecondOrderBlock block;
  bool from_chart = false;
};

SecondOrderBlock block_at(double frequency_Hz, double damping_ratio) {
  return block_of(2.0 * std::numbers::pi * frequency_Hz, damping_ratio);
}

std::vector<Candidate> grid(const BlockSearchOptions& options) {
  std::vector<Candidate> places;
  const double from = std::max(options.band.from_Hz, options.band.to_Hz / 100.0);
  for (const double damping : kGridDamping) {
    for (int i = 0; i < kGridFrequencies; ++i) {
      const double share = (i + 0.5) / kGridFrequencies;
      places.push_back({block_at(from * std::pow(options.band.to_Hz / from, share), damping)});
    }
  }
  // A spring at the hub makes a mode of the rigid-body motion, which may lie below all lines.
  for (const double below : {1.0, 1.6, 2.5}) {
    const double frequency_Hz = options.band.from_Hz / below;
    if (frequency_Hz > 0.0) places.push_back({block_at(frequency_Hz, 0.1)});
  }
  for (const double beyond : {1.2, 1.6, 2.5}) {
    const double frequency_Hz = beyond * options.band.to_Hz;
    if (frequency_Hz < options.highest_Hz) places.push_back({block_at(frequency_Hz, 0.1)});
  }
  return places;
}

/// Columns y_j and of the model of some blocks among `all`, on the triangles of all. `look` is
/// called before each pass over a stretch.
class CandidateTriangles {
 public:
  CandidateTriangles(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                     const BlockSet& all, const ColumnChoices& choices,
                     const std::function<bool()>& look)
      : stretches_(stretches), all_(all), signals_(all) {
    // Signals of derivatives are not needed. Held blocks have none, but no free motion either.
    if (std::ranges::none_of(stretches, &Stretch::begins_in_motion)) {
      signals_.held = signals_.blocks.size();
    }
    for (const Stretch& stretch : stretches) {
      if (look) look();
      triangles_.push_back(triangle(stretch, signals_));
    }
    for (std::size_t j = 0; j < sensors.size(); ++j) {
      models_.push_back(sensor_model(sensors[j], static_cast<Index>(j), all, stretches, choices));
    }
  }

  /// The criterion, each stretch with residuals of its own size, of the first `held` blocks and
  /// block `added`.
  double criterion(std::size_t held, std::size_t added) const {
    double sum = 0.0;
    for (std::size_t j = 0; j < models_.size(); ++j) {
      for (std::size_t r = 0; r < stretches_.size(); ++r) {
        const auto at = std::ranges::find(stretches_[r].sensors, static_cast<Index>(j));
        if (at == stretches_[r].sensors.end()) continue;
        const SignalLayout layout = stretches_[r].layout(signals_);
        const VectorXd y =
            triangles_[r].col(layout.first_reading() + (at - stretches_[r].sensors.begin()));
        sum += static_cast<double>(stretches_[r].rows) * std::log(squares(j, r, y, held, added));
      }
    }
    return sum;
  }

 private:
  double squares(std::size_t j, std::size_t r, const VectorXd& y, std::size_t held,
                 std::size_t added) const {
    const SignalLayout layout = stretches_[r].layout(signals_);
    std::vector<VectorXd> columns;
    for (const SensorColumn& column : models_[j].columns) {
      if (column.is_of_block() && column.block >= held && column.block != added) continue;
      if (!column.is_common() && column.stretch != r) continue;
      columns.push_back(column_of(column, triangles_[r], layout, all_).normalized());
    }
    MatrixXd a(y.size(), static_cast<Index>(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i) a.col(static_cast<Index>(i)) = columns[i];
    const VectorXd x = a.colPivHouseholderQr().solve(y);
    return squares_above_rounding(y - a * x, y);
  }

  std::span<const Stretch> stretches_;
  const BlockSet& all_;
  BlockSet signals_;  // the blocks whose signals the triangles have
  std::vector<MatrixXd> triangles_;
  std::vector<SensorModel> models_;
};

/// The candidate that lowers the criterion most beside `held`, an index into `candidates`.
std::size_t best_of(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                    const BlockSet& held, const std::vector<Candidate>& candidates,
                    const ColumnChoices& choices, const std::function<bool()>& look) {
  BlockSet all = held;
  for (const Candidate& candidate : candidates) all.blocks.push_back(candidate.block);
  const CandidateTriangles of_all(stretches, sensors, all, choices, look);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    const double criterion = of_all.criterion(held.blocks.size(), held.blocks.size() + c);
    if (criterion < least) {
      least = criterion;
      best = c;
    }
  }
  return best;
}

bool nothing_left(const BlockFit& fit, const std::vector<double>& sizes) {
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) {
    if (fit.sensors[j].squares > kNothingLeft * kNothingLeft * sizes[j]) return false;
  }
  return true;
}

/// Sums of squares of the readings.
std::vector<double> sizes_of(std::span<const Stretch> stretches, std::size_t sensors) {
  std::vector<double> sizes(sensors, 0.0);
  for (const Stretch& stretch : stretches) {
    const MatrixXd r = triangle(stretch, BlockSet{});
    for (std::size_t i = 0; i < stretch.sensors.size(); ++i) {
      sizes[static_cast<std::size_t>(stretch.sensors[i])] +=
          r.col(stretch.layout(BlockSet{}).first_reading() + static_cast<Index>(i)).squaredNorm();
    }
  }
  return sizes;
}

class Search {
 public:
  Search(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
         const ColumnChoices& choices, const BlockSearchOptions& options,
         const ProjectionOptions& projection)
      : stretches_(stretches),
        sensors_(sensors),
        choices_(choices),
        options_(options),
        projection_(projection),
        sizes_(sizes_of(stretches, sensors.size())) {
    projection_.most_iterations = kTrialIterations;
    projection_.step_in_standard_errors = 0.05;
    BlockSet first{.blocks = {}, .rigid = options.rigid};
    if (options.rigid) first.blocks.push_back({});
    // Without any mode the rigid body's a1 would run off after them.
    ProjectionOptions as_is = projection_;
    as_is.most_iterations = 0;
    best_ = fit_blocks(stretches_, sensors_, first, choices_, as_is);
    result_.trials.push_back({.blocks = 0, .bic = best_.bic(), .kept = true});
  }

  BlockSearch run(std::vector<Candidate> chart) {
    while (!done()) {
      if (!chart.empty() && try_one(chart)) continue;
      // What the chart offers is used up, or does not help: a heavily damped block may.
      chart.clear();
      std::vector<Candidate> places = grid(options_);
      if (!try_one(places)) {
        result_.reason = fmt::format(
            "an additional second-order section changes BIC by {:+.1f}; threshold -{:g}",
            result_.trials.back().bic - best_.bic(), options_.bic_margin);
        break;
      }
    }
    if (const int pruned = options_.modes ? 0 : prune(); pruned > 0) {
      result_.reason += fmt::format("; {} section{} removed by backward elimination", pruned,
                                    pruned == 1 ? "" : "s");
    }
    result_.blocks = best_.blocks;
    return result_;
  }

 private:
  BlockFit fit(const BlockSet& start) const {
    return fit_blocks(stretches_, sensors_, start, choices_, projection_);
  }

  int flexible() const {
    return static_cast<int>(best_.blocks.blocks.size()) - (options_.rigid ? 1 : 0);
  }

  bool done() {
    if (options_.modes && flexible() >= *options_.modes) {
      result_.reason = "number of modes given";
    } else if (nothing_left(best_, sizes_)) {
      result_.reason = "residual at the rounding level";
    } else if (flexible() >= options_.most_blocks) {
      result_.reason = fmt::format("limit of {} sections reached", options_.most_blocks);
    } else if (best_.cancelled) {
      result_.reason = "cancelled";
    }
    return !result_.reason.empty();
  }

  bool try_one(std::vector<Candidate>& candidates) {
    const std::size_t at =
        best_of(stretches_, sensors_, best_.blocks, candidates, choices_, projection_.go_on);
    const Candidate candidate = candidates[at];
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(at));
    BlockSet more = best_.blocks;
    if (options_.rigid && ran_off(more)) more.blocks.front() = {};
    more.blocks.push_back(candidate.block);
    BlockFit trial = fit(more);
    const SecondOrderBlock& added = trial.blocks.blocks.back();
    const bool kept = trial.bic() < best_.bic() - options_.bic_margin || options_.modes;
    result_.trials.push_back({.blocks = flexible() + 1,
                              .bic = trial.bic(),
                              .frequency_Hz = added.omega_rad_per_s() / (2.0 * std::numbers::pi),
                              .damping_ratio = added.damping_ratio(),
                              .from_chart = candidate.from_chart,
                              .kept = kept});
    if (kept) best_ = std::move(trial);
    return kept;
  }

  /// Blocks that others have made superfluous go again: those without which BIC is no more than the
  /// margin higher. Returns how many.
  int prune() {
    int pruned = 0;
    while (flexible() > 1) {
      const std::size_t first = options_.rigid ? 1 : 0;
      const std::vector<double> bic = bic_without_each(stretches_, best_, first);
      const auto lowest = std::ranges::min_element(bic);
      if (*lowest > best_.bic() + kWorthRefitting) break;
      BlockFit fewer = fit(without(first + static_cast<std::size_t>(lowest - bic.begin())));
      if (fewer.bic() > best_.bic() + options_.bic_margin) break;
      best_ = std::move(fewer);
      ++pruned;
    }
    return pruned;
  }

  /// The rigid body's a1 took part in describing a mode that was not there yet.
  static bool ran_off(const BlockSet& set) {
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t m = 1; m < set.blocks.size(); ++m) {
      lowest = std::min(lowest, set.blocks[m].omega_rad_per_s());
    }
    return std::abs(set.blocks.front().a1_rad_per_s) > kSlowRigidBody * lowest;
  }

  BlockSet without(std::size_t block) const {
    BlockSet fewer = best_.blocks;
    fewer.blocks.erase(fewer.blocks.begin() + static_cast<std::ptrdiff_t>(block));
    return fewer;
  }

  std::span<const Stretch> stretches_;
  std::span<const arm::Sensor> sensors_;
  ColumnChoices choices_;
  BlockSearchOptions options_;
  ProjectionOptions projection_;
  std::vector<double> sizes_;
  BlockFit best_;
  BlockSearch result_;
};

}  // namespace

BlockSearch search_blocks(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                          std::span<const StablePole> candidates, const ColumnChoices& choices,
                          const BlockSearchOptions& options, const ProjectionOptions& projection) {
  std::vector<Candidate> chart;
  for (const StablePole& pole : candidates) {
    chart.push_back({block_at(pole.frequency_Hz, pole.damping_ratio), true});
  }
  return Search(stretches, sensors, choices, options, projection).run(std::move(chart));
}

}  // namespace flexarm::measured
