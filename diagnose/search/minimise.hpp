#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

#include <limits>
#include <optional>

namespace flexarm::diagnose {

/// The cost of what a candidate leaves of the data, a function of the squares of its lines: numbers
/// that are linear in the residuals (Problem::residuals). Concurrent calls are safe.
class Objective {
 public:
  virtual ~Objective() = default;
  /// Returns the lines of a candidate; empty where its arm cannot be computed.
  virtual std::optional<Eigen::VectorXd> lines_of(const Candidate& candidate) const = 0;
  virtual double cost(const Eigen::VectorXd& lines) const = 0;
  /// Returns the derivatives of the cost by the square of each line: the weights of the quadratic
  /// form that has the same derivatives there.
  virtual Eigen::VectorXd weights(const Eigen::VectorXd& lines) const = 0;
};

/// A candidate where its cost is least.
struct Minimum {
  Candidate candidate = {};
  Eigen::VectorXd lines = {};
  Eigen::MatrixXd jacobian = {};  ///< lines by Candidate::coordinates
  double cost = std::numeric_limits<double>::infinity();
  int evaluations = 0;  ///< of the lines
  bool converged = false;

  bool is_possible() const { return cost < std::numeric_limits<double>::infinity(); }
};

struct MinimiseOptions {
  int most_steps = 30;
  /// Converged where a step is expected to lower the cost by less than this,
  double tolerance = 0.05;
  /// or by less than this part of it.
  double relative_tolerance = 0.0;
  /// Ends with secants in the place of derivatives, as few of which as possible are computed.
  bool takes_secants = false;
};

/// Returns the minimum nearest to `start`: iteratively reweighted least squares with the damping of
/// [Marquardt1963] and secant updates of the derivatives [Broyden1965], places from 0 to 1. It
/// begins with the derivatives that `base` has of the same effects. Not `is_possible` where the
/// start cannot be computed. Throws Cancelled where the work is cancelled.
Minimum minimise(const Objective& objective, const Candidate& start, const ReportedWork& work,
                 const MinimiseOptions& options = {}, const Minimum* base = nullptr);

}  // namespace flexarm::diagnose
