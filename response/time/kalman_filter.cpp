#include "response/time/kalman_filter.hpp"

#include "arm/input_error.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace flexarm::response {

namespace {

Eigen::MatrixXd symmetric(const Eigen::MatrixXd& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

/// Covariance of the state that is predicted for a sample from those before it.
Eigen::MatrixXd predicted_covariance(const SampledSystem& system) {
  const Eigen::Index n = system.transition.rows();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd weights = system.reading_variances.cwiseInverse();
  // P(2 k) in terms of A, G and P of k samples.
  Eigen::MatrixXd a = system.transition.transpose();
  Eigen::MatrixXd g = system.readings.transpose() * weights.asDiagonal() * system.readings;
  Eigen::MatrixXd p = system.process_covariance;
  for (int doubling = 0; doubling < kDoublings; ++doubling) {
    const Eigen::MatrixXd sum = identity + g * p;
    const Eigen::PartialPivLU<Eigen::MatrixXd> inverse(sum);
    const Eigen::MatrixXd solved_a = inverse.solve(a);
    const Eigen::MatrixXd more = symmetric(a.transpose() * p * solved_a);
    g = symmetric(g + a * inverse.solve(g) * a.transpose());
    a = a * solved_a;
    p += more;
    if (!p.allFinite()) {
      throw arm::InputError("Kalman filter: the covariance of the state overflows");
    }
    if (more.cwiseAbs().maxCoeff() <= kSteady * p.cwiseAbs().maxCoeff()) break;
  }
  return p;
}

/// For a state that is predicted with covariance `p`.
FilterGain gain_for(const SampledSystem& system, const Eigen::MatrixXd& p) {
  const Eigen::MatrixXd crossed = system.readings * p;
  FilterGain made;
  made.innovation_covariance = symmetric(crossed * system.readings.transpose());
  made.innovation_covariance.diagonal() += system.reading_variances;
  const Eigen::LDLT<Eigen::MatrixXd> covariance(made.innovation_covariance);
  made.gain = covariance.solve(crossed).transpose();
  return made;
}

}  // namespace

bool SampledSystem::operator==(const SampledSystem& other) const {
  if (transition.rows() != other.transition.rows() || readings.rows() != other.readings.rows()) {
    return false;
  }
  return transition == other.transition && readings == other.readings &&
         process_covariance == other.process_covariance &&
         reading_variances == other.reading_variances;
}

Eigen::MatrixXd covariance_after_step(const SampledSystem& system,
                                      const Eigen::MatrixXd& covariance) {
  return symmetric(system.transition * covariance * system.transition.transpose()) +
         system.process_covariance;
}

FilterGain filter_gain(const SampledSystem& system) {
  if (!(system.reading_variances.minCoeff() > 0.0)) {
    throw arm::InputError("Kalman filter: the variance of a reading must be above 0");
  }
  return gain_for(system, predicted_covariance(system));
}

FilterGains filter_gains_from(const SampledSystem& system,
                              const Eigen::MatrixXd& initial_covariance, std::size_t samples) {
  FilterGains made{.steady = filter_gain(system)};
  const Eigen::Index n = system.transition.rows();
  const Eigen::MatrixXd noise = system.reading_variances.asDiagonal();
  Eigen::MatrixXd p = initial_covariance;
  for (std::size_t k = 0; k < samples; ++k) {
    const FilterGain now = gain_for(system, p);
    if ((now.gain - made.steady.gain).norm() <= kSettled * made.steady.gain.norm()) break;
    // Joseph's form, which stays positive whatever the rounding of the gain.
    const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - now.gain * system.readings;
    p = rest * p * rest.transpose() + now.gain * noise * now.gain.transpose();
    p = covariance_after_step(system, p);
    made.first.push_back(now);
  }
  return made;
}

}  // namespace flexarm::response
