#include "response/time/beam_forces.hpp"

#include "arm/input_error.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace flexarm::response {

namespace {

constexpr int kPointsAPart = 10;
constexpr int kParts = kBeamStations / kPointsAPart;
using GaussRule = boost::math::quadrature::gauss<double, kPointsAPart>;

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
  const auto n = static_cast<Eigen::Index>(model.modes.size());
  shapes_.resize(kBeamStations, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& shape = model.modes[static_cast<std::size_t>(i)].displacement_m;
    if (shape.size() != rule.stations_m.size()) {
      throw arm::InputError(
          fmt::format("effects.{}: mode {} has {} displacements: must be {}, at the stations of "
                      "forces along the beam",
                      effect(), i, shape.size(), kBeamStations),
          "effects." + effect());
    }
    shapes_.col(i) = AtStations::Map(shape.data());
  }
  weights_m_ = AtStations::Map(rule.weights_m.data());
  weights_per_modal_mass_ = weights_m_ / model.modal_mass_kg_m2;
}

BeamForces::AtStations BeamForces::forces_N_per_m(const AtStations& velocity_m_per_s) const {
  AtStations sum = AtStations::Zero();
  for (const auto& [effect, law] : laws_) {
    law.add({velocity_m_per_s.data(), kBeamStations}, {sum.data(), kBeamStations});
  }
  return sum;
}

void BeamForces::modal_force(std::span<const double> modal_velocity, Eigen::VectorXd& made) const {
  const auto n = static_cast<Eigen::Index>(modal_velocity.size());
  AtStations v;
  v.noalias() = shapes_ * Eigen::VectorXd::Map(modal_velocity.data(), n);
  const AtStations weighted = forces_N_per_m(v).cwiseProduct(weights_per_modal_mass_);
  made.noalias() = shapes_.transpose() * weighted;
}

double BeamForces::power_W(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const {
  const AtStations v = shapes_ * modal_velocity;
  return -weights_m_.dot(forces_N_per_m(v).cwiseProduct(v));
}

}  // namespace flexarm::response
