#pragma once

#include "arm/arm.hpp"
#include "arm/ports.hpp"
#include "diagnose/search/candidate.hpp"
#include "diagnose/symptoms/hub_regression.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

/// The law of hub torque that the candidate's last effect is, if that is scanned: smooth, its
/// states if any moving with the hub's angle alone, or dry friction that changes with the speed.
/// Empty for another law, which it may be at some values of its parameters alone; for an effect
/// that is more than a law; and for values that it cannot have.
std::optional<arm::HubLaw> last_law(const Candidate& candidate, const arm::Arm& arm);

/// What laws of hub torque, the last effects of candidates, make of the hub's signals.
class LawRegression {
 public:
  /// The references must outlive the object.
  LawRegression(const arm::Arm& arm, const std::vector<HubMotion>& motions)
      : arm_(arm), hub_(motions) {}

  const HubRegression& hub() const { return hub_; }

  /// The law's torques at the motions. Empty for a candidate without a last_law, and where that is
  /// not finite at some motion.
  std::optional<HubTorques> torques(const Candidate& candidate) const;
  /// What these make of the signals; empty where they are.
  std::optional<Eigen::VectorXd> readings(const Candidate& candidate) const;

 private:
  const arm::Arm& arm_;
  HubRegression hub_;
};

/// Scalar products of residuals r, the readings a of a law, and those b of its companion
/// (LinearParameters::companion_of), 0 for a law that has none.
struct LawProducts {
  double rr = 0.0;
  double ra = 0.0;
  double rb = 0.0;
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
};

/// The parameters of the last effect that a law's torque is linear in: amplitudes, all of which
/// together it is in proportion to, and beside them the phase of a sine, or the second of two
/// amplitudes.
class LinearParameters {
 public:
  /// Of `start`, each where readings at a few values confirm it.
  LinearParameters(const LawRegression& laws, const Candidate& start);

  /// The coordinates of the last effect that `solved` does not solve for: all but the first
  /// amplitude and the phase or second amplitude.
  std::vector<Eigen::Index> other_coordinates(const Candidate& candidate) const;
  /// The candidate a quarter of its phase on, or with twice the second amplitude; empty where there
  /// is neither to solve for.
  std::optional<Candidate> companion_of(const Candidate& candidate) const;

  /// `candidate` with those amplitudes within their ranges, in their ratio unless the second is
  /// solved for, and that phase which leave least of the residuals; and the sum of squares that it
  /// leaves. `products` are of its readings and those of its companion_of.
  std::pair<Candidate, double> solved(const Candidate& candidate,
                                      const LawProducts& products) const;

 private:
  Candidate times(const Candidate& candidate, double size) const;
  Candidate turned(const Candidate& candidate, double turns) const;
  /// The first amplitude `first` times as large, and the second `second` times.
  Candidate times_each(const Candidate& candidate, double first, double second) const;
  /// Of an amplitude, in what it is above the parameter before it where it is that.
  double largest_size(const Candidate& candidate, std::size_t amplitude) const;
  double largest_size(const Candidate& candidate) const;
  std::pair<Candidate, double> solved_for_both(const Candidate& candidate,
                                               const LawProducts& products) const;

  std::size_t first_ = 0;  // of the last effect's values
  std::vector<std::size_t> amplitudes_;
  std::optional<std::size_t> phase_ = {};
  std::optional<std::size_t> second_ = {};  // one of amplitudes_, with its own size
  double turn_ = 0.0;
};

}  // namespace flexarm::diagnose
