#pragma once

#include "arm/arm.hpp"
#include "arm/sensor.hpp"
#include "compare/measured.hpp"

#include <complex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::compare {

/// Modal assurance criterion of two mode shapes of one length [AllemangBrown1982],
///
///     MAC(a, b) = |a^H b|^2/((a^H a)(b^H b)),
///
/// from 0 (orthogonal) to 1 (one is a complex multiple of the other). NaN where a shape is 0.
double mac(std::span<const std::complex<double>> a, std::span<const std::complex<double>> b);

/// A mode shape that was measured at two sensors or more.
struct MeasuredShape {
  int order = 1;                       ///< of its pole
  std::optional<double> frequency_Hz;  ///< of the first row that states one
  std::vector<arm::Sensor> sensors;
  std::vector<std::complex<double>> values;  ///< one a sensor, before time derivatives
};

/// Measured mode shapes against those computed at the same sensors.
///
/// Values of unlike quantities (rad, m, strain) have no common scale. Measured and computed values
/// of a quantity are divided by the root-mean-square of the first model's in it, over the sensors
/// and the modes compared. Where a shape has one quantity alone, this leaves the MAC as it is.
struct ShapeCorrelation {
  std::vector<MeasuredShape> measured;
  std::vector<double> model_frequencies_Hz;           ///< of the computed modes, by the first model
  std::vector<std::string> models;                    ///< as Comparison::subjects
  std::vector<std::vector<std::vector<double>>> mac;  ///< [model][measured][computed]
  /// The largest MAC of two different computed modes at the sensors of a measured shape: near 1
  /// these sensors do not tell the modes apart.
  double largest_auto_mac = 0.0;
};

/// The shapes among rows of one measured table; empty where no mode has two values. Computed are
/// the modes up to two beyond the highest measured one, at most those of the comparison.
std::optional<ShapeCorrelation> correlate_shapes(const std::vector<MeasuredRow>& rows,
                                                 const Comparison& comparison);

}  // namespace flexarm::compare
