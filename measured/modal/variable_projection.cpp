#include "measured/modal/variable_projection.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace flexarm::measured {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A Newton step in log(omega) and damping ratios that rounding of the criterion may hide.
constexpr double kRoundingStep = 1e-7;
/// A fall of the criterion that is none, in units of the square of the step asked for.
constexpr double kNoGain = 100.0;
/// The largest step of log(omega) and of a damping ratio.
constexpr double kLargestStep = 0.3;
/// Of the slope at the beginning of a step, with the other sign: a step that ends on more of it has
/// passed the minimum.
constexpr double kPassed = 0.2;
/// Steps are looked at for that where the minimum is within so many standard errors.
constexpr double kNearMinimum = 2.0;
/// Decay within a sampling period, as its exponent, that a step may reach: a block that is faster
/// shows at samples as a constant beside the static remainder, both as large as they like.
constexpr double kMostDecay = 7.0;
/// Growth of a free motion over a run, as its exponent, that a step may reach.
constexpr double kMostGrowth = 8.0;

/// The sensors' linear problems at one theta.
struct Evaluation {
  BlockSet blocks;
  std::vector<SensorEstimate> sensors;
  VectorXd gradient;     ///< of the criterion/2
  MatrixXd information;  ///< Gauss-Newton, of the criterion/2
  double criterion = 0.0;
};

class Fitter {
 public:
  Fitter(std::span<const Stretch> stretches, std::vector<SensorModel> models)
      : stretches_(stretches), models_(std::move(models)) {
    for (const Stretch& stretch : stretches) {
      longest_s_ = std::max(longest_s_, stretch.duration_s);
      if (!stretch.in_time) continue;
      const double period_s = stretch.duration_s / static_cast<double>(stretch.rows);
      shortest_period_s_ =
          shortest_period_s_ > 0.0 ? std::min(shortest_period_s_, period_s) : period_s;
    }
  }

  const std::vector<SensorModel>& models() const { return models_; }

  Evaluation evaluate(const BlockSet& blocks) const {
    const std::vector<MatrixXd> factors = triangles(stretches_, blocks);
    Evaluation at{.blocks = blocks,
                  .sensors = {},
                  .gradient = VectorXd::Zero(blocks.parameters()),
                  .information = MatrixXd::Zero(blocks.parameters(), blocks.parameters())};
    for (std::size_t j = 0; j < models_.size(); ++j) {
      const SensorProblem problem(models_[j], static_cast<Index>(j), blocks, stretches_, factors);
      at.sensors.push_back(problem.solve(at.gradient, at.information));
      at.criterion += at.sensors.back().criterion();
    }
    if (!std::isfinite(at.criterion)) at.criterion = std::numeric_limits<double>::infinity();
    return at;
  }

  /// No free motion grows out of bounds within a run.
  bool is_admissible(const BlockSet& blocks) const {
    return std::ranges::all_of(blocks.blocks, [this](const SecondOrderBlock& block) {
      return -block.poles_rad_per_s()[0].real() * longest_s_ > -kMostGrowth &&
             std::isfinite(block.a0_rad2_per_s2);
    });
  }

  /// A flexible block that is gone before the next sample.
  bool is_too_fast(const SecondOrderBlock& block) const {
    return block.a0_rad2_per_s2 > 0.0 &&
           -block.poles_rad_per_s()[1].real() * shortest_period_s_ > kMostDecay;
  }

 private:
  std::span<const Stretch> stretches_;
  std::vector<SensorModel> models_;
  double longest_s_ = 0.0;
  double shortest_period_s_ = 0.0;  ///< 0 of frequency responses
};

/// Blocks that stay where they are: a step would make them too fast for the samples.
class HeldBlocks {
 public:
  /// Holds those of `there` that are too fast and were not. Returns whether there are any.
  bool hold(const Fitter& fitter, const BlockSet& there) {
    held_.resize(there.free_blocks(), false);
    bool any = false;
    for (std::size_t m = 0; m < there.free_blocks(); ++m) {
      if (held_[m] || !fitter.is_too_fast(there.blocks[m])) continue;
      held_[m] = true;
      any = true;
    }
    return any;
  }

