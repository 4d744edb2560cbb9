#include "exact_tf/boundary_values.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

template <std::size_t N, class T>
RealOf<T> norm_of(const std::array<T, N>& values) {
  RealOf<T> sum = 0;
  for (const T& value : values) sum += std::norm(value);
  return std::sqrt(sum);
}

/// Times the D of all suspended masses, none of which is near 0: y(l) - (a + l) theta from the
/// departure V of the plane's two states from the rigid rod's
/// (1, 0, 0, 0) and (x - 1, 1, 0, 0). With f1 = psi - M/kr, f2 = y - a f1 taken at the root and
/// c = (1 + a - f2 V2, 1 + f2 V1), the motion is V c and the rigid one, and the deflection
///
///     -f2 V2 - (1 + a) (f2 V1 + f1 V c).
template <class T>
T slight_deflection(const TransferChain<T>& chain) {
  auto departure = chain.tip_states();
  departure[0][kDisplacement] = departure[1][kRotation] = T(0);
  T resonances(1);
  for (const auto& link : chain.links()) {
    const RealOf<T> from_tip = 1 - link.segment.right;
    if (link.mass) {
      const auto& mass = chain.masses()[*link.mass];
      const T inverse = RealOf<T>(1) / mass.resonance();
      resonances *= mass.resonance();
      const std::array<BeamState<T>, 2> rigid = {
          {{T(1), T(0), T(0), T(0)}, {T(-from_tip), T(1), T(0), T(0)}}};
      for (std::size_t k = 0; k < 2; ++k) {
        BeamState<T> whole = rigid[k];
        for (std::size_t i = 0; i < 4; ++i) whole[i] += departure[k][i];
        const auto passed = mass.to_left(whole);
        departure[k][kMoment] = inverse * passed[kMoment];
        departure[k][kForce] = inverse * passed[kForce];
      }
      continue;
    }
    const auto transfer = chain.transfer(link);
    std::array<BeamState<T>, 2> next{};
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < 4; ++j) {
          next[k][i] += transfer.columns[j][i] * departure[k][j];
        }
      }
      next[0][i] += transfer.bending[0][i];
      next[1][i] += transfer.bending[1][i] - from_tip * transfer.bending[0][i];
    }
    departure = next;
  }
  const RealOf<T> radius = chain.arm().hub_radius;
  const T& flexibility = chain.beam().root;
  const auto f1 = [&](const BeamState<T>& v) { return v[kRotation] - flexibility * v[kMoment]; };
  const auto f2 = [&](const BeamState<T>& v) { return v[kDisplacement] - radius * f1(v); };
  const T along_first = f2(departure[0]);
  const T along_second = f2(departure[1]);
  const RealOf<T> reach = 1 + radius;
  const T root_rotation =
      (reach - along_second) * f1(departure[0]) + (RealOf<T>(1) + along_first) * f1(departure[1]);
  return resonances * (-along_second - reach * (along_first + root_rotation));
}

template <class T>
SensorValue<T> tip_value(const TransferChain<T>& chain) {
  const auto functional = chain.tip_functional();
  const auto state = state_in_plane(functional.functional, chain.tip_plane().plane);
  return {state[kDisplacement], functional.log_scale, norm_of(functional.functional)};
}

template <class T>
SensorValue<T> deflection_value(const TransferChain<T>& chain, const RootValues<T>& root) {
  // Up to here no term of either form outgrows the others.
  constexpr RealOf<T> kSlightGrowth = 3;
  constexpr RealOf<T> kFarFromResonance = 0.5;
  const bool resonates = std::ranges::any_of(chain.masses(), [](const auto& mass) {
    return std::abs(mass.resonance()) < kFarFromResonance;
  });
  if (chain.growth() <= kSlightGrowth && !resonates) {
    return {slight_deflection(chain), RealOf<T>(0), root.size};
  }
  const auto tip = tip_value(chain);
  const RealOf<T> log_scale = std::max(root.log_scale, tip.log_scale);
  const RealOf<T> root_factor = std::exp(root.log_scale - log_scale);
  const RealOf<T> tip_factor = std::exp(tip.log_scale - log_scale);
  const RealOf<T> reach = 1 + chain.arm().hub_radius;
  return {tip_factor * tip.value - reach * root_factor * root.hub_angle, log_scale,
          tip_factor * tip.size + root_factor * root.size};
}

