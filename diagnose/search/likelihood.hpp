#pragma once

#include "diagnose/search/minimise.hpp"
#include "diagnose/search/problem.hpp"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// The effective sample size of an octave of a `time` run: that of what a model gets wrong, or that
/// of noise (Likelihood).
enum class SampleSize { of_model_error, of_noise };

/// The predictive likelihood of an experiment's runs, with a noise level and colour of each channel
/// that are estimated from the residuals themselves.
///
/// The residuals of a channel of a `time` run are transformed to lines by the orthonormal DCT-II,
/// which a slow change across the record does not spread over all lines as a Fourier transform
/// does; the last few samples are left out where their number has large prime factors. The lines
/// fall into octaves of frequency; within an octave the noise is white. With S_b the sum of squares
/// of the n_b lines of a band
///
///     -2 ln L = sum_b m_b ln((a_b + S_b)/n_b)
///
/// up to a constant. a_b are the squares of what the simulation itself errs by: its truncation,
/// which is the change that further modes make of the arm as filed, what the error of a measured
/// motion that drives it adds, and, but for a Kalman filter, Policy::discrepancy of the signal in
/// that band. m_b is the effective sample size of a band (SampleSize): what a model gets wrong is a
/// smooth function of frequency times the signal, so that its lines are no more independent of each
/// other the more of them a record has, and m_b = min(n_b, Policy::sample_size). Lines of noise are
/// independent, m_b = n_b: between sets that both leave noise these decide.
///
/// Lines of responses and entries of modal tables have stated deviations. An octave of a response,
/// or a channel of a table, is one band: noise, and an error of the model that has m degrees of
/// freedom,
///
///     -2 ln L = S                            S <= n
///               n + m ln(1 + (S - n)/m)      S >  n
///
/// Nuisances add their squares.
class Likelihood final : public Objective {
 public:
  /// Takes the `runs` of the problem, which must outlive the object.
  Likelihood(const Problem& problem, std::vector<bool> runs);
  /// Takes a problem with fewer flexible modes than the `flexible_modes` that are needed: the
  /// truncation is judged by those.
  Likelihood(const Problem& problem, std::vector<bool> runs, int flexible_modes);

  const Problem& problem() const { return problem_; }
  const std::vector<bool>& runs() const { return runs_; }

  /// Returns residuals (Problem::residuals), or changes of them, as lines; the map is linear.
  Eigen::VectorXd lines(const Eigen::VectorXd& residuals) const;

  std::optional<Eigen::VectorXd> lines_of(const Candidate& candidate) const override;

  /// Returns the same with this sample size of its octaves, which is of_model_error unless given.
  Likelihood with(SampleSize sample_size) const;

  /// Returns -2 ln L of a candidate; infinite where its arm cannot be computed.
  double cost_of(const Candidate& candidate) const;
  /// Returns -2 ln L of lines.
  double cost(const Eigen::VectorXd& lines) const override {
    return cost_of_squares(lines.cwiseAbs2());
  }
  /// Returns -2 ln L of the squares of lines.
  double cost_of_squares(const Eigen::VectorXd& squares) const;
  /// Returns whether lines may be noise and the simulation's own error: neither a band, nor
  /// the nuisances, nor all of them together exceed what is expected by more than chance does in
  /// one case of a few hundred.
  bool is_noise(const Eigen::VectorXd& lines) const;
  /// Returns the frequencies [Hz] of the `most` lines of `time` runs with the largest shares of the
  /// squares of their octaves, in order, no two nearer than the longest run resolves.
  std::vector<double> peaks_Hz(const Eigen::VectorXd& lines, std::size_t most) const;
  Eigen::VectorXd weights(const Eigen::VectorXd& lines) const override;

 private:
  struct Band {
    Eigen::Index first = 0;
    Eigen::Index count = 0;
    double added = 0.0;        ///< a_b
    double line_Hz = 0.0;      ///< between lines of a `time` run
    double lowest_Hz = 0.0;    ///< of the first of these
    bool is_stated = false;    ///< its deviations are
    double sample_size = 0.0;  ///< m_b

    double cost(double sum) const;
    /// The derivative of the cost by the sum of squares.
    double slope(double sum) const;
  };

  void take(SampleSize sample_size);

  const Policy& policy() const { return problem_.policy(); }

  const Problem& problem_;
  std::vector<bool> runs_;
  std::vector<Band> bands_;
};

}  // namespace flexarm::diagnose
