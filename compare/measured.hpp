#pragma once

#include "arm/formulation.hpp"
#include "compare/comparison.hpp"
#include "measured/files/modal_table.hpp"

#include <limits>
#include <optional>
#include <vector>

namespace flexarm::compare {

/// A measured pole or zero beside the models'. Numbers that are not known are empty or NaN.
struct MeasuredRow {
  measured::ModalEntry measured;
  std::optional<int> order;  ///< as stated, or assigned (compare/root_numbering.hpp)
  /// The first model's natural frequency |s|/2 pi of the damped root of the same feature and order,
  /// which is what is measured. A measured zero is an antiresonance, so zeros are counted along the
  /// imaginary axis of the undamped arm; empty where the model has no such zero.
  std::optional<double> model_frequency_Hz;
  std::optional<double> undamped_Hz = {};  ///< the first model's, without damping
  /// 100 (measured - model)/model of the first model.
  double error_percent = std::numeric_limits<double>::quiet_NaN();
  std::vector<std::optional<double>> frequencies_Hz;  ///< [model]
  /// [model], (measured - model)/standard deviation of the measured frequency.
  std::vector<double> deviations;
  /// Standard deviation of the first model's frequency that the uncertain numbers of the arm file
  /// make, to first order; empty where the file states none.
  std::optional<double> model_std_Hz;
  /// (measured - model)/root of the sum of both variances; a measurement without a standard
  /// deviation counts as exact. NaN where neither states one.
  double combined_deviation = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> model_damping_ratio;  ///< of the first model's damped root
  /// (measured - model)/standard deviation of the measured damping ratio.
  double damping_deviation = std::numeric_limits<double>::quiet_NaN();
};

/// Looks each measured feature up among the roots of the comparison's models, which have zeros of
/// the sensors compared only (see `sensors_with_zeros`).
std::vector<MeasuredRow> beside_model(const measured::ModalTable& measured,
                                      const Comparison& comparison);

/// The sensors whose zeros appear in a measured table, each once, in their order.
std::vector<arm::Sensor> sensors_with_zeros(const measured::ModalTable& measured);

}  // namespace flexarm::compare
