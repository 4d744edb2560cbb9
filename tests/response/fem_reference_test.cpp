// Friction and drag against an independent integrator: Dormand and Prince's method of Boost.odeint
// on the matrices of a finite-element model, with events of its own.
#include "fem/fem_arm.hpp"
#include "response/time/beam_forces.hpp"
#include "tests/response/simulation_models.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <boost/numeric/odeint.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>

namespace flexarm::response {
namespace {

namespace odeint = boost::numeric::odeint;
using State = std::vector<double>;  // u, u'

arm::Arm damped_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 2e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

/// M u'' + kv K u' + c e0 u0' + K u = e0 (tau - F) + drag, with all coordinates of the model: its
/// modes are the whole of it.
struct FemSystem {
  FemSystem()
      : model(damped_arm(), {.mesh = {.elements = 2}, .degree = 4}),
        mass(model.mass_kg_m2()),
        stiffness(model.stiffness_N_m()) {
    const BeamStations rule = beam_stations(model.arm().beam.length_m);
    modes = modal_model(rule.stations_m);
    // u = V q; V from the matrices, in the order and scale of the modes. y(x) = S u = S V q.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(stiffness, mass);
    const auto n = mass.rows();
    Eigen::MatrixXd coordinates = eigen.eigenvectors() * std::sqrt(modes.modal_mass_kg_m2);
    Eigen::MatrixXd displacements(static_cast<Eigen::Index>(rule.stations_m.size()), n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto& mode = modes.modes[static_cast<std::size_t>(i)];
      if (coordinates(0, i) * mode.hub_slope < 0.0) coordinates.col(i) *= -1.0;
      displacements.col(i) =
          Eigen::Map<const Eigen::VectorXd>(mode.displacement_m.data(), displacements.rows());
    }
    shapes = displacements * coordinates.inverse();
    weights = Eigen::Map<const Eigen::VectorXd>(rule.weights_m.data(), displacements.rows());
    factor.compute(mass);
    hub_inverse = factor.solve(Eigen::VectorXd::Unit(n, 0));
  }

  arm::ModalModel modal_model(const std::vector<double>& stations_m) const {
    arm::ModalModel made;
    const auto sensors = read();
    const auto flexible = model.modes(model.degrees_of_freedom() - 1, sensors, stations_m);
    const double length = model.arm().beam.length_m;
    made.modal_mass_kg_m2 = arm::total_inertia_kg_m2(model.arm());
    made.modes = {{.omega_rad_per_s = 0.0,
                   .hub_slope = 1.0,
                   .sensor_values = {1.0, 1.0, length, length},
                   .displacement_m = stations_m}};
    made.modes.insert(made.modes.end(), flexible.begin(), flexible.end());
    const double c = model.arm().hub.viscous_friction_N_m_s_per_rad;
    for (std::size_t i = 0; i < made.modes.size(); ++i) {
      for (std::size_t j = 0; j < made.modes.size(); ++j) {
        const auto& a = made.modes[i];
        const auto& b = made.modes[j];
        made.damping_rad_per_s.push_back(
            c * a.hub_slope * b.hub_slope / made.modal_mass_kg_m2 +
            (i == j ? model.arm().damping.kelvin_voigt_s * a.omega_rad_per_s * a.omega_rad_per_s
                    : 0.0));
      }
    }
    return made;
  }

  static std::vector<arm::Sensor> read() {
    return {kHubAngle, kHubVelocity, kTipDisplacement, kTipAcceleration};
  }

  fem::FemArm model;
  Eigen::MatrixXd mass;
  Eigen::MatrixXd stiffness;
  arm::ModalModel modes;
  Eigen::MatrixXd shapes;  // stations x n
  Eigen::VectorXd weights;
  Eigen::LLT<Eigen::MatrixXd> factor;
  Eigen::VectorXd hub_inverse;  // M^-1 e0
};

/// Friction and drag in numbers, as the reference has them.
struct Laws {
  double coulomb_N_m = 0.0;
  double stribeck_N_m = 0.0;
  double stribeck_static_N_m = 0.0;
  double stribeck_velocity_rad_per_s = 1.0;
  double drag_N_s2_per_m3 = 0.0;
};

/// The same equations, integrated without anything of response/.
class Reference {
 public:
  Reference(const FemSystem& fem, const Laws& laws)
      : fem_(fem), laws_(laws), n_(fem.mass.rows()), x_(static_cast<std::size_t>(2 * n_), 0.0) {}

