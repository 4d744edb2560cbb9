#pragma once

#include <vector>

namespace flexarm::fem {

/// Where a graded mesh has its short elements.
enum class Grading { uniform, towards_root, towards_tip, towards_both };

/// The finest mesh that the accuracy of fem is measured on; a matrix of the highest degree on it
/// still fits into a small machine's memory.
inline constexpr int kMostElements = 100'000;

/// How the beam is divided into elements.
struct MeshOptions {
  int elements = 4;  ///< 1 to kMostElements
  Grading grading = Grading::uniform;
  /// Length of an element over that of its shorter neighbour, 1 or more; unused where uniform.
  double grading_ratio = 1.5;
  /// Ends of the elements, root and tip included, ascending from 0 to the beam's length; when not
  /// empty it replaces the three values above.
  std::vector<double> nodes_m = {};
};

/// The shortest element allowed, as a part of the beam's length.
inline constexpr double kShortestElement = 1e-9;

/// Lengths of the elements from root to tip as parts of the beam's length, their sum 1. Throws
/// arm::InputError for options out of their range.
std::vector<double> element_lengths(const MeshOptions& options, double beam_length_m);

/// A mesh with a node at a given place.
struct SplitMesh {
  std::vector<double> lengths;
  int before = 0;  ///< elements from the root to that node
};

/// Divides a mesh at `position`, above 0 and below 1. Both parts keep the elements that they have a
/// share in and are compressed to their own length: no element grows, and none becomes a sliver
/// unless the part itself is one. There is one element more, or none more where a node lies within
/// 10^-6 of the element there.
SplitMesh split_mesh(const std::vector<double>& lengths, double position);

}  // namespace flexarm::fem
