#pragma once

#include "diagnose/search/run_drift.hpp"
#include "diagnose/symptoms/symptom.hpp"

#include <vector>

namespace flexarm::diagnose {

/// One statement; significant where the spread is, and is more than `kLeastSpread` of the size,
/// which is what the simulation's own errors make of it.
std::vector<Symptom> drift_symptoms(const RunDrift& drift);
inline constexpr double kLeastSpread = 0.05;

}  // namespace flexarm::diagnose