  /// Accelerations with a torque on the hub; drag included.
  Eigen::VectorXd acceleration(const State& x, double hub_torque) const {
    const Eigen::Map<const Eigen::VectorXd> u(x.data(), n_);
    const Eigen::Map<const Eigen::VectorXd> v(x.data() + n_, n_);
    const auto& arm = fem_.model.arm();
    Eigen::VectorXd f = -fem_.stiffness * (u + arm.damping.kelvin_voigt_s * v);
    f(0) += hub_torque - arm.hub.viscous_friction_N_m_s_per_rad * v(0);
    const Eigen::ArrayXd speed = fem_.shapes * v;
    f -= laws_.drag_N_s2_per_m3 * fem_.shapes.transpose() *
         (fem_.weights.array() * speed.abs() * speed).matrix();
    return fem_.factor.solve(f);
  }

  double friction(double speed) const {
    const double r = speed / laws_.stribeck_velocity_rad_per_s;
    return laws_.coulomb_N_m + laws_.stribeck_N_m +
           (laws_.stribeck_static_N_m - laws_.stribeck_N_m) * std::exp(-r * r);
  }

  /// Torque that keeps the hub at rest.
  double needed(const State& x) const { return acceleration(x, torque)(0) / fem_.hub_inverse(0); }

  Eigen::VectorXd acceleration(const State& x) const {
    if (direction == 0) return acceleration(x, torque - needed(x));
    const double speed = x[static_cast<std::size_t>(n_)];
    return acceleration(x, torque - direction * friction(speed));
  }

  /// Below zero once the present motion has ended.
  double margin(const State& x) const {
    if (direction != 0) return direction * x[static_cast<std::size_t>(n_)];
    return friction(0.0) - std::abs(needed(x));
  }

  void advance(double duration) {
    double t = 0.0;
    while (t < duration) {
      if (direction == 0 && margin(x_) < 0.0) loosen();
      auto stepper = odeint::make_dense_output(1e-12, 1e-12, odeint::runge_kutta_dopri5<State>());
      stepper.initialize(x_, t, 1e-6);
      const auto rates = [this](const State& x, State& dx, double) {
        const Eigen::VectorXd a = acceleration(x);
        for (Eigen::Index i = 0; i < n_; ++i) {
          dx[static_cast<std::size_t>(i)] = x[static_cast<std::size_t>(n_ + i)];
          dx[static_cast<std::size_t>(n_ + i)] = a(i);
        }
      };
      double reached = t;
      bool ended = false;
      while (reached < duration && !ended) {
        stepper.do_step(rates);
        State x(x_.size());
        const double end = std::min(stepper.current_time(), duration);
        stepper.calc_state(end, x);
        // Freshly loosened: the speed is zero to rounding at first.
        const bool fresh = direction != 0 && reached == t && std::abs(hub_speed()) < 1e-14;
        double low = reached + (fresh ? 0.5 * (end - reached) : 0.0);
        reached = end;
        if (margin(x) < 0.0) {
          ended = true;
          double high = end;
          for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            stepper.calc_state(middle, x);
            (margin(x) < 0.0 ? high : low) = middle;
          }
          reached = high;
          stepper.calc_state(high, x);
        }
        if (ended || end == duration) x_ = x;
      }
      t = reached;
      if (!ended) break;
      if (direction == 0) {
        loosen();
      } else {
        x_[static_cast<std::size_t>(n_)] = 0.0;
        direction = 0;
      }
    }
  }

  void take_up(double new_torque) {
    torque = new_torque;
    if (direction == 0 && margin(x_) < 0.0) loosen();
  }

