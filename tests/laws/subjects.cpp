#include "laws/subjects.hpp"

namespace flexarm::laws {

namespace {

Subject fem_subject(const char* name, int elements, int degree, double tolerance) {
  return {name,
          [elements, degree](const arm::Arm& arm) -> response::AnyFormulation {
            fem::FemArm::Options options;
            options.mesh.elements = elements;
            options.degree = degree;
            return fem::FemArm(arm, options);
          },
          tolerance};
}

Subject ritz_subject(const char* name, assumed_modes::Basis basis, int functions,
                     double tolerance) {
  return {name,
          [basis, functions](const arm::Arm& arm) -> response::AnyFormulation {
            assumed_modes::AssumedModesOptions options;
            options.basis = basis;
            options.functions = functions;
            return assumed_modes::AssumedModesArm(arm, options);
          },
          tolerance};
}

}  // namespace

std::vector<Subject> every_formulation() {
  return {
      {"exact_tf",
       [](const arm::Arm& arm) -> response::AnyFormulation { return exact_tf::ExactArm(arm); },
       1e-12},
      // Cubic elements: error of mode n about (lambda_n h)^4/720 with h = 1/200, lambda_5 = 14.
      fem_subject("fem_cubic", 200, 3, 5e-8),
      fem_subject("fem_degree_9", 6, 9, 1e-11),
      ritz_subject("assumed_modes_legendre", assumed_modes::Basis::legendre, 32, 1e-11),
  };
}

std::vector<arm::Arm> varied_arms() {
  std::vector<arm::Arm> arms(4, arm::paper_arm());
  arms[1].payload.mass_kg = 0.05;
  arms[2].payload = {0.2, 1e-3};
  arms[3].hub.inertia_kg_m2 = 0.05;
  arms[3].payload.mass_kg = 0.02;
  return arms;
}

arm::Arm unit_arm(double hub_inertia_kg_m2) {
  arm::Arm arm;
  arm.beam = arm::Beam::from_rigidity(1.0, 1.0, 1.0);
  arm.hub.inertia_kg_m2 = hub_inertia_kg_m2;
  return arm;
}

}  // namespace flexarm::laws
