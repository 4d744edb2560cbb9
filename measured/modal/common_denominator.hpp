#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::measured {

/// One sensor's lines: y A(z) = sum_i inputs_i B_i(z) + error, at z = exp(i angle). Lines of one
/// equation share their B; A is common to all equations.
struct DenominatorEquation {
  Eigen::ArrayXd angle;                 ///< 0 to pi
  Eigen::ArrayXcd y;                    ///< over the standard deviation of its noise
  std::vector<Eigen::ArrayXcd> inputs;  ///< the torque's line first; over the same deviation
};

/// Poles of one order of the common denominator and the first input's numerators there.
struct DenominatorPoles {
  Eigen::VectorXcd z;
  Eigen::MatrixXcd residues;  ///< B_1(z) of each equation, a row each: proportional to residues
};

/// Least-squares complex frequency-domain estimate [Guillaume1998]:
///
///     min sum over equations and lines of |(A y - sum B_i inputs_i)/A_previous|^2,
///
/// real coefficients, A(z) = 1 + a_1 z + ... + a_n z^n. With its lowest coefficient fixed the poles
/// that noise asks for lie outside the unit circle, the arm's own inside [Cauberghe2005].
/// A_previous of the highest order weights all orders [SanathananKoerner1963].
///
/// Normal equations are Toeplitz: the cost is lines times order for the sums, order^3 an order.
class CommonDenominator {
 public:
  CommonDenominator(std::vector<DenominatorEquation> equations, int highest_order);

  /// Orders 1 to the highest.
  DenominatorPoles poles(int order) const;

 private:
  struct Sums {
    std::size_t signals = 0;
    /// signals x signals: Re sum conj(a) b z^lag for lags 0 to the highest order.
    std::vector<Eigen::VectorXd> moments;
  };

  void form_sums(const std::vector<Eigen::ArrayXd>& weights);
  Eigen::VectorXd denominator(int order) const;
  Eigen::MatrixXd block(const Sums& sums, std::size_t a, std::size_t b, int order) const;
  Eigen::MatrixXd inputs_matrix(const Sums& sums, int order) const;
  Eigen::MatrixXd mixed_matrix(const Sums& sums, int order) const;

  std::vector<DenominatorEquation> equations_;
  std::vector<Sums> sums_;  // one an equation
  int order_;
};

}  // namespace flexarm::measured
