#include "tests/trials/beam_element.hpp"

#include <array>

namespace flexarm::trials {

namespace {

/// Lagrange's polynomial of node `i` at s, and its derivative.
template <std::size_t Size>
std::array<double, 2> lagrange(const std::array<double, Size>& nodes, std::size_t i, double s) {
  double value = 1.0;
  double derivative = 0.0;
  for (std::size_t j = 0; j < Size; ++j) {
    if (j == i) continue;
    const double gap = nodes[i] - nodes[j];
    derivative = (derivative * (s - nodes[j]) + value) / gap;
    value *= (s - nodes[j]) / gap;
  }
  return {value, derivative};
}

ElementShapes hermite(double h, double s) {
  ElementShapes shapes;
  shapes.deflection =
      Eigen::Vector4d{(1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s), h * s * (1.0 - s) * (1.0 - s),
                      s * s * (3.0 - 2.0 * s), h * s * s * (s - 1.0)};
  shapes.slope = Eigen::Vector4d{6.0 * s * (s - 1.0) / h, (1.0 - s) * (1.0 - 3.0 * s),
                                 6.0 * s * (1.0 - s) / h, s * (3.0 * s - 2.0)};
  shapes.rotation = shapes.slope;
  shapes.curvature = Eigen::Vector4d{6.0 * (2.0 * s - 1.0) / h, 6.0 * s - 4.0,
                                     6.0 * (1.0 - 2.0 * s) / h, 6.0 * s - 2.0} /
                     h;
  return shapes;
}

ElementShapes timoshenko(double h, double s) {
  constexpr std::array<double, 4> kDeflectionNodes = {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0};
  constexpr std::array<Eigen::Index, 4> kDeflectionEntries = {0, 2, 3, 5};
  constexpr std::array<double, 3> kRotationNodes = {0.0, 0.5, 1.0};
  constexpr std::array<Eigen::Index, 3> kRotationEntries = {1, 4, 6};
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(element_size(true));
  ElementShapes shapes{zero, zero, zero, zero};
  for (std::size_t i = 0; i < kDeflectionNodes.size(); ++i) {
    const auto [value, derivative] = lagrange(kDeflectionNodes, i, s);
    shapes.deflection(kDeflectionEntries[i]) = value;
    shapes.slope(kDeflectionEntries[i]) = derivative / h;
  }
  for (std::size_t i = 0; i < kRotationNodes.size(); ++i) {
    const auto [value, derivative] = lagrange(kRotationNodes, i, s);
    shapes.rotation(kRotationEntries[i]) = value;
    shapes.curvature(kRotationEntries[i]) = derivative / h;
  }
  return shapes;
}

}  // namespace

ElementShapes element_shapes(bool with_shear, double length_m, double part) {
  return with_shear ? timoshenko(length_m, part) : hermite(length_m, part);
}

int element_size(bool with_shear) {
  return with_shear ? 7 : 4;
}

}  // namespace flexarm::trials
