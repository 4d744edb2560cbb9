#pragma once

#include <Eigen/Core>

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

 private:
  double predicted(const Eigen::Ref<const Eigen::VectorXd>& values, Eigen::Index k) const;
  double deviation(Eigen::Index k) const;

  std::vector<Eigen::VectorXd> predictors_;  // a_1 ... a_m for m = 1 ... p
  std::vector<double> deviations_;           // of what is left after m numbers, m = 1 ... p
};

}  // namespace flexarm::diagnose
