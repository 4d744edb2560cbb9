#include "fem/mesh.hpp"

#include "arm/input_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace flexarm::fem {

namespace {

std::vector<double> lengths_between(const std::vector<double>& nodes_m, double beam_length_m) {
  if (nodes_m.size() < 2 || nodes_m.front() != 0.0 || nodes_m.back() != beam_length_m) {
    throw arm::InputError(fmt::format(
        "mesh.nodes: must start at 0 m and end at the beam's length, {} m", beam_length_m));
  }
  if (nodes_m.size() - 1 > static_cast<std::size_t>(kMostElements)) {
    throw arm::InputError(fmt::format("mesh.nodes: must be {} or fewer", kMostElements + 1));
  }
  std::vector<double> lengths;
  lengths.reserve(nodes_m.size() - 1);
  for (std::size_t i = 1; i < nodes_m.size(); ++i) {
    lengths.push_back((nodes_m[i] - nodes_m[i - 1]) / beam_length_m);
  }
  return lengths;
}

/// How many elements lie between element `e` and the end towards which the mesh is fine.
int distance_to_fine_end(int e, int elements, Grading grading) {
  const int from_tip = elements - 1 - e;
  switch (grading) {
    case Grading::uniform:
      return 0;
    case Grading::towards_root:
      return e;
    case Grading::towards_tip:
      return from_tip;
    case Grading::towards_both:
      return std::min(e, from_tip);
  }
  return 0;
}

}  // namespace

std::vector<double> element_lengths(const MeshOptions& options, double beam_length_m) {
  std::vector<double> lengths;
  if (!options.nodes_m.empty()) {
    lengths = lengths_between(options.nodes_m, beam_length_m);
  } else {
    if (options.elements < 1 || options.elements > kMostElements) {
      throw arm::out_of_range("mesh.elements", options.elements, "",
                              fmt::format("1 to {}", kMostElements));
    }
    if (!(options.grading_ratio >= 1.0 && std::isfinite(options.grading_ratio))) {
      throw arm::out_of_range("mesh.grading_ratio", options.grading_ratio, "",
                              "a finite number, 1 or more");
    }
    lengths.reserve(static_cast<std::size_t>(options.elements));
    for (int e = 0; e < options.elements; ++e) {
      lengths.push_back(std::pow(options.grading_ratio,
                                 distance_to_fine_end(e, options.elements, options.grading)));
    }
    const double sum = std::reduce(lengths.begin(), lengths.end());
    for (double& length : lengths) length /= sum;
  }
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  if (!(shortest >= kShortestElement)) {
    throw arm::out_of_range("mesh: shortest element", shortest, "of the beam's length",
                            fmt::format("{} or more", kShortestElement));
  }
  return lengths;
}

namespace {

/// The elements with a share in the part from `from` to `to`, compressed to it.
std::vector<double> part_of(const std::vector<double>& lengths, double from, double to) {
  constexpr double kNegligible = 1e-6;
  std::vector<double> part;
  double left = 0.0;
  for (std::size_t e = 0; e < lengths.size(); ++e) {
    const double right = e + 1 < lengths.size() ? left + lengths[e] : 1.0;
    if (std::min(right, to) - std::max(left, from) > kNegligible * lengths[e]) {
      part.push_back(lengths[e]);
    }
    left = right;
  }
  if (part.empty()) part.push_back(1.0);
  const double sum = std::reduce(part.begin(), part.end());
  for (double& length : part) length *= (to - from) / sum;
  return part;
}

}  // namespace

SplitMesh split_mesh(const std::vector<double>& lengths, std::span<const double> positions) {
  SplitMesh split;
  double from = 0.0;
  const auto append = [&](double to) {
    const std::vector<double> part = part_of(lengths, from, to);
    split.lengths.insert(split.lengths.end(), part.begin(), part.end());
    from = to;
  };
  for (const double position : positions) {
    append(position);
    split.before.push_back(static_cast<int>(split.lengths.size()));
  }
  append(1.0);
  return split;
}

}  // namespace flexarm::fem
