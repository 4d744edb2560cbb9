#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/page/page_document.hpp"

#include <string>
#include <vector>

namespace flexarm::report::page {

/// A channel of a diagnosed experiment: measured and simulated, and how far apart. It refers to the
/// experiment and the diagnosis.
struct DiagnosedChannel {
  const measured::MeasuredRun* run = nullptr;
  const diagnose::Overlay* overlay = nullptr;
  const diagnose::Gain* error = nullptr;
  std::string sensor;                   ///< in words; "torque" of a controller
  std::string unit;                     ///< printed
  std::vector<std::size_t> left_out{};  ///< readings that are none

  /// Measured, with gaps for readings that are none.
  std::vector<double> measured() const;
  /// Measured minus simulated, with the same gaps.
  std::vector<double> residual(const std::vector<double>& simulated) const;
  /// "fit before", "fit after", in per cent as `compare` of MATLAB's System Identification Toolbox
  /// has them, and the noise floor.
  std::vector<Fact> facts(bool has_causes) const;
};

/// Those of the runs of a kind, the one whose NRMSE without causes is furthest above the noise
/// floor first.
std::vector<DiagnosedChannel> diagnosed_channels(const diagnose::Experiment& experiment,
                                                 const diagnose::Diagnosis& diagnosis,
                                                 measured::RunKind kind);

/// Legends of the simulations before and after.
inline constexpr const char* kBeforeLabel = "simulated, arm file";
inline constexpr const char* kAfterLabel = "simulated, extended arm";

}  // namespace flexarm::report::page
