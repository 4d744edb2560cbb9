#pragma once

#include "exact_tf/exact_arm.hpp"

#include <complex>
#include <vector>

namespace flexarm::compare::paper {

/// What the modal equations (28)-(35) and (47)-(52) are fed with: the first modes of an arm with
/// Kelvin-Voigt damping, phi scaled to the modal mass I_T.
struct ModalData {
  double total_inertia_kg_m2 = 0.0;
  double length_m = 0.0;
  double kelvin_voigt_s = 0.0;
  std::vector<double> omega_rad_per_s;
  std::vector<double> hub_slope;            ///< phi_i'(0)
  std::vector<double> tip_m;                ///< phi_i(l)
  std::vector<double> tip_curvature_per_m;  ///< phi_i''(l), 0 at a free tip

  std::size_t modes() const { return omega_rad_per_s.size(); }
  /// 2 xi_i omega_i [1/s].
  double damping_term(std::size_t i) const {
    return kelvin_voigt_s * omega_rad_per_s[i] * omega_rad_per_s[i];
  }
};

ModalData modal_data(const exact_tf::ExactArm& arm, int modes);

/// Modal participation of an output: gain_i of a sensor that shows rigid theta + sum gain_i q_i.
///
///     (1/I_T) (rigid/s^2 + sum_i gain_i phi_i'(0)/(s^2 + d_i s + omega_i^2))
///
/// times s^derivatives; `damping_terms` are the d_i. This is (48) for gain = phi'(0), rigid = 1,
/// and (49) for gain = phi(l), rigid = l and two derivatives.
std::complex<double> partial_fractions(const ModalData& data, double rigid,
                                       const std::vector<double>& gain,
                                       const std::vector<double>& damping_terms, int derivatives,
                                       std::complex<double> s);

/// kv omega_i^2 for every mode.
std::vector<double> damping_terms(const ModalData& data);

/// Residues of a product of poles and zeros: phi_i'(0)^2 for which (48) equals (47) without
/// damping, with as many zeros as poles; Hz or rad/s alike.
///
///     phi_i'(0)^2 = -prod_k (1 - p_i^2/z_k^2) / prod_{k != i} (1 - p_i^2/p_k^2)
std::vector<double> squared_slopes(const std::vector<double>& poles,
                                   const std::vector<double>& zeros);

}  // namespace flexarm::compare::paper
