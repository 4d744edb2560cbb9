#pragma once

#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// The predictive likelihood of an experiment's runs. A channel's residuals, in standard deviations
/// of its noise, are that noise and the error of the model, whose size is estimated from the
/// residuals themselves.
///
/// The residuals of a channel of a `time` run are transformed to lines by the orthonormal DCT-II,
/// which a slow change across the record does not spread over all lines as a Fourier transform
/// does; the last few samples are left out where their number has large prime factors. The lines
/// fall into octaves of frequency. A channel of responses or of a modal table is one band. What a
/// model gets wrong is a smooth function of frequency times the signal, so that it has few degrees
/// of freedom in a band, m = min(n, kSampleSize), however many lines n the band has: these have the
/// variance of the model's error, the others that of noise. With S the sum of squares of the lines
/// and E = S - n what is beyond noise,
///
///     -2 ln L = m E/(m + a)                E <= 0
///               m ln(1 + E/(m + a))        E >  0
///
/// up to a constant. Where noise is left this is chi-squared; far from noise it counts by what
/// ratio a model lowers the squares of m lines. a are the squares of what the simulation itself
/// errs by: its truncation, which is the change that further modes make of the arm as filed, and
/// kDiscrepancy of the signal in that band; 0 of responses and modal tables. Nuisances add their
/// squares.
class Likelihood {
 public:
  /// The part of a signal, as an amplitude, below which no model is asked to follow it.
  static constexpr double kDiscrepancy = 3e-3;
  /// The largest effective sample size of an octave of a channel.
  static constexpr double kSampleSize = 8.0;

  /// Takes the `runs` of the problem, which must outlive the object.
  Likelihood(const Problem& problem, std::vector<bool> runs);

  const Problem& problem() const { return problem_; }
  const std::vector<bool>& runs() const { return runs_; }

  /// Returns residuals (Problem::residuals), or changes of them, as lines; the map is linear.
  Eigen::VectorXd lines(const Eigen::VectorXd& residuals) const;

  /// Returns the lines of a candidate's residuals; empty where its arm cannot be computed.
  std::optional<Eigen::VectorXd> lines_of(const Candidate& candidate) const;

  /// Returns -2 ln L of lines.
  double cost(const Eigen::VectorXd& lines) const { return cost_of_squares(lines.cwiseAbs2()); }
  /// Returns -2 ln L of the squares of lines.
  double cost_of_squares(const Eigen::VectorXd& squares) const;
  /// Returns whether lines may be noise and the simulation's own error: neither a band nor all of
  /// them together exceed what is expected by more than chance does in one case of a few hundred.
  bool is_noise(const Eigen::VectorXd& lines) const;
  /// Returns the derivatives of -2 ln L by the square of each line: the weights of the quadratic
  /// form that has the same derivatives there.
  Eigen::VectorXd weights(const Eigen::VectorXd& lines) const;

 private:
  struct Band {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double added = 0.0;  ///< a

    double sample_size() const;
    double cost(double sum) const;
    /// The derivative of the cost by the sum of squares.
    double slope(double sum) const;
  };

  const Problem& problem_;
  std::vector<bool> runs_;
  std::vector<Band> bands_;
};

}  // namespace flexarm::diagnose
