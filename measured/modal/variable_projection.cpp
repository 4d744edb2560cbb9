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

/// Columns that depend on others to this are left out of a sensor's model.
constexpr double kDependent = 1e-11;
/// Residuals below this times the reading's size are rounding, not noise.
constexpr double kResidualRounding = 1e-13;
/// A Newton step in log(omega) and damping ratios that rounding of the criterion may hide.
constexpr double kRoundingStep = 1e-7;
/// A fall of the criterion that is none, in units of the square of the step asked for.
constexpr double kNoGain = 100.0;
/// The largest step of log(omega) and of a damping ratio.
constexpr double kLargestStep = 0.3;
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

/// A, dA beta and y of one sensor, of all its stretches.
class SensorProblem {
 public:
  SensorProblem(const SensorModel& model, Index index, const BlockSet& blocks,
                std::span<const Stretch> stretches, std::span<const MatrixXd> triangles)
      : model_(model), blocks_(blocks) {
    Index rows = 0;
    for (std::size_t r = 0; r < stretches.size(); ++r) {
      const auto at = std::ranges::find(stretches[r].sensors, index);
      if (at == stretches[r].sensors.end()) continue;
      const Index reading = at - stretches[r].sensors.begin();
      pieces_.push_back({r, rows, &triangles[r], stretches[r].layout(blocks), reading,
                         stretches[r].weight(reading), static_cast<double>(stretches[r].rows)});
      rows += triangles[r].rows();
      values_ += static_cast<double>(stretches[r].rows);
    }
    const Index known =
        std::ranges::count_if(model.columns, [](const auto& c) { return c.tightness > 0.0; });
    a_ = MatrixXd::Zero(rows + known, static_cast<Index>(model.columns.size()));
    y_ = VectorXd::Zero(rows + known);
    // What is known beforehand is a row more: 0 = tightness coefficient, with the noise's
    // deviation.
    for (std::size_t i = 0; i < model.columns.size(); ++i) {
      if (model.columns[i].tightness > 0.0) {
        a_(rows++, static_cast<Index>(i)) = model.columns[i].tightness;
      }
    }
    for (const Piece& piece : pieces_) {
      const MatrixXd& triangle = *piece.triangle;
      y_.segment(piece.first_row, triangle.rows()) =
          piece.weight * triangle.col(piece.layout.first_reading() + piece.reading);
      for (std::size_t i = 0; i < model.columns.size(); ++i) {
        if (!has(piece, model.columns[i])) continue;
        a_.block(piece.first_row, static_cast<Index>(i), triangle.rows(), 1) =
            piece.weight * column_of(model.columns[i], triangle, piece.layout, blocks);
      }
    }
  }

  /// beta and the residual; adds the sensor's part to gradient and information.
  SensorEstimate solve(VectorXd& gradient, MatrixXd& information) const {
    if (a_.cols() == 0) return nothing_linear();
    const VectorXd scale =
        a_.colwise().norm().transpose().unaryExpr([](double n) { return n > 0.0 ? n : 1.0; });
    const MatrixXd scaled = a_ * scale.cwiseInverse().asDiagonal();
    Eigen::ColPivHouseholderQR<MatrixXd> qr;
    qr.setThreshold(kDependent);
    qr.compute(scaled);
    const Index rank = qr.rank();
    const auto in_range = [&](const MatrixXd& v) -> MatrixXd {  // scaled A^+ v
      MatrixXd q = qr.householderQ().adjoint() * v;
      MatrixXd x = MatrixXd::Zero(a_.cols(), v.cols());
      if (rank == 0 || v.cols() == 0) return x;
      x.topRows(rank) = qr.matrixQR()
                            .topLeftCorner(rank, rank)
                            .triangularView<Eigen::Upper>()
                            .solve(q.topRows(rank));
      return qr.colsPermutation() * x;
    };
    SensorEstimate estimate;
    VectorXd unit_beta = in_range(y_);
    VectorXd residual = y_ - scaled * unit_beta;
    const VectorXd correction = in_range(residual);
    unit_beta += correction;
    residual -= scaled * correction;
    estimate.beta = unit_beta.cwiseQuotient(scale);
    estimate.rows = values_;
    estimate.squares = squares_above_rounding(residual, y_);
    for (const Piece& piece : pieces_) {
      const double squares =
          squares_above_rounding(residual.segment(piece.first_row, piece.triangle->rows()), y_);
      estimate.stretches.push_back(
          {piece.stretch, squares / (piece.weight * piece.weight), piece.rows});
    }

    const MatrixXd d = derivative(estimate.beta);
    const MatrixXd unit_change = in_range(d);
    const MatrixXd jacobian = -(d - scaled * unit_change);
    estimate.to_theta = -(scale.cwiseInverse().asDiagonal() * unit_change);
    const double weight = values_ / estimate.squares;
    gradient += weight * (jacobian.transpose() * residual);
    information += weight * (jacobian.transpose() * jacobian);

    MatrixXd root = MatrixXd::Zero(a_.cols(), rank);
    root.topRows(rank) = qr.matrixQR()
                             .topLeftCorner(rank, rank)
                             .triangularView<Eigen::Upper>()
                             .solve(MatrixXd::Identity(rank, rank));
    const MatrixXd spread = scale.cwiseInverse().asDiagonal() * (qr.colsPermutation() * root);
    estimate.unit_inverse = spread * spread.transpose();
    return estimate;
  }

