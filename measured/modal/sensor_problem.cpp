#include "measured/modal/sensor_problem.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Columns that depend on others to this are left out of a sensor's model.
constexpr double kDependent = 1e-11;
/// Residuals below this times the reading's size are rounding, not noise.
constexpr double kResidualRounding = 1e-13;

}  // namespace

double SensorEstimate::criterion() const {
  return rows * std::log(squares / rows);
}

double squares_above_rounding(const VectorXd& residual, const VectorXd& readings) {
  return residual.squaredNorm() + kResidualRounding * kResidualRounding * readings.squaredNorm();
}

/// On the range of A, whose columns are brought to length 1.
class SensorProblem::Projection {
 public:
  explicit Projection(const MatrixXd& a)
      : scale_(
            a.colwise().norm().transpose().unaryExpr([](double n) { return n > 0.0 ? n : 1.0; })),
        scaled_(a * scale_.cwiseInverse().asDiagonal()) {
    qr_.setThreshold(kDependent);
    qr_.compute(scaled_);
  }

  const VectorXd& scale() const { return scale_; }
  const MatrixXd& scaled() const { return scaled_; }

  /// scaled()^+ v.
  MatrixXd solve(const MatrixXd& v) const {
    const Index rank = qr_.rank();
    MatrixXd x = MatrixXd::Zero(scaled_.cols(), v.cols());
    if (rank == 0 || v.cols() == 0) return x;
    const MatrixXd q = qr_.householderQ().adjoint() * v;
    x.topRows(rank) = divided_by_triangle(q.topRows(rank));
    return qr_.colsPermutation() * x;
  }

  /// (A^T A)^-1.
  MatrixXd unit_inverse() const {
    const Index rank = qr_.rank();
    MatrixXd root = MatrixXd::Zero(scaled_.cols(), rank);
    root.topRows(rank) = divided_by_triangle(MatrixXd::Identity(rank, rank));
    const MatrixXd spread = scale_.cwiseInverse().asDiagonal() * (qr_.colsPermutation() * root);
    return spread * spread.transpose();
  }

 private:
  /// R^-1 v, of the part of R that has full rank.
  MatrixXd divided_by_triangle(const Eigen::Ref<const MatrixXd>& v) const {
    return qr_.matrixQR()
        .topLeftCorner(qr_.rank(), qr_.rank())
        .triangularView<Eigen::Upper>()
        .solve(v);
  }

  VectorXd scale_;
  MatrixXd scaled_;
  Eigen::ColPivHouseholderQR<MatrixXd> qr_;
};

SensorProblem::SensorProblem(const SensorModel& model, Index index, const BlockSet& blocks,
                             std::span<const Stretch> stretches,
                             std::span<const MatrixXd> triangles)
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
  // What is known beforehand is a row more: 0 = tightness coefficient, with the noise's deviation.
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

SensorEstimate SensorProblem::estimate(const Projection& projection, VectorXd& residual) const {
  SensorEstimate made;
  VectorXd unit_beta = projection.solve(y_);
  residual = y_ - projection.scaled() * unit_beta;
  const VectorXd correction = projection.solve(residual);
  unit_beta += correction;
  residual -= projection.scaled() * correction;
  made.beta = unit_beta.cwiseQuotient(projection.scale());
  made.rows = values_;
  made.squares = squares_above_rounding(residual, y_);
  for (const Piece& piece : pieces_) {
    const double squares =
        squares_above_rounding(residual.segment(piece.first_row, piece.triangle->rows()), y_);
    made.stretches.push_back({piece.stretch, squares / (piece.weight * piece.weight), piece.rows});
  }
  return made;
}

SensorEstimate SensorProblem::solve(VectorXd& gradient, MatrixXd& information) const {
  if (a_.cols() == 0) return nothing_linear();
  const Projection projection(a_);
  VectorXd residual;
  SensorEstimate made = estimate(projection, residual);
  const MatrixXd d = derivative(made.beta);
  const MatrixXd unit_change = projection.solve(d);
  const MatrixXd jacobian = -(d - projection.scaled() * unit_change);
  made.to_theta = -(projection.scale().cwiseInverse().asDiagonal() * unit_change);
  made.unit_inverse = projection.unit_inverse();
  const double weight = values_ / made.squares;
  gradient += weight * (jacobian.transpose() * residual);
  information += weight * (jacobian.transpose() * jacobian);
  return made;
}

double SensorProblem::criterion() const {
  if (a_.cols() == 0) return nothing_linear().criterion();
  VectorXd residual;
  return estimate(Projection(a_), residual).criterion();
}

SensorEstimate SensorProblem::nothing_linear() const {
  return {.beta = VectorXd(0),
          .squares = y_.squaredNorm(),
          .rows = values_,
          .unit_inverse = MatrixXd(0, 0),
          .to_theta = MatrixXd(0, blocks_.parameters())};
}

bool SensorProblem::has(const Piece& piece, const SensorColumn& column) {
  if (column.kind == SensorColumn::Kind::free && !piece.layout.free) return false;
  return column.is_common() || column.stretch == piece.stretch;
}

MatrixXd SensorProblem::derivative(const VectorXd& beta) const {
  MatrixXd d = MatrixXd::Zero(a_.rows(), blocks_.parameters());
  for (const Piece& piece : pieces_) {
    for (std::size_t i = 0; i < model_.columns.size(); ++i) {
      const SensorColumn& column = model_.columns[i];
      if (!has(piece, column)) continue;
      const MatrixXd of_column = column_derivatives(column, *piece.triangle, piece.layout, blocks_);
      if (of_column.size() == 0) continue;
      d.block(piece.first_row, blocks_.first_parameter(column.block), of_column.rows(),
              of_column.cols()) += piece.weight * beta(static_cast<Index>(i)) * of_column;
    }
  }
  return d;
}

}  // namespace flexarm::measured
