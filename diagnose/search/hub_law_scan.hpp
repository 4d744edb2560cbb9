#pragma once

#include "diagnose/search/scan.hpp"

#include <array>
#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// What a scan of a law of hub torque found.
struct HubLawScan {
  std::vector<Candidate> starts;  ///< for fits, one or more, the best first
  /// Part of the excess residual of the hub's signals (beyond_noise) that the best
  /// of `starts` explains, 0 to 1.
  double share = 0.0;
};

struct HubLawScanOptions {
  /// Values tried of a law with 1, 2, 3 parameters or more beside its amplitude and phase.
  std::array<int, 3> evaluations = {};
  int starts = 1;
  /// Residuals of `start` without the law, where they are known.
  const Eigen::VectorXd* base_residuals = nullptr;
  const ReportedWork* work = nullptr;  ///< that the scan is part of; asked before each evaluation
};

/// Scans a law of hub torque, the last effect of `start`, by a regression on the measured motion of
/// the estimation runs: the law's torque at that motion, the linear response to it of the arm as
/// filed, and the sum of squares that this leaves of the hub's signals
/// (symptoms/hub_regression.hpp); by torque balance, of the missing torque, which has passed the
/// filter of the arm as filed (Predictor::balanced_torque). Where a law is in proportion to its
/// parameters of effects::Spacing::from_zero, its size is solved for at each value of the others,
/// and so is the phase of a sine, or the second of two such parameters. The values are those of a
/// grid, which is computed once for all sets of effects beside the law (hub_laws.hpp). The best
/// value is refined by least squares, from there and from beside the law's neutral value: a free
/// hub answers a constant part of a law with a drift, so that the minimum may be narrower than the
/// distance of the values of the grid. The torque that the law may depend on is the commanded one.
///
/// Empty for an effect that is more than such a law, for a constant torque, and for dry friction
/// that is the same at every speed. Empty unless all estimation runs are `time` runs with a hub
/// sensor, by output error or torque balance. Empty for friction and for laws with states where the
/// hub rests in more than `kMostRest` of the samples: the torque at rest is not a function of the
/// velocity, and what moves the states is below the noise. Empty where `start` without the law
/// cannot be simulated. Throws Cancelled where the work is cancelled.
std::optional<HubLawScan> scan_hub_law(const Problem& problem, const Candidate& start,
                                       const HubLawScanOptions& options);

}  // namespace flexarm::diagnose