 private:
  struct Piece {
    std::size_t stretch;
    Index first_row;
    const MatrixXd* triangle;
    SignalLayout layout;
    Index reading;
    double weight;
    double rows;
  };

  /// Of a sensor that no block moves yet.
  SensorEstimate nothing_linear() const {
    return {.beta = VectorXd(0),
            .squares = y_.squaredNorm(),
            .rows = values_,
            .unit_inverse = MatrixXd(0, 0),
            .to_theta = MatrixXd(0, blocks_.parameters())};
  }

  static bool has(const Piece& piece, const SensorColumn& column) {
    if (column.kind == SensorColumn::Kind::free && !piece.layout.free) return false;
    return column.is_common() || column.stretch == piece.stretch;
  }

  /// dA/d theta_t beta, a column each.
  MatrixXd derivative(const VectorXd& beta) const {
    MatrixXd d = MatrixXd::Zero(a_.rows(), blocks_.parameters());
    for (const Piece& piece : pieces_) {
      for (std::size_t i = 0; i < model_.columns.size(); ++i) {
        const SensorColumn& column = model_.columns[i];
        if (!has(piece, column)) continue;
        const MatrixXd of_column =
            column_derivatives(column, *piece.triangle, piece.layout, blocks_);
        if (of_column.size() == 0) continue;
        d.block(piece.first_row, blocks_.first_parameter(column.block), of_column.rows(),
                of_column.cols()) += piece.weight * beta(static_cast<Index>(i)) * of_column;
      }
    }
    return d;
  }

  const SensorModel& model_;
  const BlockSet& blocks_;
  std::vector<Piece> pieces_;
  MatrixXd a_;
  VectorXd y_;
  double values_ = 0.0;
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
    std::vector<MatrixXd> triangles;
    for (const Stretch& stretch : stretches_) triangles.push_back(triangle(stretch, blocks));
    Evaluation at{.blocks = blocks,
                  .sensors = {},
                  .gradient = VectorXd::Zero(blocks.parameters()),
                  .information = MatrixXd::Zero(blocks.parameters(), blocks.parameters())};
    for (std::size_t j = 0; j < models_.size(); ++j) {
      const SensorProblem problem(models_[j], static_cast<Index>(j), blocks, stretches_, triangles);
      at.sensors.push_back(problem.solve(at.gradient, at.information));
      const SensorEstimate& sensor = at.sensors.back();
      at.criterion += sensor.rows * std::log(sensor.squares / sensor.rows);
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

double squares_above_rounding(const VectorXd& residual, const VectorXd& readings) {
  return residual.squaredNorm() + kResidualRounding * kResidualRounding * readings.squaredNorm();
}

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
    const VectorXd newton = marquardt_step(at, held, 1e-14);
    if (-newton.dot(at.gradient) < enough) {
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
    if (fitter.is_admissible(there)) next = fitter.evaluate(there);
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

}  // namespace flexarm::measured
