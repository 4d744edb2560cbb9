// Members of Discretisation that evaluate shapes between the nodes and integrate loads on influence
// shapes.
#include "fem/discretisation.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <cstddef>

namespace flexarm::fem {

namespace {

/// int f P_k dx over [from, to], k = 0 ... p, of an element from `left` of length `h`.
template <class Function>
Eigen::VectorXd moments(const Function& f, int degree, double left, double h, double from,
                        double to) {
  // 20 Gauss points are exact to degree 39; the integrands' is p + 1 <= 34.
  using Gauss = boost::math::quadrature::gauss<double, 20>;
  Eigen::VectorXd result(degree + 1);
  for (int k = 0; k <= degree; ++k) {
    result[k] = Gauss::integrate(
        [&](double x) { return f(x) * legendre_values(k, 2.0 * (x - left) / h - 1.0)[k]; }, from,
        to);
  }
  return result;
}

}  // namespace

Discretisation::VirtualWork Discretisation::work_on_ramp(double position) const {
  VirtualWork work{Eigen::VectorXd::Zero(size()), Eigen::VectorXd::Zero(size()),
                   Eigen::VectorXd::Zero(size())};
  const int degree = element_.degree();
  const int locals = element_.shape_functions();
  Eigen::VectorXd ramp = Eigen::VectorXd::Zero(degree + 1);
  Eigen::VectorXd step = ramp;
  Eigen::VectorXd tensed = ramp;
  for (int e = 0; e < elements(); ++e) {
    const double left = nodes_[static_cast<std::size_t>(e)];
    const double right = nodes_[static_cast<std::size_t>(e) + 1];
    if (right <= position) continue;
    const double h = lengths_[static_cast<std::size_t>(e)];
    const double middle = tension(e);
    if (position <= left) {
      ramp.head(2) << h * ((left - position) + h / 2.0), h * h / 6.0;
      step[0] = h;
      tensed.head(2) << h * middle, -gravity_ * h * h / 6.0;
      ramp.tail(degree - 1).setZero();
      step.tail(degree).setZero();
      tensed.tail(degree - 1).setZero();
    } else {
      const auto over_part = [&](const auto& f) {
        return moments(f, degree, left, h, position, right);
      };
      ramp = over_part([&](double x) { return x - position; });
      step = over_part([](double) { return 1.0; });
      tensed = over_part([&](double x) { return middle - gravity_ * (x - left - h / 2.0); });
    }
    const Eigen::VectorXd air = element_.deflection(h) * ramp;
    const Eigen::VectorXd inertia = air + rotary_inertia_ * (element_.rotation(h) * step);
    const Eigen::VectorXd weight = element_.slope(h) * tensed;
    for (int i = 0; i < locals; ++i) {
      const Place at = place(e, i);
      if (at.index < 0) continue;
      work.inertia[at.index] += at.factor * inertia[i];
      work.air[at.index] += at.factor * air[i];
      work.weight[at.index] += at.factor * weight[i];
    }
  }
  const double arm = 1.0 - position;
  const int tip = tip_deflection_index();
  work.inertia[tip] += payload_mass_ * arm + payload_first_moment_;
  work.inertia[tip + 1] += payload_first_moment_ * arm + payload_inertia_;
  work.weight[tip + 1] += gravity_ * payload_first_moment_;
  for (const Carried& mass : carried_) {
    if (mass.position <= position) continue;
    const Place beam = deflection_place(mass);
    const Place at = mass.displacement < 0 ? beam : Place{mass.displacement, 1.0};
    if (at.index < 0) continue;
    work.inertia[at.index] += at.factor * mass.mass * (mass.position - position);
    if (mass.displacement < 0) continue;
    work.weight[at.index] += gravity_ * mass.mass;
    if (beam.index >= 0) work.weight[beam.index] -= beam.factor * gravity_ * mass.mass;
  }
  if (air_damping_ == 0.0) work.air.resize(0);
  if (work.weight.isZero(0.0)) work.weight.resize(0);
  return work;
}

Discretisation::VirtualWork Discretisation::work_on(const Eigen::VectorXd& shape) const {
  VirtualWork work{mass_ * shape, {}, {}};
  if (air_damping_ > 0.0) work.air = air_mass_ * shape;
  if (has_weight()) work.weight = weight_ * shape;
  return work;
}

Discretisation::VirtualWork Discretisation::work_on_tip_bending() const {
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(size());
  for (int e = 0; e < elements(); ++e) {
    const double left = nodes_[static_cast<std::size_t>(e)];
    const double x = nodes_[static_cast<std::size_t>(e) + 1];
    shape[place(e, 1).index] = left * (2.0 - left) / 2.0;
    shape[place(e, 2).index] = x * x * (3.0 - x) / 6.0;
    shape[place(e, 3).index] = x * (2.0 - x) / 2.0;
  }
  place_suspended(shape);
  return work_on(shape);
}

Discretisation::VirtualWork Discretisation::work_on_tip_root() const {
  if (!arm_.root_stiffness_N_m_per_rad) return {};
  // The force has the arm 1 about the root.
  const double rotation = 1.0 / natural_stiffness_[hub_index()];
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(size());
  for (int e = 0; e < elements(); ++e) {
    shape[place(e, 1).index] = rotation;
    shape[place(e, 2).index] = rotation * nodes_[static_cast<std::size_t>(e) + 1];
    shape[place(e, 3).index] = rotation;
  }
  place_suspended(shape);
  return work_on(shape);
}

Discretisation::VirtualWork Discretisation::work_on_tip_shear_and_crack() const {
  if (!arm_.shear && !arm_.crack) return {};
  // The force has the arm 1 - X about the crack.
  const double crack_at = arm_.crack ? nodes_[static_cast<std::size_t>(before_crack_)] : 1.0;
  const double crack =
      arm_.crack ? (1.0 - crack_at) / natural_stiffness_[spring_rotations_.back()] : 0.0;
  const double shear = arm_.shear ? 1.0 / shear_rigidity_ : 0.0;
  Eigen::VectorXd shape = Eigen::VectorXd::Zero(size());
  for (int e = 0; e < elements(); ++e) {
    const double x = nodes_[static_cast<std::size_t>(e) + 1];
    const double rotation = arm_.crack && e >= before_crack_ ? crack : 0.0;
    if (place(e, 1).index > 0) shape[place(e, 1).index] = rotation;
    shape[place(e, 2).index] = shear * x + crack * std::max(x - crack_at, 0.0);
    shape[place(e, 3).index] = rotation;
    if (arm_.shear) shape[place(e, 4 + element_.bubbles()).index] = shear;
  }
  place_suspended(shape);
  return work_on(shape);
}

void Discretisation::place_suspended(Eigen::VectorXd& shape) const {
  for (const Carried& mass : carried_) {
    const Place at = deflection_place(mass);
    if (mass.displacement >= 0 && at.index >= 0) {
      shape[mass.displacement] = at.factor * shape[at.index];
    }
  }
}

double Discretisation::deflection(const Eigen::VectorXd& u, double x) const {
  const auto after = std::upper_bound(nodes_.begin(), nodes_.end(), x);
  const auto found = std::max<std::ptrdiff_t>(after - nodes_.begin() - 1, 0);
  const int e = static_cast<int>(std::min<std::ptrdiff_t>(found, elements() - 1));
  const double h = lengths_[static_cast<std::size_t>(e)];
  const double xi = 2.0 * (x - nodes_[static_cast<std::size_t>(e)]) / h - 1.0;
  const Eigen::VectorXd shapes = element_.deflection(h) * legendre_values(element_.degree(), xi);
  double y = 0.0;
  for (int i = 0; i < element_.shape_functions(); ++i) {
    const Place at = place(e, i);
    if (at.index >= 0) y += at.factor * u[at.index] * shapes[i];
  }
  return y;
}

}  // namespace flexarm::fem
