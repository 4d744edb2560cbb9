#include "exact_tf/chain_modes.hpp"

#include "exact_tf/boundary_values.hpp"

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace flexarm::exact_tf {

namespace {

constexpr std::size_t kPoints = 15;

/// A point of [0, 1] and its weight.
struct GaussPoint {
  Real at;
  Real weight;
};

const std::array<GaussPoint, kPoints>& gauss_points() {
  using Rule = boost::math::quadrature::gauss<Real, kPoints>;
  static const std::array<GaussPoint, kPoints> points = [] {
    std::array<GaussPoint, kPoints> all{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const Real x = Rule::abscissa()[i];
      const Real weight = 0.5L * Rule::weights()[i];
      all[n++] = {0.5L + 0.5L * x, weight};
      if (x != 0.0L) all[n++] = {0.5L - 0.5L * x, weight};
    }
    return all;
  }();
  return points;
}

Real largest_magnitude(std::span<const Real> values) {
  Real largest = 0.0L;
  for (const Real value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// theta from psi(0) - M(0)/kr or, where the hub is hard to turn and that all but vanishes, from
/// the torque on it: M(0) + a Q(0) = hub_impedance theta at a pole.
Real hub_angle_of(const TransferChain<Real>& chain, const BeamState<Real>& root, Real waves) {
  const auto& arm = chain.arm();
  const Real impedance = chain.beam().hub_impedance;
  const Real radius = arm.hub_radius;
  return std::abs(impedance) > waves + radius * radius * waves * waves * waves
             ? (root[kMoment] + radius * root[kForce]) / impedance
             : root[kRotation] - arm.root_flexibility * root[kMoment];
}

/// With a compliant drive a pole has taud + rotor_impedance theta_m = 0, so that
///
///     theta = (1 + drive rotor_impedance) theta_m
///     M(0) + a Q(0) = (hub_impedance (1 + drive rotor_impedance) + rotor_impedance) theta_m:
///
/// theta_m from the one of them in which rounding does less. The first all but vanishes where the
/// rotor vibrates by itself, the second where the load does.
HubMotion motion_beyond_drive(const TransferChain<Real>& chain, const BeamState<Real>& root,
                              Real waves) {
  const auto& arm = chain.arm();
  const Real rotor = chain.beam().rotor_impedance;
  const Real hub = chain.beam().hub_impedance;
  const Real turning = chain.beam().drive * rotor;
  const Real radius = arm.hub_radius;
  const Real angle = root[kRotation] - arm.root_flexibility * root[kMoment];
  const Real moment = root[kMoment] + radius * root[kForce];
  const Real along_hub = 1.0L + turning;
  const Real along_torque = hub * along_hub + rotor;
  const Real by_hub = angle / along_hub;
  const Real by_torque = moment / along_torque;
  const Real lost_by_hub = (1.0L + std::abs(turning * by_hub)) / std::abs(along_hub);
  const Real lost_by_torque =
      (waves + radius * radius * waves * waves * waves +
       (std::abs(hub) * (1.0L + std::abs(turning)) + std::abs(rotor)) * std::abs(by_torque)) /
      std::abs(along_torque);
  if (lost_by_hub <= lost_by_torque) return {angle, by_hub};
  return {along_hub * by_torque, by_torque};
}

HubMotion hub_motion_of(const TransferChain<Real>& chain, const BeamState<Real>& root, Real waves) {
  if (!chain.arm().has_rigid_drive()) return motion_beyond_drive(chain, root, waves);
  const Real angle = hub_angle_of(chain, root, waves);
  return {angle, angle};
}

}  // namespace

ChainModes::ChainModes(const ArmInBeamUnits& arm, std::span<const Real> omega_squared)
    : arm_(arm), highest_(undamped_at(arm, largest_magnitude(omega_squared))) {
  const TransferChain<Real> chain(arm, highest_);
  for (const auto& link : chain.links()) {
    if (link.is_segment()) segments_.push_back(link.segment);
  }
  modes_.reserve(omega_squared.size());
  for (const Real square : omega_squared) {
    Mode mode = square == 0.0L && arm.turns_freely() ? rigid_body_mode() : mode_at(square);
    normalise(mode);
    modes_.push_back(std::move(mode));
  }
}

ChainModes::Mode ChainModes::rigid_body_mode() const {
  Mode mode;
  mode.hub = {1.0L, 1.0L};
  const auto at_rest = undamped_at(arm_, Real(0.0L));
  for (const Segment& segment : segments_) {
    mode.series.emplace_back(arm_, at_rest, segment,
                             BeamState<Real>{arm_.hub_radius + segment.right, 1.0L, 0.0L, 0.0L});
  }
  for (const auto& mass : arm_.carried) {
    mode.carried.push_back({arm_.hub_radius + mass.position, 0.0L});
  }
  sample(mode);
  return mode;
}

CarriedMotion ChainModes::motion_of(const TransferChain<Real>& chain, std::size_t k,
                                    const BeamState<Real>& at_right,
                                    const BeamState<Real>& at_left) const {
  const Real y = at_right[kDisplacement];
  if (!arm_.carried[k].is_suspended()) return {y, 0.0L};
  constexpr Real kNearResonance = 0.1L;
  const CarriedMass<Real>& mass = chain.masses()[k];
  if (std::abs(mass.resonance()) > kNearResonance) {
    const Real extension = mass.extension(at_right) / mass.resonance();
    return {y + extension, extension};
  }
  // y all but vanishes: by the force that moves the mass.
  const Real force = at_right[kForce] - at_left[kForce];
  const Real displacement = force / (arm_.carried[k].mass * chain.beam().square);
  return {displacement, displacement - y};
}

ChainModes::Mode ChainModes::mode_at(Real omega_squared) const {
  const TransferChain<Real> chain(arm_, undamped_at(arm_, omega_squared), highest_);
  const auto& links = chain.links();
  // Of the right ends of all links, and of the root.
  std::vector<ScaledPlane<Real>> planes = {chain.tip_plane()};
  for (const auto& link : links) {
    planes.push_back(planes.back());
    chain.to_left(link, planes.back());
  }
  std::vector<ScaledFunctional<Real>> functionals(links.size() + 1);
  functionals.back() = chain.root_functional();
  for (std::size_t i = links.size(); i-- > 0;) {
    functionals[i] = functionals[i + 1];
    chain.to_right(links[i], functionals[i]);
  }
  const Real log_scale = planes.back().log_scale + functionals.back().log_scale;
  const auto state_at = [&](std::size_t i) {
    auto state = state_in_plane(functionals[i].functional, planes[i].plane);
    const Real factor = std::exp(planes[i].log_scale + functionals[i].log_scale - log_scale);
    for (Real& value : state) value *= factor;
    return state;
  };
  Mode mode;
  mode.carried.resize(arm_.carried.size());
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (links[i].is_segment()) {
      mode.series.emplace_back(arm_, chain.beam(), links[i].segment, state_at(i));
    } else if (links[i].mass) {
      mode.carried[*links[i].mass] = motion_of(chain, *links[i].mass, state_at(i), state_at(i + 1));
    }
  }
  mode.root_turn = arm_.root_flexibility * state_at(links.size())[kMoment];
  const Real waves = wave_number(arm_, chain.beam(), {1.0L, 1.0L});
  mode.hub = hub_motion_of(chain, state_at(links.size()), waves);
  sample(mode);
  return mode;
}

void ChainModes::sample(Mode& mode) const {
  mode.tip = mode.series.front().at(0.0L);
  for (const auto& series : mode.series) {
    for (const auto& point : gauss_points()) {
      const auto state = series.at(point.at);
      mode.displacements.push_back(state[kDisplacement]);
      mode.rotations.push_back(state[kRotation]);
      mode.moments.push_back(state[kMoment]);
    }
  }
}

void ChainModes::normalise(Mode& mode) const {
  const Real tip = mode.tip[kDisplacement];
  const Real turn = mode.tip[kRotation];
  Real mass = integral(mode.displacements, mode.displacements) +
              arm_.rotary_inertia * integral(mode.rotations, mode.rotations) +
              arm_.hub_inertia * mode.hub.angle * mode.hub.angle +
              arm_.rotor_inertia * mode.hub.motor_angle * mode.hub.motor_angle +
              arm_.payload_mass * tip * tip + 2.0L * arm_.payload_moment * tip * turn +
              arm_.payload_inertia * turn * turn;
  for (std::size_t k = 0; k < mode.carried.size(); ++k) {
    mass += arm_.carried[k].mass * mode.carried[k].displacement * mode.carried[k].displacement;
  }
  mode.scale = std::copysign(std::sqrt(arm_.total_inertia() / mass), mode.hub.motor_angle);
  mode.hub.angle *= mode.scale;
  mode.hub.motor_angle *= mode.scale;
  mode.root_turn *= mode.scale;
  for (CarriedMotion& motion : mode.carried) {
    motion.displacement *= mode.scale;
    motion.extension *= mode.scale;
  }
  for (Real& value : mode.tip) value *= mode.scale;
  for (auto* values : {&mode.displacements, &mode.rotations, &mode.moments}) {
    for (Real& value : *values) value *= mode.scale;
  }
}

Real ChainModes::integral(const std::vector<Real>& a, const std::vector<Real>& b) const {
  Real sum = 0.0L;
  std::size_t n = 0;
  for (const Segment& segment : segments_) {
    for (const auto& point : gauss_points()) {
      sum += segment.length * point.weight * a[n] * b[n];
      ++n;
    }
  }
  return sum;
}

BeamState<Real> ChainModes::state(std::size_t mode, Real x) const {
  const auto found =
      std::ranges::find_if(segments_, [x](const Segment& segment) { return segment.left() <= x; });
  const auto place = found == segments_.end() ? segments_.size() - 1
                                              : static_cast<std::size_t>(found - segments_.begin());
  const Segment& segment = segments_[place];
  auto result = modes_[mode].series[place].at((segment.right - x) / segment.length);
  for (Real& value : result) value *= modes_[mode].scale;
  return result;
}

Real ChainModes::tip_displacement(std::size_t mode) const {
  return modes_[mode].tip[kDisplacement];
}

Real ChainModes::displacement(std::size_t mode, Real x) const {
  return state(mode, x)[kDisplacement];
}

Real ChainModes::curvature(std::size_t mode, Real x) const {
  return state(mode, x)[kMoment];
}

Real ChainModes::damping(std::size_t i, std::size_t j) const {
  const Mode& a = modes_[i];
  const Mode& b = modes_[j];
  Real sum = arm_.hub_friction * a.hub.motor_angle * b.hub.motor_angle;
  if (arm_.drive_retardation > 0.0L) {
    sum += arm_.drive_retardation / arm_.drive_flexibility * (a.hub.motor_angle - a.hub.angle) *
           (b.hub.motor_angle - b.hub.angle);
  }
  if (arm_.root_retardation > 0.0L) {
    sum += arm_.root_retardation / arm_.root_flexibility * a.root_turn * b.root_turn;
  }
  for (std::size_t k = 0; k < arm_.carried.size(); ++k) {
    sum += arm_.carried[k].mass * arm_.carried[k].damping * a.carried[k].extension *
           b.carried[k].extension;
  }
  if (arm_.kelvin_voigt > 0.0L) sum += arm_.kelvin_voigt * integral(a.moments, b.moments);
  if (arm_.air_damping > 0.0L) sum += arm_.air_damping * integral(a.displacements, b.displacements);
  return sum / arm_.total_inertia();
}

}  // namespace flexarm::exact_tf