  /// Takes their parameters out of a step.
  void take_out(const BlockSet& blocks, VectorXd& gradient, MatrixXd& information) const {
    for (std::size_t m = 0; m < held_.size(); ++m) {
      if (!held_[m]) continue;
      for (Index i = blocks.first_parameter(m); i < blocks.first_parameter(m) + 2; ++i) {
        gradient(i) = 0.0;
        information.row(i).setZero();
        information.col(i).setZero();
        information(i, i) = 1.0;
      }
    }
  }

 private:
  std::vector<bool> held_;
};

/// Roots of the diagonal, 1 where it is 0.
VectorXd unit_scale(const MatrixXd& matrix) {
  return matrix.diagonal().cwiseSqrt().unaryExpr([](double d) { return d > 0.0 ? d : 1.0; });
}

/// -(H + damping diag H)^-1 g in units of the diagonal; H is singular where a block is not seen.
VectorXd marquardt_step(const Evaluation& at, const HeldBlocks& held, double damping) {
  VectorXd gradient = at.gradient;
  MatrixXd information = at.information;
  held.take_out(at.blocks, gradient, information);
  const VectorXd scale = unit_scale(information);
  MatrixXd h = scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  h.diagonal().array() += damping;
  const VectorXd step = -h.ldlt().solve(gradient.cwiseQuotient(scale));
  return step.cwiseQuotient(scale);
}

/// Shortened so that no parameter but the rigid body's own changes by more than kLargestStep.
VectorXd shortened(VectorXd step, const BlockSet& blocks) {
  const Index first = blocks.rigid ? 1 : 0;
  const double largest =
      step.size() > first ? step.tail(step.size() - first).cwiseAbs().maxCoeff() : 0.0;
  return largest > kLargestStep ? VectorXd(step * (kLargestStep / largest)) : step;
}

/// The evaluation behind a step, which leads to `there`. Near the minimum a Gauss-Newton step in a
/// block that the data hardly show may pass it: then this is where the slope along the step is 0,
/// linear in between, if the criterion is lower there.
Evaluation behind_step(const Fitter& fitter, const Evaluation& at, const VectorXd& step,
                       const BlockSet& there, bool is_near_minimum) {
  Evaluation end = fitter.evaluate(there);
  const double before = at.gradient.dot(step);
  const double behind = end.gradient.dot(step);
  if (!is_near_minimum || !(behind > -kPassed * before)) return end;
  const VectorXd theta = at.blocks.theta() + before / (before - behind) * step;
  Evaluation between = fitter.evaluate(at.blocks.with(theta));
  return between.criterion < end.criterion ? between : end;
}

/// Coefficients of which something is known beforehand do not count as parameters.
void finish(BlockFit& fit, const Evaluation& at) {
  fit.blocks = at.blocks;
  fit.sensors = at.sensors;
  fit.criterion = at.criterion;
  const auto theta = static_cast<double>(at.blocks.parameters());
  fit.parameter_count = theta;
  const auto sensors = static_cast<double>(at.sensors.size());
  for (SensorEstimate& sensor : fit.sensors) {
    const auto linear = static_cast<double>(std::ranges::count(
        fit.models[static_cast<std::size_t>(&sensor - fit.sensors.data())].columns, 0.0,
        &SensorColumn::tightness));
    fit.parameter_count += linear;
    sensor.variance = sensor.squares / std::max(1.0, sensor.rows - linear - theta / sensors);
  }
  // Each sensor's part of the information was weighted by rows/squares; the variance differs by
  // the degrees of freedom, in common to within 1/rows.
  double ratio = 0.0;
  for (const SensorEstimate& sensor : fit.sensors) {
    ratio += sensor.variance * sensor.rows / sensor.squares / sensors;
  }
  if (theta == 0.0) return;
  const VectorXd scale = unit_scale(at.information);
  const MatrixXd h =
      scale.cwiseInverse().asDiagonal() * at.information * scale.cwiseInverse().asDiagonal();
  const MatrixXd inverse = h.completeOrthogonalDecomposition().pseudoInverse();
  fit.theta_covariance =
      ratio * (scale.cwiseInverse().asDiagonal() * inverse * scale.cwiseInverse().asDiagonal());
}

}  // namespace

