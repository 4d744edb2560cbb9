#pragma once

#include "measured/checks/data_check_relation.hpp"
#include "measured/checks/data_check_signal.hpp"
#include "measured/checks/described_arm.hpp"

#include <complex>
#include <cstddef>
#include <span>
#include <vector>

namespace flexarm::measured {

/// Scale, sign and delay of signal `a` over those of signal `b`, each over what it must be by what
/// the described arm reads for the same torque.
struct DescribedRelation {
  std::size_t a = 0;
  std::size_t b = 0;  ///< below a; 0: the torque
  GainFit fit;
};

/// What the described arm reads in the place of an even stretch of signals, the torque first, and
/// how all pairs of them are related to it. With X recorded and Y described
///
///     X_a/X_b = gain exp(-i omega delay) Y_a/Y_b,  so  X_a Y_b = gain exp(-i omega delay) X_b Y_a.
///
/// Between two sensors this holds whatever turns the hub: neither friction, a wrong torque nor what
/// the file says of the hub has an influence. Between a sensor and the torque they have one.
/// Displacements are taken in their second derivatives, velocities in their first. Empty where no
/// arm is described.
struct DescribedStretch {
  std::vector<std::vector<double>> values;  ///< one a signal, the torque first
  std::vector<DescribedRelation> relations;

  /// `recorded` are the transforms of `signals`.
  DescribedStretch(std::span<const CheckedSignal> signals, const Transforms& recorded,
                   const DescribedArm& arm);
};

/// Blocks of frequencies that a distance counts.
enum class CountedBlocks {
  all,
  coherent,  ///< those in which both recorded signals are coherent: the others hold noise
};

/// The lines of a record's signals, for distances from many arms.
class RecordedLines {
 public:
  /// `recorded` are the transforms of `signals`; both must outlive the object.
  RecordedLines(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
                const Transforms& recorded, CountedBlocks counted);

  /// Returns the mean `distance` of both sides of these relations of all usable pairs; 1 without
  /// any, and for an arm that reads nothing.
  double distance_from(const DescribedArm& arm) const;

 private:
  using Lines = std::vector<std::complex<double>>;
  struct Pair {
    std::size_t a = 0;
    std::size_t b = 0;
    std::vector<bool> counted;  ///< one a block; empty: all
  };

  std::span<const CheckedSignal> signals_;
  const Transforms* recorded_;
  std::vector<Lines> lines_;  ///< one a signal
  std::vector<Pair> pairs_;
};

/// Returns the distance of a record from one arm, with all blocks.
double described_distance(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
                          const Transforms& recorded, const DescribedArm& arm);

}  // namespace flexarm::measured
