#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/modal/modal_fit.hpp"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace flexarm::measured {

/// Covariance of fitted parameters where errors of different sensors on one line are correlated: a
/// force that nobody recorded shows in all of them, as does noise of the input. The fit takes them
/// as independent, with covariance C. With z_jk the gradient of response j on line k over its
/// standard deviation, and rho_ij,k = E[conj(e_i) e_j]/sqrt(E|e_i|^2 E|e_j|^2) the correlation of
/// the errors, it is the sandwich [White1980]
///
///     C + C sum_k sum_(i != j) Re(z_ik^H conj(rho_ij,k) z_jk) C.
///
/// `deviation` of real and of imaginary part, as the fit had it; times the rms of the residuals.
/// `correlation_at(frequency_Hz)`: of the channels of `record`, in their order.
Eigen::MatrixXd with_common_noise(
    const ModalFit& fit, const FrequencyRecord& record,
    const std::vector<std::vector<double>>& deviation,
    const std::function<Eigen::MatrixXcd(double frequency_Hz)>& correlation_at);

}  // namespace flexarm::measured
