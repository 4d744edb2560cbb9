#pragma once

#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// The predictive likelihood of an experiment's runs, with a noise level and colour of each channel
/// that are estimated from the residuals themselves.
///
/// The residuals of a channel of a `time` run are transformed to lines by the orthonormal DCT-II,
/// which a slow change across the record does not spread over all lines as a Fourier transform
/// does; the last few samples are left out where their number has large prime factors. The lines
/// fall into octaves of frequency; within an octave the noise is white. With S_b the sum of squares
/// of the n_b lines of a band
///
///     -2 ln L = sum_b w_b ln((a_b + S_b)/w_b),
///
/// up to a constant. For `time` runs w_b = n_b, and a_b = n_b f_b with f_b the variance of what the
/// simulation itself errs by: its truncation, and kDiscrepancy of the signal in that band. For
/// responses and modal tables the deviations are stated: w_b = n_b + kStatedWeight and a_b =
/// kStatedWeight, a statement that is worth as many lines. Nuisances add their squares.
class Likelihood {
 public:
  /// The part of a signal, as an amplitude, below which no model is asked to follow it.
  static constexpr double kDiscrepancy = 3e-3;
  static constexpr double kStatedWeight = 4.0;

  /// Takes the `runs` of the problem, which must outlive the object.
  Likelihood(const Problem& problem, std::vector<bool> runs);

  const Problem& problem() const { return problem_; }
  const std::vector<bool>& runs() const { return runs_; }

  /// Returns residuals (Problem::residuals), or changes of them, as lines; the map is linear.
  Eigen::VectorXd lines(const Eigen::VectorXd& residuals) const;

  /// Returns -2 ln L of lines.
  double cost(const Eigen::VectorXd& lines) const { return cost_of_squares(lines.cwiseAbs2()); }
  /// Returns -2 ln L of the squares of lines.
  double cost_of_squares(const Eigen::VectorXd& squares) const;
  /// Returns the derivatives of -2 ln L by the square of each line: the weights of the quadratic
  /// form that has the same derivatives there.
  Eigen::VectorXd weights(const Eigen::VectorXd& lines) const;

  /// Returns the largest part by which `fuller` lowers what `simpler` leaves, a_b + S_b of an
  /// octave of a sensor in all runs. Both are lines.
  double largest_drop(const Eigen::VectorXd& simpler, const Eigen::VectorXd& fuller) const;

 private:
  struct Band {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double added = 0.0;     ///< a_b
    double weight = 0.0;    ///< w_b
    std::size_t group = 0;  ///< of the bands of a sensor in that octave, one a run
  };

  const Problem& problem_;
  std::vector<bool> runs_;
  std::vector<Band> bands_;
  std::size_t groups_ = 0;
};

}  // namespace flexarm::diagnose
