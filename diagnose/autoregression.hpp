#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace flexarm::diagnose {

/// Stationary Gaussian noise of unit variance, with a sequence of reflection coefficients
/// k_1 ... k_p between -1 and 1 [Burg1975]. The best linear predictor of a number from the m before
/// it, x^_n = -a_1 x_{n-1} - ... - a_m x_{n-m}, follows from that for m - 1 (Levinson),
///
///     a_i <- a_i + k_m a_{m-i},  a_m = k_m,
///
/// and leaves the variance (1 - k_1^2) ... (1 - k_m^2). Without coefficients the noise is white.
class Autoregression {
 public:
  Autoregression() = default;
  /// Of numbers of unit mean square by Burg's method, of the order up to `most_order` with the
  /// least n ln(variance) + 2 p [Akaike1974].
  Autoregression(const Eigen::Ref<const Eigen::VectorXd>& values, int most_order);

  int order() const { return static_cast<int>(predictors_.size()); }
  /// Standard deviation of what the numbers before leave of a number.
  double innovation() const { return deviations_.empty() ? 1.0 : deviations_.back(); }

  /// Power spectrum at a frequency in cycles per sample, variance/|1 + sum a_m z^-m|^2 on the unit
  /// circle; its mean over all frequencies is the unit variance.
  double power(double frequency) const;

  /// Numbers of such noise turned into independent ones of unit variance, each the error of its
  /// prediction from all before it: the exact Gaussian likelihood, up to a factor that depends on
  /// the noise alone.
  void whiten(Eigen::Ref<Eigen::VectorXd> values) const;
  /// The inverse of `whiten`.
  void colour(Eigen::Ref<Eigen::VectorXd> values) const;

  /// The same of numbers of which those at `left_out`, ascending, are not known: they are taken for
  /// the most likely ones beside the others. The squares are then those of the others alone, with
  /// `left_out.size()` degrees of freedom less, as by generalised least squares without them; where
  /// the noise is white, 0 in their places.
  void whiten(Eigen::Ref<Eigen::VectorXd> values, const std::vector<std::size_t>& left_out) const;
  /// Puts the most likely numbers in the places `left_out`.
  void fill(Eigen::Ref<Eigen::VectorXd> values, const std::vector<std::size_t>& left_out) const;

 private:
  double predicted(const Eigen::Ref<const Eigen::VectorXd>& values, Eigen::Index k) const;
  double deviation(Eigen::Index k) const;
  /// What `whiten` makes of a 1 at place k of n numbers, from there on.
  Eigen::VectorXd whitened_impulse(Eigen::Index k, Eigen::Index n) const;

  std::vector<Eigen::VectorXd> predictors_;  // a_1 ... a_m for m = 1 ... p
  std::vector<double> deviations_;           // of what is left after m numbers, m = 1 ... p
};

/// Numbers of which those at `left_out` are not known, with these filled in by the autoregression
/// of all of them, up to order `most_order`: in a few rounds, in which either is known better.
void fill_by_autoregression(Eigen::Ref<Eigen::VectorXd> values,
                            const std::vector<std::size_t>& left_out, int most_order);

}  // namespace flexarm::diagnose
