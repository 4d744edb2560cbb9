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
template <class R>
struct GaussPoint {
  R at;
  R weight;
};

template <class R>
const std::array<GaussPoint<R>, kPoints>& gauss_points() {
  using Rule = boost::math::quadrature::gauss<R, kPoints>;
  static const std::array<GaussPoint<R>, kPoints> points = [] {
    std::array<GaussPoint<R>, kPoints> all{};
    std::size_t n = 0;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
      const R x = Rule::abscissa()[i];
      const R weight = R(0.5) * Rule::weights()[i];
      all[n++] = {R(0.5) + R(0.5) * x, weight};
      if (x != 0) all[n++] = {R(0.5) - R(0.5) * x, weight};
    }
    return all;
  }();
  return points;
}

template <class R>
R largest_magnitude(std::span<const R> values) {
  R largest = 0;
  for (const R value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// theta from psi(0) - M(0)/kr or, where the hub is hard to turn and that all but vanishes, from
/// the torque on it: M(0) + a Q(0) = hub_impedance theta at a pole.
template <class R>
R hub_angle_of(const TransferChain<R>& chain, const BeamState<R>& root, R waves) {
  const auto& arm = chain.arm();
  const R impedance = chain.beam().hub_impedance;
  const R radius = arm.hub_radius;
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
template <class R>
HubMotion<R> motion_beyond_drive(const TransferChain<R>& chain, const BeamState<R>& root, R waves) {
  const auto& arm = chain.arm();
  const R rotor = chain.beam().rotor_impedance;
  const R hub = chain.beam().hub_impedance;
  const R turning = chain.beam().drive * rotor;
  const R radius = arm.hub_radius;
  const R angle = root[kRotation] - arm.root_flexibility * root[kMoment];
  const R moment = root[kMoment] + radius * root[kForce];
  const R along_hub = 1 + turning;
  const R along_torque = hub * along_hub + rotor;
  const R by_hub = angle / along_hub;
  const R by_torque = moment / along_torque;
  const R lost_by_hub = (1 + std::abs(turning * by_hub)) / std::abs(along_hub);
  const R lost_by_torque =
      (waves + radius * radius * waves * waves * waves +
       (std::abs(hub) * (1 + std::abs(turning)) + std::abs(rotor)) * std::abs(by_torque)) /
      std::abs(along_torque);
  if (lost_by_hub <= lost_by_torque) return {angle, by_hub};
  return {along_hub * by_torque, by_torque};
}

template <class R>
HubMotion<R> hub_motion_of(const TransferChain<R>& chain, const BeamState<R>& root, R waves) {
  if (!chain.arm().has_rigid_drive()) return motion_beyond_drive(chain, root, waves);
  const R angle = hub_angle_of(chain, root, waves);
  return {angle, angle};
}

}  // namespace

template <class R>
ChainModes<R>::ChainModes(const ArmInBeamUnits<R>& arm, std::span<const R> omega_squared)
    : arm_(arm), highest_(undamped_at(arm, largest_magnitude(omega_squared))) {
  const TransferChain<R> chain(arm, highest_);
  for (const auto& link : chain.links()) {
    if (link.is_segment()) segments_.push_back(link.segment);
  }
  modes_.reserve(omega_squared.size());
  for (const R square : omega_squared) {
    Mode mode = square == 0 && arm.turns_freely() ? rigid_body_mode() : mode_at(square);
    normalise(mode);
    modes_.push_back(std::move(mode));
  }
}

template <class R>
typename ChainModes<R>::Mode ChainModes<R>::rigid_body_mode() const {
  Mode mode;
  mode.hub = {1, 1};
  const auto at_rest = undamped_at(arm_, R(0));
  for (const Segment<R>& segment : segments_) {
    mode.series.emplace_back(arm_, at_rest, segment,
                             BeamState<R>{arm_.hub_radius + segment.right, 1, 0, 0});
  }
  for (const auto& mass : arm_.carried) {
    mode.carried.push_back({arm_.hub_radius + mass.position, 0});
  }
  sample(mode);
  return mode;
}

template <class R>
CarriedMotion<R> ChainModes<R>::motion_of(const TransferChain<R>& chain, std::size_t k,
                                          const BeamState<R>& at_right,
                                          const BeamState<R>& at_left) const {
  const R y = at_right[kDisplacement];
  if (!arm_.carried[k].is_suspended()) return {y, 0};
  constexpr R kNearResonance = R(0.1);
  const CarriedMass<R>& mass = chain.masses()[k];
  if (std::abs(mass.resonance()) > kNearResonance) {
    const R extension = mass.extension(at_right) / mass.resonance();
    return {y + extension, extension};
  }
  // y all but vanishes: by the force that moves the mass.
  const R force = at_right[kForce] - at_left[kForce];
  const R displacement = force / (arm_.carried[k].mass * chain.beam().square);
  return {displacement, displacement - y};
}

template <class R>
typename ChainModes<R>::Mode ChainModes<R>::mode_at(R omega_squared) const {
  const TransferChain<R> chain(arm_, undamped_at(arm_, omega_squared), highest_);
  const auto& links = chain.links();
  // Of the right ends of all links, and of the root.
  std::vector<ScaledPlane<R>> planes = {chain.tip_plane()};
  for (const auto& link : links) {
    planes.push_back(planes.back());
    chain.to_left(link, planes.back());
  }
  std::vector<ScaledFunctional<R>> functionals(links.size() + 1);
  functionals.back() = chain.root_functional();
  for (std::size_t i = links.size(); i-- > 0;) {
    functionals[i] = functionals[i + 1];
    chain.to_right(links[i], functionals[i]);
  }
  const R log_scale = planes.back().log_scale + functionals.back().log_scale;
  const auto state_at = [&](std::size_t i) {
    auto state = state_in_plane(functionals[i].functional, planes[i].plane);
    const R factor = std::exp(planes[i].log_scale + functionals[i].log_scale - log_scale);
    for (R& value : state) value *= factor;
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
  const R waves = wave_number(arm_, chain.beam(), {1, 1});
  mode.hub = hub_motion_of(chain, state_at(links.size()), waves);
  sample(mode);
  return mode;
}

template <class R>
void ChainModes<R>::sample(Mode& mode) const {
  mode.tip = mode.series.front().at(0);
  for (const auto& series : mode.series) {
    for (const auto& point : gauss_points<R>()) {
      const auto state = series.at(point.at);
      mode.displacements.push_back(state[kDisplacement]);
      mode.rotations.push_back(state[kRotation]);
      mode.moments.push_back(state[kMoment]);
    }
  }
}

template <class R>
void ChainModes<R>::normalise(Mode& mode) const {
  const R tip = mode.tip[kDisplacement];
  const R turn = mode.tip[kRotation];
  R mass = integral(mode.displacements, mode.displacements) +
           arm_.rotary_inertia * integral(mode.rotations, mode.rotations) +
           arm_.hub_inertia * mode.hub.angle * mode.hub.angle +
           arm_.rotor_inertia * mode.hub.motor_angle * mode.hub.motor_angle +
           arm_.payload_mass * tip * tip + 2 * arm_.payload_moment * tip * turn +
           arm_.payload_inertia * turn * turn;
  for (std::size_t k = 0; k < mode.carried.size(); ++k) {
    mass += arm_.carried[k].mass * mode.carried[k].displacement * mode.carried[k].displacement;
  }
  mode.scale = std::copysign(std::sqrt(arm_.total_inertia() / mass), mode.hub.motor_angle);
  mode.hub.angle *= mode.scale;
  mode.hub.motor_angle *= mode.scale;
  mode.root_turn *= mode.scale;
  for (CarriedMotion<R>& motion : mode.carried) {
    motion.displacement *= mode.scale;
    motion.extension *= mode.scale;
  }
  for (R& value : mode.tip) value *= mode.scale;
  for (auto* values : {&mode.displacements, &mode.rotations, &mode.moments}) {
    for (R& value : *values) value *= mode.scale;
  }
}

template <class R>
R ChainModes<R>::integral(const std::vector<R>& a, const std::vector<R>& b) const {
  R sum = 0;
  std::size_t n = 0;
  for (const Segment<R>& segment : segments_) {
    for (const auto& point : gauss_points<R>()) {
      sum += segment.length * point.weight * a[n] * b[n];
      ++n;
    }
  }
  return sum;
}

template <class R>
BeamState<R> ChainModes<R>::state(std::size_t mode, R x) const {
  const auto found = std::ranges::find_if(
      segments_, [x](const Segment<R>& segment) { return segment.left() <= x; });
  const auto place = found == segments_.end() ? segments_.size() - 1
                                              : static_cast<std::size_t>(found - segments_.begin());
  const Segment<R>& segment = segments_[place];
  auto result = modes_[mode].series[place].at((segment.right - x) / segment.length);
  for (R& value : result) value *= modes_[mode].scale;
  return result;
}

template <class R>
R ChainModes<R>::tip_displacement(std::size_t mode) const {
  return modes_[mode].tip[kDisplacement];
}

template <class R>
R ChainModes<R>::displacement(std::size_t mode, R x) const {
  return state(mode, x)[kDisplacement];
}

template <class R>
R ChainModes<R>::curvature(std::size_t mode, R x) const {
  return state(mode, x)[kMoment];
}

template <class R>
R ChainModes<R>::damping(std::size_t i, std::size_t j) const {
  const Mode& a = modes_[i];
  const Mode& b = modes_[j];
  R sum = arm_.hub_friction * a.hub.motor_angle * b.hub.motor_angle;
  if (arm_.drive_retardation > 0) {
    sum += arm_.drive_retardation / arm_.drive_flexibility * (a.hub.motor_angle - a.hub.angle) *
           (b.hub.motor_angle - b.hub.angle);
  }
  if (arm_.root_retardation > 0) {
    sum += arm_.root_retardation / arm_.root_flexibility * a.root_turn * b.root_turn;
  }
  for (std::size_t k = 0; k < arm_.carried.size(); ++k) {
    sum += arm_.carried[k].mass * arm_.carried[k].damping * a.carried[k].extension *
           b.carried[k].extension;
  }
  if (arm_.kelvin_voigt > 0) sum += arm_.kelvin_voigt * integral(a.moments, b.moments);
  if (arm_.air_damping > 0) sum += arm_.air_damping * integral(a.displacements, b.displacements);
  return sum / arm_.total_inertia();
}

template class ChainModes<Real>;
template class ChainModes<double>;

}  // namespace flexarm::exact_tf
