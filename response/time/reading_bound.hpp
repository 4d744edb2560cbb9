#pragma once

#include "response/time/modal_dynamics.hpp"
#include "response/time/step_inputs.hpp"

#include <Eigen/Core>

#include <memory>

namespace flexarm::response {

/// The second derivative of a reading y = c X + e u + d f while u is linear and f a parabola in
/// time, by the eigenvectors of A:
///
///     y'' = d f'' + sum over k of gain_k a_k,   a_k' = lambda_k a_k + g_k,
///
/// a(0) linear in (X, u, u', f, f') and g in f''. Of a pair of conjugates k is the upper one.
struct ReadingModes {
  /// Of `reading` with the hub held or turning; c may not contain W.
  ReadingModes(const ModalDynamics& arm, bool is_held, const Reading& reading);

  Reading reading;
  Eigen::VectorXcd rates;          ///< lambda, K [1/s]
  Eigen::VectorXd gains;           ///< |gain_k|, of both of a pair
  Eigen::MatrixXd second;          ///< a(0): 2 K rows, real parts, then imaginary ones
  Eigen::MatrixXd third_by_force;  ///< g: 2 K x m, likewise
};

/// Bounds of a reading over steps of one length h, from its values at both ends. Where y_k = A_k
/// e^(lambda_k t) + a parabola of curvature -g_k/lambda_k, it departs from the chord between its
/// ends by at most
///
///     min(h^2/8, 2/|lambda_k|^2) (|a_k| + kappa |g_k|) + h^2/8 kappa |g_k|,
///
/// kappa = min(h, 1/|lambda_k|), times e^(lambda_k h) where y_k grows: neither a fast motion that
/// has decayed nor a small one that rings makes the bound large, however long the step.
class ReadingBound {
 public:
  ReadingBound() = default;
  ReadingBound(std::shared_ptr<const ReadingModes> modes, double step_s, bool forces_vary);

  struct Range {
    double least;
    double largest;
  };
  /// Vectors that a call computes in, so that it allocates no memory; different bounds may use one
  /// in turn.
  struct Workspace {
    Eigen::VectorXd known;  ///< (X; u; u'; f; f') at the beginning, N + 2 + 2 m
    Eigen::VectorXd bend;   ///< f'', m
    Eigen::VectorXd parts;  ///< a or g, 2 K as in ReadingModes
  };
  /// Of steps one after the other, u constant in each and f in all: what the reading departs from
  /// the chords between its values at their ends. In the first at most `in_first`; in a later one
  /// `per_torque` more for each unit that u has changed by since then, up or down; all times
  /// `growth`, 1 or more, from step to step.
  struct Departure {
    double in_first;
    double per_torque;
    double growth;
  };
  /// Of steps from X = x0 with this u and f. NaN where A has no basis of eigenvectors.
  Departure departure(const Eigen::VectorXd& x0, double u, const Eigen::VectorXd& f,
                      Workspace& workspace) const;
  /// Of the step from X = x0 to x1. NaN where A has no basis of eigenvectors.
  Range operator()(const Eigen::VectorXd& x0, const Eigen::VectorXd& x1, const StepInputs& inputs,
                   Workspace& workspace) const;

 private:
  /// Of y_k without g_k, from X = x0 with these u, u', f and f'.
  template <class Slope>
  double by_modes(const Eigen::VectorXd& x0, double u, double u_rate, const Eigen::VectorXd& f,
                  const Slope& f_rate, Workspace& workspace) const;

  std::shared_ptr<const ReadingModes> modes_;
  double step_s_ = 0.0;
  bool forces_vary_ = false;
  Eigen::ArrayXd by_second_;  ///< factor of |a_k|
  Eigen::ArrayXd by_third_;   ///< factor of |g_k|
  double per_torque_ = 0.0;   ///< of a unit of u
  double growth_ = 1.0;       ///< of the fastest y_k that grows
};

}  // namespace flexarm::response
