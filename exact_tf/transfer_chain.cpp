#include "exact_tf/transfer_chain.hpp"

#include "exact_tf/varying_segment.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace flexarm::exact_tf {

namespace {

constexpr double kLongestSegment = 3.0;
constexpr double kLargestStretch = 0.25;
constexpr double kMostSegments = 1e6;

/// Beyond this a factor is taken out; products of two such numbers are still held.
template <class R>
constexpr R kLarge = 1e100;
template <>
constexpr Real kLarge<Real> = 1e1000L;

template <std::size_t N, class T>
void keep_in_range(std::array<T, N>& values, RealOf<T>& log_scale) {
  constexpr RealOf<T> kLargest = kLarge<RealOf<T>>;
  const bool large = std::ranges::any_of(values, [](const T& value) {
    return std::abs(real_part(value)) > kLargest || std::abs(imaginary_part(value)) > kLargest;
  });
  if (!large) return;
  for (T& value : values) value *= 1 / kLargest;
  log_scale += std::log(kLargest);
}

}  // namespace

template <class T>
TransferChain<T>::TransferChain(const ArmInBeamUnits<R>& arm, const BeamAtFrequency<T>& beam,
                                bool with_planes)
    : arm_(arm), beam_(beam), with_planes_(with_planes) {
  cut(beam);
}

template <class T>
TransferChain<T>::TransferChain(const ArmInBeamUnits<R>& arm, const BeamAtFrequency<T>& beam,
                                const BeamAtFrequency<T>& cut_for)
    : arm_(arm), beam_(beam), with_planes_(true) {
  cut(cut_for);
}

template <class T>
void TransferChain<T>::cut(const BeamAtFrequency<T>& cut_for) {
  for (const auto& mass : arm_.carried) masses_.emplace_back(arm_, beam_, mass);
  R right = 1;
  const auto cut_at = [&](R place) {
    if (place < right) add_piece(cut_for, place, right);
    right = place;
  };
  std::size_t left = masses_.size();
  const auto add_masses_from = [&](R place) {
    for (; left > 0 && arm_.carried[left - 1].position >= place; --left) {
      cut_at(arm_.carried[left - 1].position);
      links_.push_back({.segment = {right, 0}, .mass = left - 1});
    }
  };
  if (arm_.crack_position) {
    add_masses_from(*arm_.crack_position);
    cut_at(*arm_.crack_position);
    links_.push_back({{right, 0}, true, share(crack_transfer<T>(arm_))});
  }
  add_masses_from(R(0));
  cut_at(R(0));
}

template <class T>
std::size_t TransferChain<T>::share(const SegmentTransfer<T>& columns) {
  transfers_.push_back({columns, {}});
  if (with_planes_) transfers_.back().compound = compound_of(columns.columns);
  return transfers_.size() - 1;
}

template <class T>
void TransferChain<T>::add_piece(const BeamAtFrequency<T>& cut_for, R left, R right) {
  const R shear = arm_.shear_flexibility;
  const R length = right - left;
  const R tension = arm_.tension(right);
  const R stretch = 1 + shear * std::min({R(0), tension + arm_.gravity * length, tension});
  const R waves = wave_number(arm_, cut_for, {right, length}) * length;
  const R wanted = std::max(waves / (kLongestSegment * std::sqrt(stretch)),
                            shear * std::abs(arm_.gravity) * length / (kLargestStretch * stretch));
  if (!(wanted < kMostSegments)) throw std::domain_error("exact_tf: s is too near to -1/kv");
  growth_ += waves;
  const long count = std::max(1L, std::lround(std::ceil(wanted)));
  const R step = length / static_cast<R>(count);
  std::optional<std::size_t> shared;
  if (arm_.gravity == 0) shared = share(segment_transfer(arm_, beam_, {right, step}));
  for (long i = 0; i < count; ++i) {
    Segment<R> segment{right - static_cast<R>(i) * step, step};
    if (i + 1 == count) segment.length = segment.right - left;
    links_.push_back({segment, false, shared});
  }
}

template <class T>
SegmentTransfer<T> TransferChain<T>::transfer(const Link& link) const {
  return link.shared ? transfers_[*link.shared].columns
                     : segment_transfer(arm_, beam_, link.segment);
}

template <class T>
std::array<BeamState<T>, 2> TransferChain<T>::tip_states() const {
  const T square = beam_.square;
  const T coupling = -square * arm_.payload_moment;
  return {{{T(1), T(0), coupling, -square * arm_.payload_mass},
           {T(0), T(1), -square * arm_.payload_inertia - T(arm_.gravity * arm_.payload_moment),
            coupling}}};
}

template <class T>
ScaledPlane<T> TransferChain<T>::tip_plane() const {
  const auto [a, b] = tip_states();
  ScaledPlane<T> result;
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    result.plane.minors[k] = a[i] * b[j] - a[j] * b[i];
  }
  return result;
}

template <class T>
ScaledFunctional<T> TransferChain<T>::root_functional() const {
  const R radius = arm_.hub_radius;
  return {{T(1), T(-radius), radius * beam_.root, T(0)}, R(0)};
}

template <class T>
void TransferChain<T>::to_left(const Link& link, ScaledPlane<T>& plane) const {
  if (link.mass) {
    plane.plane = masses_[*link.mass].to_left(plane.plane);
  } else {
    plane.plane = link.shared ? transfers_[*link.shared].compound * plane.plane
                              : plane_at_left(arm_, beam_, link.segment, plane.plane);
  }
  keep_in_range(plane.plane.minors, plane.log_scale);
}

template <class T>
void TransferChain<T>::to_right(const Link& link, ScaledFunctional<T>& functional) const {
  if (link.mass) {
    functional.functional = masses_[*link.mass].to_right(functional.functional);
  } else if (link.shared) {
    const auto& columns = transfers_[*link.shared].columns.columns;
    BeamState<T> result{};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t i = 0; i < 4; ++i) result[j] += functional.functional[i] * columns[j][i];
    }
    functional.functional = result;
  } else {
    functional.functional = functional_at_right(arm_, beam_, link.segment, functional.functional);
  }
  keep_in_range(functional.functional, functional.log_scale);
}

template <class T>
ScaledPlane<T> TransferChain<T>::root_plane() const {
  ScaledPlane<T> plane = tip_plane();
  for (const auto& link : links_) to_left(link, plane);
  return plane;
}

template <class T>
ScaledFunctional<T> TransferChain<T>::tip_functional() const {
  ScaledFunctional<T> functional = root_functional();
  for (auto link = links_.rbegin(); link != links_.rend(); ++link) to_right(*link, functional);
  return functional;
}

template class TransferChain<Real>;
template class TransferChain<Complex>;
template class TransferChain<double>;
template class TransferChain<std::complex<double>>;

}  // namespace flexarm::exact_tf
