#pragma once

#include <Eigen/Core>

#include <complex>
#include <span>
#include <vector>

namespace flexarm::response {

/// Part of a reading that goes with a sine, from samples over whole cycles: least squares of
///
///     a cos(2 pi k/n) + b sin(2 pi k/n)
///
/// when c + d t + e t^2 is taken off. A free arm's angle may stand anywhere and drift; c, d and e
/// are fitted to the means of the cycles, which are alike for whatever is periodic, so that a drift
/// goes exactly and harmonics do not count as one. Harmonics 2 to n - 2 add nothing; n m +- 1
/// cannot be told from the sine.
class SineCorrelation {
 public:
  /// `samples_per_cycle` 4 or more, `cycles` 3 or more.
  SineCorrelation(int samples_per_cycle, int cycles);

  struct Part {
    /// b + i a, of exp(+i omega t): over the sine's coefficient in the torque, the response.
    std::complex<double> whole;
    std::vector<std::complex<double>> cycles;  ///< the same of each cycle; `whole` is their mean
  };

  /// `samples` from the beginning of a cycle, samples_per_cycle * cycles of them.
  Part of(std::span<const double> samples) const;

  int samples_per_cycle() const { return samples_per_cycle_; }

 private:
  int samples_per_cycle_;
  int cycles_;
  Eigen::MatrixXd sine_;      // a cycle's samples x (cos, sin)
  Eigen::MatrixXd drift_;     // samples x (1, t, t^2)
  Eigen::MatrixXd of_means_;  // 3 x cycles: drift of the means
};

/// Coherence as single cycles show it: |mean|^2/mean |cycle|^2. NaN for cycles of nothing.
double coherence_of(std::span<const std::complex<double>> cycles);

}  // namespace flexarm::response
