#pragma once

#include "assumed_modes/real.hpp"

#include <vector>

namespace flexarm::assumed_modes {

/// Integrals over [0, 1] of functions psi_i that vanish at the root (xi = x/l).
struct Integrals {
  Matrix mass;    ///< int psi_i psi_j
  Vector moment;  ///< int xi psi_i
  Vector mean;    ///< int psi_i
};

/// A solution of psi'''' = lambda^4 psi on [0, 1] as
///
///     cosine cos(lambda xi) + sine sin(lambda xi) + from_root exp(-lambda xi)
///         + from_tip exp(-lambda (1 - xi)),
///
/// whose exponentials decay from either end, so that nothing overflows or cancels at high lambda.
struct BeamShape {
  Real lambda = 0;
  Real cosine = 0;
  Real sine = 0;
  Real from_root = 0;
  Real from_tip = 0;

  /// The derivative of the given order, 0 or more, at xi.
  Real value(Real xi, int derivative) const;
};

/// The natural modes of a classical beam, scaled to unit strain energy int psi''^2 = 1. Modes of
/// one problem are orthogonal in strain energy and in kinetic energy, so every integral is closed.
class BeamShapes {
 public:
  /// Cantilever that carries a tip mass of eta m l and a tip inertia of iota m l^3 (0, 0: none).
  static BeamShapes clamped(int count, Real payload_mass_ratio, Real payload_inertia_ratio);
  /// Pinned-free beam, its rigid rotation left out.
  static BeamShapes pinned_free(int count);

  Integrals integrals() const;
  /// The derivative of the given order of each shape at xi.
  Vector values(Real xi, int derivative) const;
  const std::vector<BeamShape>& shapes() const { return shapes_; }

 private:
  BeamShapes(std::vector<BeamShape> shapes, Real payload_mass_ratio, Real payload_inertia_ratio);

  std::vector<BeamShape> shapes_;
  Real payload_mass_ratio_;
  Real payload_inertia_ratio_;
};

}  // namespace flexarm::assumed_modes
