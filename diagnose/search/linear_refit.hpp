#pragma once

#include "diagnose/search/candidate.hpp"
#include "diagnose/search/problem.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>
#include <Eigen/QR>

#include <optional>

namespace flexarm::diagnose {

/// What an effect leaves when the parameters of the effects beside it are refitted, to first order:
/// with J the derivatives of the residuals by these parameters, r the residuals with the effect,
///
///     |r|^2 - |J J^+ r|^2.
///
/// Those parameters have taken up part of what the effect does. At their values without it, it may
/// bring the simulation further from the data at each of its values.
class LinearRefit {
 public:
  /// With the derivatives at `base`, which the problem keeps as long as this object. Throws
  /// Cancelled where the work is cancelled.
  LinearRefit(const Problem& problem, const Candidate& base, const ReportedWork& work);

  /// r without J J^+ r in coordinates of their own: as many values fewer as J has columns. Of
  /// `base` with effects behind its own; empty for one that cannot be computed.
  std::optional<Eigen::VectorXd> residuals(const Candidate& candidate) const;
  /// Of these; infinite for one that cannot be computed.
  double sum_of_squares(const Candidate& candidate) const;
  /// The candidate with the parameters of `base` moved to their least squares to first order; as it
  /// is where that leaves more.
  Candidate refitted(const Candidate& candidate) const;

 private:
  const Problem& problem_;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> derivatives_;
  Eigen::Index parameters_ = 0;
};

}  // namespace flexarm::diagnose
