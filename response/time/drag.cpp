#include "response/time/drag.hpp"

#include "arm/input_error.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <fmt/format.h>

#include <cstddef>

namespace flexarm::response {

namespace {

constexpr int kParts = 6;
using GaussRule = boost::math::quadrature::gauss<double, 10>;

}  // namespace

DragStations drag_stations(double length_m) {
  DragStations rule;
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

QuadraticDrag::QuadraticDrag(const arm::ModalModel& model, double length_m,
                             double coefficient_N_s2_per_m3) {
  const DragStations rule = drag_stations(length_m);
  const auto stations = static_cast<Eigen::Index>(rule.stations_m.size());
  const auto n = static_cast<Eigen::Index>(model.modes.size());
  shapes_.resize(stations, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& shape = model.modes[static_cast<std::size_t>(i)].displacement_m;
    if (shape.size() != rule.stations_m.size()) {
      throw arm::InputError(
          fmt::format("effects.quadratic_drag: mode {} has {} displacements: must be {}, at the "
                      "stations of drag",
                      i, shape.size(), stations),
          "effects.quadratic_drag");
    }
    shapes_.col(i) = Eigen::Map<const Eigen::VectorXd>(shape.data(), stations);
  }
  weights_ =
      coefficient_N_s2_per_m3 * Eigen::Map<const Eigen::VectorXd>(rule.weights_m.data(), stations);
  weighted_shapes_ = -shapes_.transpose() * weights_.asDiagonal() / model.modal_mass_kg_m2;
}

Eigen::VectorXd QuadraticDrag::modal_force(
    const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const {
  const Eigen::ArrayXd v = shapes_ * modal_velocity;
  return weighted_shapes_ * (v.abs() * v).matrix();
}

double QuadraticDrag::power_W(const Eigen::Ref<const Eigen::VectorXd>& modal_velocity) const {
  const Eigen::ArrayXd v = shapes_ * modal_velocity;
  return weights_.dot(v.abs().cube().matrix());
}

}  // namespace flexarm::response