template <class T>
SensorValue<T> curvature_value(const TransferChain<T>& chain, RealOf<T> x) {
  const auto& links = chain.links();
  const std::size_t place = link_at(chain, x);
  auto plane = chain.tip_plane();
  for (std::size_t i = 0; i < place; ++i) chain.to_left(links[i], plane);
  auto functional = chain.root_functional();
  for (std::size_t i = links.size(); i-- > place;) chain.to_right(links[i], functional);
  const Segment<RealOf<T>>& segment = links[place].segment;
  const SegmentSeries<T> series(chain.arm(), chain.beam(), segment,
                                state_in_plane(functional.functional, plane.plane));
  const auto state = series.at((segment.right - x) / segment.length);
  const RealOf<T> log_scale = plane.log_scale + functional.log_scale;
  // Sizes here would jump with the cuts between segments; that at the root does not.
  for (std::size_t i = place; i < links.size(); ++i) chain.to_left(links[i], plane);
  return {chain.beam().flexibility * state[kMoment], log_scale,
          norm_of(plane.plane.minors) * std::exp(plane.log_scale - log_scale)};
}

}  // namespace

template <class T>
RootValues<T> root_values(const TransferChain<T>& chain, const Bivector<T>& p,
                          RealOf<T> log_scale) {
  const RealOf<T> radius = chain.arm().hub_radius;
  const T& flexibility = chain.beam().root;
  const T hub_angle = p.displacement_rotation() - flexibility * p.displacement_moment();
  const T passed_on = chain.beam().hub_impedance * hub_angle - p.displacement_moment() +
                      radius * (p.rotation_moment() - p.displacement_force() +
                                radius * (p.rotation_force() - flexibility * p.moment_force()));
  const T motor_angle = hub_angle + chain.beam().drive * passed_on;
  const T torque = passed_on + chain.beam().rotor_impedance * motor_angle;
  return {hub_angle, motor_angle, torque, log_scale, norm_of(p.minors)};
}

template <class T>
RootValues<T> root_values(const TransferChain<T>& chain) {
  const auto root = chain.root_plane();
  return root_values(chain, root.plane, root.log_scale);
}

template <class T>
SensorValue<T> sensor_value(const TransferChain<T>& chain, arm::SensorKind kind, RealOf<T> position,
                            const std::optional<RootValues<T>>& known_root) {
  const auto at_root = [&] { return known_root ? *known_root : root_values(chain); };
  switch (kind) {
    case arm::SensorKind::hub_angle:
    case arm::SensorKind::hub_velocity: {
      const auto root = at_root();
      return {root.motor_angle, root.log_scale, root.size};
    }
    case arm::SensorKind::tip_displacement:
    case arm::SensorKind::tip_acceleration:
      return tip_value(chain);
    case arm::SensorKind::tip_deflection:
      return deflection_value(chain, at_root());
    case arm::SensorKind::strain:
      return curvature_value(chain, position);
  }
  throw std::logic_error("sensor kind outside its enumeration");
}

template <class T>
std::size_t link_at(const TransferChain<T>& chain, RealOf<T> x) {
  const auto& links = chain.links();
  const auto found = std::ranges::find_if(
      links, [x](const auto& link) { return link.is_segment() && link.segment.left() <= x; });
  if (found != links.end()) return static_cast<std::size_t>(found - links.begin());
  // Rounding has left x before the last segment, behind which a mass at the root may come.
  const auto last = std::find_if(links.rbegin(), links.rend(),
                                 [](const auto& link) { return link.is_segment(); });
  return static_cast<std::size_t>(std::distance(last, links.rend())) - 1;
}

template RootValues<Real> root_values(const TransferChain<Real>&, const Bivector<Real>&, Real);
template RootValues<Complex> root_values(const TransferChain<Complex>&, const Bivector<Complex>&,
                                         Real);
template RootValues<double> root_values(const TransferChain<double>&, const Bivector<double>&,
                                        double);
template RootValues<std::complex<double>> root_values(const TransferChain<std::complex<double>>&,
                                                      const Bivector<std::complex<double>>&,
                                                      double);
template RootValues<Real> root_values(const TransferChain<Real>&);
template RootValues<Complex> root_values(const TransferChain<Complex>&);
template RootValues<double> root_values(const TransferChain<double>&);
template RootValues<std::complex<double>> root_values(const TransferChain<std::complex<double>>&);
template SensorValue<Real> sensor_value(const TransferChain<Real>&, arm::SensorKind, Real,
                                        const std::optional<RootValues<Real>>&);
template SensorValue<Complex> sensor_value(const TransferChain<Complex>&, arm::SensorKind, Real,
                                           const std::optional<RootValues<Complex>>&);
template SensorValue<double> sensor_value(const TransferChain<double>&, arm::SensorKind, double,
                                          const std::optional<RootValues<double>>&);
template SensorValue<std::complex<double>> sensor_value(
    const TransferChain<std::complex<double>>&, arm::SensorKind, double,
    const std::optional<RootValues<std::complex<double>>>&);
template std::size_t link_at(const TransferChain<Real>&, Real);
template std::size_t link_at(const TransferChain<Complex>&, Real);
template std::size_t link_at(const TransferChain<double>&, double);
template std::size_t link_at(const TransferChain<std::complex<double>>&, double);

}  // namespace flexarm::exact_tf