  /// Hub angle, hub velocity, tip displacement, tip acceleration. The tip's deflection in lengths
  /// is the last coordinate but one.
  std::array<double, 4> readings() const {
    const double length = fem_.model.arm().beam.length_m;
    const auto tip = static_cast<std::size_t>(n_ - 2);
    return {x_[0], hub_speed(), length * x_[tip], length * acceleration(x_)(n_ - 2)};
  }

 private:
  double hub_speed() const { return x_[static_cast<std::size_t>(n_)]; }
  void loosen() { direction = needed(x_) > 0.0 ? 1 : -1; }

  const FemSystem& fem_;
  Laws laws_;
  Eigen::Index n_;
  State x_;
  double torque = 0.0;
  int direction = 0;
};

struct Case {
  std::string name;
  Laws laws;
  double tolerance = 0.0;  ///< of the peak
};

/// Relative tolerance 1e-12 a step of the reference, of which there are some ten thousand.
constexpr double kExact = 1e-9;
/// The error of order 4 where friction varies with speed, of accelerations above all.
constexpr double kFourthOrder = 1e-7;

void PrintTo(const Case& law, std::ostream* out) {
  *out << law.name;
}

class AgainstOdeint : public testing::TestWithParam<Case> {};

TEST_P(AgainstOdeint, HubAndTipAgree) {
  constexpr double kSampleTime_s = 2e-3;
  constexpr std::size_t kSamplesAStep = 100;
  const FemSystem fem;
  ArmParts parts;
  parts.linear = fem.model.arm();
  const Laws& laws = GetParam().laws;
  put(parts, "coulomb_friction", {{"torque", laws.coulomb_N_m}});
  put(parts, "stribeck_friction",
      {{"torque", laws.stribeck_N_m},
       {"static_torque", laws.stribeck_static_N_m},
       {"velocity", laws.stribeck_velocity_rad_per_s}});
  if (laws.drag_N_s2_per_m3 > 0.0) {
    put(parts, "quadratic_drag", {{"coefficient", laws.drag_N_s2_per_m3}});
  }
  std::vector<double> torque;
  for (const double level : {0.06, -0.08, 0.02, 0.07, 0.0}) {
    torque.insert(torque.end(), kSamplesAStep, level);
  }
  const auto made =
      simulate(fem.modes, parts, FemSystem::read(), torque, {.sample_time_s = kSampleTime_s});
  Reference reference(fem, laws);
  std::vector<double> peak(4, 0.0);
  std::vector<double> difference(4, 0.0);
  for (std::size_t k = 0; k < torque.size(); ++k) {
    reference.take_up(torque[k]);
    const auto values = reference.readings();
    for (std::size_t j = 0; j < values.size(); ++j) {
      peak[j] = std::max(peak[j], std::abs(values[j]));
      difference[j] = std::max(difference[j], std::abs(values[j] - made.channels[j][k]));
    }
    reference.advance(kSampleTime_s);
  }
  for (std::size_t j = 0; j < peak.size(); ++j) {
    EXPECT_LT(difference[j], GetParam().tolerance * peak[j]) << j;
  }
  EXPECT_GT(made.summary.stops + made.summary.reversals, 1);
  EXPECT_LT(made.energy.largest_residual_J, 1e-6 * made.energy.work_in_J);
}

INSTANTIATE_TEST_SUITE_P(
    Laws, AgainstOdeint,
    testing::Values(
        Case{"coulomb", {.coulomb_N_m = 0.012}, kExact},
        Case{"stribeck", {0.0, 0.01, 0.02, 0.3}, kFourthOrder},
        Case{"coulomb_and_drag", {.coulomb_N_m = 0.012, .drag_N_s2_per_m3 = 0.1}, kExact},
        Case{"everything", {0.002, 0.01, 0.02, 0.3, 0.1}, kFourthOrder}),
    [](const auto& law) { return law.param.name; });

}  // namespace
}  // namespace flexarm::response
