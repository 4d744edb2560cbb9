// The first pole of one arm from each formulation; fails when they are 1e-9 apart.
#include "arm/arm.hpp"
#include "assumed_modes/assumed_modes_arm.hpp"
#include "exact_tf/exact_arm.hpp"
#include "fem/fem_arm.hpp"

#include <cmath>

int main() {
  using namespace flexarm;
  const auto first_pole = [](const auto& model) { return model.poles(1).omega_rad_per_s.front(); };
  const double exact = first_pole(exact_tf::ExactArm(arm::paper_arm()));
  const double fem = first_pole(fem::FemArm(arm::paper_arm()));
  const double modes = first_pole(assumed_modes::AssumedModesArm(arm::paper_arm()));
  return std::abs(fem / exact - 1.0) < 1e-9 && std::abs(modes / exact - 1.0) < 1e-9 ? 0 : 1;
}
