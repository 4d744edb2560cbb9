#pragma once

#include "measured/files/sensor_columns.hpp"
#include "measured/modal/block_signals.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace flexarm::measured {

/// What a fit leaves of one sensor's readings in one stretch, without its weight.
struct StretchResidual {
  std::size_t stretch = 0;
  double squares = 0.0;
  double rows = 0.0;

  double variance() const { return squares / rows; }
};

/// One sensor's linear parameters beta at the fitted theta. p is their number; the first `shared`
/// columns of its model are common to all stretches.
struct SensorEstimate {
  Eigen::VectorXd beta;
  double squares = 0.0;   ///< residual sum of squares, each times its stretch's weight squared
  double rows = 0.0;      ///< values it is a sum over
  double variance = 0.0;  ///< squares/(rows - parameters): of the noise
  Eigen::MatrixXd unit_inverse;  ///< (A^T A)^-1, p x p
  Eigen::MatrixXd to_theta;      ///< d beta/d theta, p x parameters of theta
  std::vector<StretchResidual> stretches = {};

  /// The sensor's part of BlockFit::criterion.
  double criterion() const;
};

/// Sum of squares of a residual, and that of what rounding leaves of the readings.
double squares_above_rounding(const Eigen::VectorXd& residual, const Eigen::VectorXd& readings);

/// The linear least-squares problem of one sensor at one theta, of all its stretches: A, y and
/// dA beta on their triangular factors.
class SensorProblem {
 public:
  /// `index` is the sensor's in the stretches' lists; `triangles` are those of the stretches for
  /// `blocks`, and `model` has columns of these. All must outlive the object.
  SensorProblem(const SensorModel& model, Eigen::Index index, const BlockSet& blocks,
                std::span<const Stretch> stretches, std::span<const Eigen::MatrixXd> triangles);

  /// beta and the residual; adds the sensor's part to the gradient and the Gauss-Newton information
  /// of half the criterion in theta.
  SensorEstimate solve(Eigen::VectorXd& gradient, Eigen::MatrixXd& information) const;
  /// SensorEstimate::criterion, without what else solve() forms.
  double criterion() const;

 private:
  class Projection;
  struct Piece {
    std::size_t stretch;
    Eigen::Index first_row;
    const Eigen::MatrixXd* triangle;
    SignalLayout layout;
    Eigen::Index reading;
    double weight;
    double rows;
  };

  /// Of a sensor that no block moves yet.
  SensorEstimate nothing_linear() const;
  SensorEstimate estimate(const Projection& projection, Eigen::VectorXd& residual) const;
  static bool has(const Piece& piece, const SensorColumn& column);
  /// dA/d theta_t beta, a column each.
  Eigen::MatrixXd derivative(const Eigen::VectorXd& beta) const;

  const SensorModel& model_;
  const BlockSet& blocks_;
  std::vector<Piece> pieces_;
  Eigen::MatrixXd a_;
  Eigen::VectorXd y_;
  double values_ = 0.0;
};

}  // namespace flexarm::measured
