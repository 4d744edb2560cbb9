#pragma once

#include "report/tables/identified_root_tables.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// Sentences on the poles that two methods do not agree on: circles and responses beside the
/// rational fit, or responses beside circles where there is no fit. One a pole for its frequency,
/// off by kLeastFrequency and kSureDifference standard errors of both, or by kMostFrequency; one
/// for its damping ratio, off by kLeastDamping and kSureDifference standard errors. Each states the
/// estimate that is furthest off. That of the damping ratio names the likely reason as far as the
/// data speak for one: the window of the spectra, distortion, or residuals that are no noise.
std::vector<std::string> method_differences(const IdentifiedData& data);

/// A pole of a reading that `method_differences` states, or counts among those that differ as
/// surely.
struct DifferingPole {
  const measured::ModalReading* reading = nullptr;
  int order = 0;
  bool is_damping = false;  ///< in its damping ratio, else in its frequency
};
std::vector<DifferingPole> differing_poles(const IdentifiedData& data);

/// Of all runs of all conditions.
std::vector<std::string> all_method_differences(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions);

inline constexpr double kSureDifference = 3.0;
inline constexpr double kLeastFrequency = 0.005;
inline constexpr double kMostFrequency = 0.03;
inline constexpr double kLeastDamping = 0.1;

}  // namespace flexarm::report
