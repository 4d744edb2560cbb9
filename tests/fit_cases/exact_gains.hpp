#pragma once

#include "arm/formulation.hpp"

#include <cstddef>
#include <vector>

namespace flexarm::measured {

/// What `modal_gains` estimates, of a damped model itself: from the residues of its equations of
/// motion, by eigenvectors, as an independent computation.
struct ExactGains {
  double total_inertia_kg_m2 = 0.0;
  std::vector<double> hub_slopes;            ///< flexible modes, ascending in frequency
  std::vector<double> tip_gains_m;           ///< (49)
  std::vector<double> tip_gains_of_ratio_m;  ///< (52) with its minus sign
};

/// Of a model with hub friction, whose rigid body has poles at 0 and -a1; the places
/// are those of hub angle or velocity and of tip acceleration among its sensors.
ExactGains exact_gains(const arm::ModalModel& model, std::size_t hub_sensor,
                       std::size_t tip_sensor);

}  // namespace flexarm::measured
