#include "fem/sensor_row.hpp"

#include <stdexcept>

namespace flexarm::fem {

namespace {

using Complex = SensorRow::Complex;

/// c^T u, 0 for an empty row.
template <class Shape>
typename Shape::Scalar product(const Eigen::VectorXd& c, const Shape& u) {
  if (c.size() == 0) return 0.0;
  return c.cast<typename Shape::Scalar>().cwiseProduct(u).sum();
}

Eigen::VectorXd sum(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  if (a.size() == 0) return b;
  if (b.size() == 0) return a;
  return a + b;
}

}  // namespace

SensorRow::SensorRow(const Discretisation& discretisation, const arm::Sensor& sensor)
    : kelvin_voigt_(discretisation.kelvin_voigt()),
      root_retardation_(discretisation.root_retardation()),
      air_damping_(discretisation.air_damping()) {
  const int n = discretisation.size();
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      constant_ = Eigen::VectorXd::Unit(n, 0);
      return;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
      constant_ = Eigen::VectorXd::Unit(n, discretisation.tip_deflection_index());
      infinite_roots_ += discretisation.hub_index();
      return;
    case arm::SensorKind::tip_deflection:
      bending_ = discretisation.work_on_tip_bending();
      root_ = discretisation.work_on_tip_root();
      rest_ = discretisation.work_on_tip_shear_and_crack();
      infinite_roots_ = 3;
      break;
    case arm::SensorKind::strain:
      bending_ = discretisation.work_on_ramp(sensor.position_m / discretisation.arm().length_m);
      break;
  }
  by_equilibrium_ = true;
  infinite_roots_ += discretisation.hub_index();
  constant_ = sum(sum(bending_.inertia, root_.inertia), rest_.inertia);
  Eigen::VectorXd weight = sum(sum(bending_.weight, root_.weight), rest_.weight);
  if (weight.size() > 0) {
    times_w_ = std::move(constant_);
    constant_ = std::move(weight);
    --infinite_roots_;
  }
}

double SensorRow::undamped_reading(const Eigen::VectorXd& u, double w) const {
  if (times_w_.size() > 0) return -(product(constant_, u) + w * product(times_w_, u));
  return (by_equilibrium_ ? -w : 1.0) * product(constant_, u);
}

Complex SensorRow::reading(const Eigen::VectorXcd& u, Complex s) const {
  if (!by_equilibrium_) return product(constant_, u);
  const auto work = [&](const Discretisation::VirtualWork& of) -> Complex {
    return s * s * product(of.inertia, u) + s * air_damping_ * product(of.air, u) +
           product(of.weight, u);
  };
  const Complex root = work(root_) / (1.0 + root_retardation_ * s);
  return -(work(bending_) / (1.0 + kelvin_voigt_ * s) + root + work(rest_));
}

double si_reading(const arm::LinearArm& arm, const arm::Sensor& sensor) {
  switch (sensor.kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity:
      return 1.0;
    case arm::SensorKind::tip_acceleration:
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_deflection:
      return arm.length_m;
    case arm::SensorKind::strain:
      return *arm.thickness_m / (2.0 * arm.length_m);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

}  // namespace flexarm::fem
