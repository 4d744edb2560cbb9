#pragma once

#include "exact_tf/segment_series.hpp"

#include <array>

namespace flexarm::exact_tf {

/// Pairs of state components in the order of a bivector's coordinates.
inline constexpr std::array<std::array<std::size_t, 2>, 6> kPairs = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

/// A plane of states spanned by a and b, by the minors a_i b_j - a_j b_i of `kPairs` (Pluecker
/// coordinates). Propagating the minors instead of a and b keeps apart what rounding would make
/// parallel: both grow as the fastest exponential, the plane does not.
template <class T>
struct Bivector {
  std::array<T, 6> minors{};

  const T& displacement_rotation() const { return minors[0]; }
  const T& displacement_moment() const { return minors[1]; }
  const T& displacement_force() const { return minors[2]; }
  const T& rotation_moment() const { return minors[3]; }
  const T& rotation_force() const { return minors[4]; }
  const T& moment_force() const { return minors[5]; }
};

/// The state of the plane at which the functional g vanishes: (g b) a - (g a) b up to sign, in
/// coordinates v_i = sum_j g_j p_ji.
template <class T>
BeamState<T> state_in_plane(const BeamState<T>& functional, const Bivector<T>& plane) {
  BeamState<T> state{};
  for (std::size_t k = 0; k < 6; ++k) {
    const auto [i, j] = kPairs[k];
    state[j] += functional[i] * plane.minors[k];
    state[i] -= functional[j] * plane.minors[k];
  }
  return state;
}

/// How a transfer matrix acts on bivectors: its second compound, the matrix of its 2 x 2 minors.
template <class T>
using Compound = std::array<std::array<T, 6>, 6>;

template <class T>
Compound<T> compound_of(const std::array<BeamState<T>, 4>& columns) {
  Compound<T> compound;
  for (std::size_t to = 0; to < 6; ++to) {
    const auto [i, j] = kPairs[to];
    for (std::size_t from = 0; from < 6; ++from) {
      const auto& a = columns[kPairs[from][0]];
      const auto& b = columns[kPairs[from][1]];
      compound[to][from] = a[i] * b[j] - a[j] * b[i];
    }
  }
  return compound;
}

template <class T>
Bivector<T> operator*(const Compound<T>& compound, const Bivector<T>& plane) {
  Bivector<T> result;
  for (std::size_t to = 0; to < 6; ++to) {
    T sum{};
    for (std::size_t from = 0; from < 6; ++from) sum += compound[to][from] * plane.minors[from];
    result.minors[to] = sum;
  }
  return result;
}

}  // namespace flexarm::exact_tf
