#pragma once

#include "exact_tf/bivector.hpp"
#include "exact_tf/carried_mass.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::exact_tf {

/// A bivector and a functional beside the logarithms of the factors left out of them.
template <class T>
struct ScaledPlane {
  Bivector<T> plane;
  RealOf<T> log_scale = 0;
};
template <class T>
struct ScaledFunctional {
  BeamState<T> functional{};
  RealOf<T> log_scale = 0;
};

/// The beam at one frequency, cut into segments from the tip to the root, a crack or a mass on the
/// beam being one without length. What has passed a suspended mass is multiplied by its D (see
/// CarriedMass): planes, functionals, and so every value of the arm's motion by the product of all.
///
/// What the tip's conditions leave is a plane of states, carried to the root as a bivector; the
/// root's condition y(0) = a theta is a functional, carried to the tip as a row g(x) that gives at
/// x the value which the functional has at the root. Either grows as fast as anything that the
/// equations hold, so that rounding errors stay relative to it, and the arm's motion at x is the
/// state of the plane at which g vanishes, whatever lies between.
///
/// With K = `wave_number` and D = min(1, 1 + phi g P), a segment has K h <= 3 sqrt(D) and
/// |phi g| h <= D/4. So
///
/// - terms of the power series and products in a compound exceed their sums by e^3 at most;
/// - undamped, no segment clamped at both ends resonates: from int psi'^2 >= (pi/h)^2 int psi^2,
///   the same for y, and y' = (y' - psi) + psi follows int y'^2 <= (phi + h^2/pi^2) 2 V, hence
///   2 T <= [s^2 (h/pi)^2 (phi + h^2/pi^2) + rho I s^2 (h/pi)^2] 2 V, which the bound on K h keeps
///   below the part 1 - |g P| (phi + h^2/pi^2) that gravity of either sign leaves of 2 V.
template <class T>
class TransferChain {
 public:
  using R = RealOf<T>;

  /// Throws std::domain_error where K is not finite or a million segments would not do: within
  /// rounding of s = -1/kv.
  /// Without planes `to_left` and `root_plane` must not be called.
  TransferChain(const ArmInBeamUnits<R>& arm, const BeamAtFrequency<T>& beam,
                bool with_planes = true);
  /// Cut as for the frequency of `cut_for`, which must be no lower.
  TransferChain(const ArmInBeamUnits<R>& arm, const BeamAtFrequency<T>& beam,
                const BeamAtFrequency<T>& cut_for);

  struct Link {
    Segment<R> segment;
    bool is_crack = false;
    std::optional<std::size_t> shared = std::nullopt;  ///< a transfer that other links share
    std::optional<std::size_t> mass = std::nullopt;    ///< in `masses`

    bool is_segment() const { return !is_crack && !mass; }
  };
  /// From the tip to the root.
  const std::vector<Link>& links() const { return links_; }
  /// Computed anew where the link shares it with no other. Not of a mass.
  SegmentTransfer<T> transfer(const Link& link) const;
  /// Of the arm's masses, by position.
  const std::vector<CarriedMass<T>>& masses() const { return masses_; }
  /// The sum of K over the beam: states grow by its exponential at most.
  R growth() const { return growth_; }

  /// Q(l) and M(l) over y(l) = 1, psi(l) = 0 and y(l) = 0, psi(l) = 1.
  std::array<BeamState<T>, 2> tip_states() const;
  ScaledPlane<T> tip_plane() const;
  /// y - a (psi - M/kr).
  ScaledFunctional<T> root_functional() const;

  /// From the right end of the link to its left end.
  void to_left(const Link& link, ScaledPlane<T>& plane) const;
  /// From the left end of the link to its right end.
  void to_right(const Link& link, ScaledFunctional<T>& functional) const;

  ScaledPlane<T> root_plane() const;
  ScaledFunctional<T> tip_functional() const;

  const ArmInBeamUnits<R>& arm() const { return arm_; }
  const BeamAtFrequency<T>& beam() const { return beam_; }

 private:
  struct Transfer {
    SegmentTransfer<T> columns;
    Compound<T> compound;
  };

  void cut(const BeamAtFrequency<T>& cut_for);
  void add_piece(const BeamAtFrequency<T>& cut_for, R left, R right);
  std::size_t share(const SegmentTransfer<T>& columns);

  const ArmInBeamUnits<R>& arm_;
  BeamAtFrequency<T> beam_;
  bool with_planes_;
  std::vector<Link> links_;
  std::vector<Transfer> transfers_;
  std::vector<CarriedMass<T>> masses_;
  R growth_ = 0;
};

}  // namespace flexarm::exact_tf
