#pragma once

#include <span>
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

/// A mesh with nodes at given places.
struct SplitMesh {
  std::vector<double> lengths;
  std::vector<int> before;  ///< elements from the root to each of these nodes
};

/// Divides a mesh at `positions`, above 0 and below 1, ascending and different. Each part keeps the
/// elements that it has a share in and is compressed to its own length: no element grows, and none
/// becomes a sliver unless the part itself is one. There is one element more for each place, or
/// none more where a node lies within 10^-6 of the element there.
SplitMesh split_mesh(const std::vector<double>& lengths, std::span<const double> positions);

}  // namespace flexarm::fem
