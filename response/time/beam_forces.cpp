#include "response/time/beam_forces.hpp"

#include "arm/input_error.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace flexarm::response {

namespace {

constexpr int kParts = 6;
using GaussRule = boost::math::quadrature::gauss<double, 10>;

}  // namespace

BeamStations beam_stations(double length_m) {
  BeamStations rule;
  const double half = 0.5 * length_m / kParts;
  for (int part = 0; part < kParts; ++part) {
    const double middle = (2 * part + 1) * half;
    for (std::size_t k = GaussRule::abscissa().size(); k-- > 0;) {
      rule.stations_m.push_back(middle - half * GaussRule::abscissa()[k]);
      rule.weights_m.push_back(half * GaussRule::weights()[k]);
    }
    for (std::size_t k = 0; k < GaussRule::abscissa().size(); ++k) {
      rule.stations_m.push_back(middle + half * GaussRule::abscissa()[k]);
      rule.weights_m.push_back(half * GaussRule::weights()[k]);
    }
  }
  return rule;
}

BeamForces::BeamForces(const arm::ModalModel& model, double length_m,
                       std::vector<OfEffect<arm::BeamForce>> laws)
    : laws_(std::move(laws)) {
  const BeamStations rule = beam_stations(length_m);
  const auto stations = static_cast<Eigen::Index>(rule.stations_m.size());
  const auto n = static_cast<Eigen::Index>(model.modes.size());
  shapes_.resize(stations, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& shape = model.modes[static_cast<std::size_t>(i)].displacement_m;
    if (shape.size() != rule.stations_m.size()) {
      throw arm::InputError(
          fmt::format("effects.{}: mode {} has {} displacements: must be {}, at the stations of "
                      "forces along the beam",
                      effect(), i, shape.size(), stations),
          "effects." + effect());
    }
    shapes_.col(i) = Eigen::Map<const Eigen::VectorXd>(shape.data(), stations);
  }
  weights_ = Eigen::Map<const Eigen::VectorXd>(rule.weights_m.data(), stations);
  weighted_shapes_ = shapes_.transpose() * weights_.asDiagonal() / model.modal_mass_kg_m2;
}

Eigen::ArrayXd BeamForces::forces_N_per_m(const Eigen::ArrayXd& velocity_m_per_s) const {
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(velocity_m_per_s.size());
  for (const auto& [effect, law] : laws_) sum += velocity_m_per_s.unaryExpr(law.force_N_per_m);
  return sum;
}

Eigen::VectorXd BeamForces::modal_force(
    const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const {
  return weighted_shapes_ * forces_N_per_m(shapes_ * modal_velocity).matrix();
}

double BeamForces::power_W(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const {
  const Eigen::ArrayXd v = shapes_ * modal_velocity;
  return -weights_.dot((forces_N_per_m(v) * v).matrix());
}

}  // namespace flexarm::response