double BlockFit::values() const {
  return std::accumulate(sensors.begin(), sensors.end(), 0.0,
                         [](double sum, const auto& sensor) { return sum + sensor.rows; });
}

double BlockFit::bic() const {
  return criterion + parameter_count * std::log(values());
}

BlockFit fit_blocks(std::span<const Stretch> stretches, std::span<const arm::Sensor> sensors,
                    const BlockSet& start, const ColumnChoices& choices,
                    const ProjectionOptions& options) {
  std::vector<SensorModel> models;
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    models.push_back(sensor_model(sensors[j], static_cast<Index>(j), start, stretches, choices));
  }
  const Fitter fitter(stretches, std::move(models));
  BlockFit fit;
  Evaluation at = fitter.evaluate(start);
  constexpr double kStiffest = 1e12;
  double damping = 1e-4;
  HeldBlocks held;
  const double enough = options.step_in_standard_errors * options.step_in_standard_errors;
  fit.converged = start.blocks.empty();
  while (!fit.converged && fit.iterations < options.most_iterations && damping < kStiffest) {
    // The square of the Newton step in standard errors, in their metric.
    const double newton = -marquardt_step(at, held, 1e-14).dot(at.gradient);
    if (newton < enough) {
      fit.converged = true;
      break;
    }
    if (options.go_on && !options.go_on()) {
      fit.cancelled = true;
      break;
    }
    ++fit.iterations;
    const VectorXd step = shortened(marquardt_step(at, held, damping), at.blocks);
    const VectorXd theta = at.blocks.theta();
    if (step.norm() < 4.0 * std::numeric_limits<double>::epsilon() * theta.norm()) {
      fit.converged = true;
      break;
    }
    const BlockSet there = at.blocks.with(theta + step);
    if (held.hold(fitter, there)) continue;
    std::optional<Evaluation> next;
    if (fitter.is_admissible(there)) {
      next = behind_step(fitter, at, step, there, newton < kNearMinimum * kNearMinimum);
    }
    if (next && next->criterion < at.criterion) {
      // A flat valley, along which steps are long and win nothing, is an end too.
      const bool no_gain = at.criterion - next->criterion < kNoGain * enough;
      at = std::move(*next);
      damping = std::max(1e-12, damping / 10.0);
      if (no_gain) {
        fit.converged = true;
        break;
      }
    } else {
      damping *= 10.0;
    }
  }
  // No step lowers the criterion: rounding, where all that Newton's step would change is rounding.
  if (damping >= kStiffest) {
    fit.converged = marquardt_step(at, held, 1e-14).cwiseAbs().maxCoeff() < kRoundingStep;
  }
  fit.models = fitter.models();
  finish(fit, at);
  return fit;
}

std::vector<double> bic_without_each(std::span<const Stretch> stretches, const BlockFit& fit,
                                     std::size_t first) {
  const std::vector<MatrixXd> factors = triangles(stretches, fit.blocks);
  std::vector<double> made;
  for (std::size_t m = first; m < fit.blocks.blocks.size(); ++m) {
    double criterion = 0.0;
    double parameters =
        fit.parameter_count - static_cast<double>(fit.blocks.coefficient_derivatives(m).rows());
    for (std::size_t j = 0; j < fit.models.size(); ++j) {
      SensorModel fewer = fit.models[j];
      parameters -=
          static_cast<double>(std::erase_if(fewer.columns, [m](const SensorColumn& column) {
            return column.is_of_block() && column.block == m;
          }));
      const SensorProblem problem(fewer, static_cast<Index>(j), fit.blocks, stretches, factors);
      criterion += problem.criterion();
    }
    made.push_back(criterion + parameters * std::log(fit.values()));
  }
  return made;
}

}  // namespace flexarm::measured
