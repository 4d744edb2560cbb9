#pragma once

#include "diagnose/search/law_regression.hpp"
#include "diagnose/search/reported_work.hpp"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

class Problem;

/// A law of hub torque at a grid of its values, to be held against residuals of the hub's signals.
/// The measured motion and the linear response to a torque are the same whatever effects stand
/// beside the law: torques and products of readings are computed once, and residuals are compared
/// by one product with the torques (HubRegression::adjoint).
class HubLawGrid {
 public:
  /// Of the law that is the one effect of `start`: as many values as `evaluations` allows for 1, 2,
  /// 3 parameters or more beside its amplitude and phase. `laws` must outlive the object. `work`,
  /// which may be null, is asked before each value. Throws Cancelled where it is cancelled.
  HubLawGrid(const LawRegression& laws, const Candidate& start,
             const std::array<int, 3>& evaluations, const ReportedWork* work = nullptr);

  /// The law at those values, amplitude and phase solved for, that leave least of the residuals of
  /// the hub's signals: <= `most`, the best first, apart as the places of a scan; each with the sum
  /// of squares that it leaves, which is infinite where the law has no readings.
  std::vector<std::pair<Candidate, double>> best(const Eigen::VectorXd& residuals, int most) const;

 private:
  struct Entry {
    Candidate law;
    LawProducts products;  ///< of readings with readings
    bool has_readings = false;
  };
  /// Of all motions, one after the other, of a law and of its companion_of: one column or two.
  using Torques = Eigen::MatrixXf;

  /// Those of `law` and its companion_of; empty where one has none.
  std::vector<HubTorques> hub_torques(const Candidate& law) const;
  void compute(std::size_t index, bool is_kept);

  const LawRegression& laws_;
  LinearParameters linear_;
  std::vector<Eigen::VectorXd> places_;  ///< of the coordinates that are not solved for
  std::vector<Entry> entries_;
  /// Empty where they would be too many: they are then computed anew. Single precision is enough
  /// for a scan, whose best value is refined.
  std::vector<Torques> torques_;
};

/// The laws of hub torque that an experiment may show, with what does not depend on the effects
/// beside them. Concurrent calls are safe.
class HubLaws {
 public:
  /// The experiment of `problem` must outlive the object.
  explicit HubLaws(const Problem& problem);

  /// All estimation runs are `time` runs with a hub sensor, by output error or torque balance. Else
  /// there is nothing.
  bool are_shown() const { return regression_.has_value(); }
  /// Of residuals of the problem those of the hub's signals.
  Eigen::VectorXd residuals(const Eigen::VectorXd& of_problem) const;
  const LawRegression& regression() const { return *regression_; }

  /// Of the law that is the one effect of `start`; null for an effect that is more than a law, and
  /// for a law that cannot be told by the measured motion (scan_hub_law). `work` as HubLawGrid.
  const HubLawGrid* grid(const Candidate& start, const std::array<int, 3>& evaluations,
                         const ReportedWork* work = nullptr);

 private:
  struct Known {
    Candidate start;
    std::array<int, 3> evaluations;
    std::once_flag once = {};
    std::unique_ptr<const HubLawGrid> grid = {};
  };

  bool is_told(const Candidate& start) const;

  const arm::Arm& arm_;
  std::vector<HubMotion> motions_;
  std::optional<LawRegression> regression_;
  std::mutex mutex_;  // of what follows
  std::vector<std::unique_ptr<Known>> known_;
};

/// Friction and laws with states are not told where the hub rests in more of the samples than this
/// part.
inline constexpr double kMostRest = 0.1;

}  // namespace flexarm::diagnose
