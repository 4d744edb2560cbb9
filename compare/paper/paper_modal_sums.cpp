#include "compare/paper/paper_modal_sums.hpp"

#include "compare/paper/paper_models.hpp"

namespace flexarm::compare::paper {

ModalData modal_data(const exact_tf::ExactArm& exact, int modes) {
  const arm::Arm& arm = exact.arm();
  const double l = arm.beam.length_m;
  const std::vector<arm::Sensor> sensors{kTipDisplacement, {arm::SensorKind::strain, l}};
  ModalData data{.total_inertia_kg_m2 = arm::total_inertia_kg_m2(arm),
                 .length_m = l,
                 .kelvin_voigt_s = arm.damping.kelvin_voigt_s,
                 .omega_rad_per_s = {},
                 .hub_slope = {},
                 .tip_m = {},
                 .tip_curvature_per_m = {}};
  for (const auto& m : exact.modes(modes, sensors, {})) {
    data.omega_rad_per_s.push_back(m.omega_rad_per_s);
    data.hub_slope.push_back(m.hub_slope);
    data.tip_m.push_back(m.sensor_values.at(0));
    data.tip_curvature_per_m.push_back(2.0 / *arm.beam.thickness_m * m.sensor_values.at(1));
  }
  return data;
}

std::complex<double> partial_fractions(const ModalData& data, double rigid,
                                       const std::vector<double>& gain,
                                       const std::vector<double>& damping_terms, int derivatives,
                                       std::complex<double> s) {
  std::complex<double> sum = rigid / (s * s);
  for (std::size_t i = 0; i < data.modes(); ++i) {
    const double w = data.omega_rad_per_s[i];
    sum += gain[i] * data.hub_slope[i] / (s * s + damping_terms[i] * s + w * w);
  }
  for (int k = 0; k < derivatives; ++k) sum *= s;
  return sum / data.total_inertia_kg_m2;
}

std::vector<double> damping_terms(const ModalData& data) {
  std::vector<double> terms(data.modes());
  for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = data.damping_term(i);
  return terms;
}

std::vector<double> squared_slopes(const std::vector<double>& poles,
                                   const std::vector<double>& zeros) {
  const auto factor = [](double p, double root) { return 1.0 - (p / root) * (p / root); };
  std::vector<double> slopes;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    double residue = -1.0;
    for (const double zero : zeros) residue *= factor(poles[i], zero);
    for (std::size_t k = 0; k < poles.size(); ++k) {
      if (k != i) residue /= factor(poles[i], poles[k]);
    }
    slopes.push_back(residue);
  }
  return slopes;
}

}  // namespace flexarm::compare::paper
