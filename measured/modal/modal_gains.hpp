#pragma once

#include "arm/input_error.hpp"
#include "measured/modal/modal_fit.hpp"

#include <optional>
#include <vector>

namespace flexarm::measured {

/// A total inertia at 0 or below, which no arm has.
class UnphysicalInertia : public arm::InputError {
 public:
  using InputError::InputError;
};

/// A number with its standard error.
struct Estimate {
  double value = 0.0;
  double standard_error = 0.0;
};

/// What a fit says of one mode's shape, in the scaling of arm/formulation.hpp: modal mass I_T, hub
/// slope above 0. Empty where the sensor it takes was not measured.
struct ModalGain {
  double frequency_Hz = 0.0;
  /// theta_i = sqrt(I_T b0_i) from the hub's residues: (48), where b0_i = theta_i^2/I_T. Hub angle
  /// and velocity have the same; each is weighted by its variance.
  std::optional<Estimate> hub_slope;
  /// theta_i^2 = -prod_k(1 - omega_i^2/Omega_k^2)/prod_{k != i}(1 - omega_i^2/omega_k^2) from the
  /// frequencies of fitted poles and hub zeros: (47) as a product. Needs no I_T. Zeros beyond the
  /// last pole, and modes beyond the band, are not in it.
  std::optional<Estimate> hub_slope_of_product;
  /// phi_i(l) = I_T b0_i(tip)/theta_i [m], with its sign: (49).
  std::optional<Estimate> tip_gain_m;
  /// phi_i(l) = -Re[alpha/theta](j omega_i) theta_i/omega_i^2 [m]: (52) with its minus sign, at the
  /// resonance of the fitted responses, other modes' part included. theta is of the hub sensor that
  /// knows the mode better, a velocity over s.
  std::optional<Estimate> tip_gain_of_ratio_m;
};

struct ModalGains {
  /// I_T: 1/b0 of the rigid-body block [kg m^2], or as given.
  Estimate total_inertia_kg_m2;
  std::vector<ModalGain> modes;  ///< of the fit's poles that are modes
};

/// Hub slopes and tip gains of the modes, standard errors to first order from the covariance of all
/// parameters. `total_inertia_kg_m2` given, its error is taken as 0; else the torque must be
/// calibrated in N m.
///
/// Throws InputError when neither hub angle nor hub velocity was measured, when the inertia has to
/// be found and the fit has no rigid-body block; UnphysicalInertia where it comes out at 0 or
/// below.
ModalGains modal_gains(const ModalFit& fit, std::optional<double> total_inertia_kg_m2 = {});

}  // namespace flexarm::measured
