#pragma once

#include "arm/formulation.hpp"

#include <complex>
#include <vector>

namespace flexarm::exact_tf {

/// Both roots of every pair, the lowest mode's first.
inline std::vector<std::complex<double>> all_roots(const arm::DampedPoleSet& set) {
  std::vector<std::complex<double>> roots = {set.lowest.first_rad_per_s,
                                             set.lowest.second_rad_per_s};
  for (const auto& pair : set.flexible) {
    roots.push_back(pair.first_rad_per_s);
    roots.push_back(pair.second_rad_per_s);
  }
  return roots;
}

}  // namespace flexarm::exact_tf
