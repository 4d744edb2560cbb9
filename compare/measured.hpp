#pragma once

#include "arm/formulation.hpp"
#include "compare/comparison.hpp"
#include "measured/files/modal_table.hpp"

#include <optional>
#include <vector>

namespace flexarm::compare {

/// A measured pole or zero beside the model's.
struct MeasuredRow {
  measured::ModalEntry measured;
  std::optional<int> order;  ///< as stated, or assigned (compare/root_numbering.hpp)
  /// The model's frequency for the same feature and order. A measured zero is an antiresonance, so
  /// zeros are counted along the imaginary axis; empty where the model has no such zero.
  std::optional<double> model_frequency_Hz;
  /// 100 (measured - model)/model; NaN when either is unknown.
  double error_percent = 0.0;
};

/// Looks each measured feature up among the roots of the comparison's first model, which has zeros
/// of the sensors compared only (see `sensors_with_zeros`).
std::vector<MeasuredRow> beside_model(const measured::ModalTable& measured,
                                      const Comparison& comparison);

/// The sensors whose zeros appear in a measured table, each once, in their order.
std::vector<arm::Sensor> sensors_with_zeros(const measured::ModalTable& measured);

}  // namespace flexarm::compare
