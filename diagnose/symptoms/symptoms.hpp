#pragma once

#include "diagnose/search/reported_work.hpp"
#include "diagnose/search/run_drift.hpp"
#include "diagnose/symptoms/band_errors.hpp"
#include "diagnose/symptoms/hub_torque.hpp"
#include "diagnose/symptoms/regimes.hpp"
#include "diagnose/symptoms/root_shifts.hpp"
#include "diagnose/symptoms/run_distortion.hpp"

#include <optional>
#include <vector>

namespace flexarm::diagnose {

/// What the simulation without any cause gets wrong, and the numbers behind each statement.
struct Symptoms {
  std::vector<Symptom> statements;  ///< the significant ones first
  std::vector<BandError> bands;
  std::vector<RegimeError> regimes;
  std::vector<RootShift> roots;
  HubTorque hub_torque;
  std::vector<RunDistortion> distortion;
  std::optional<RunDrift> drift;
  bool is_complete = true;  ///< else the deadline left no time for the last of these
};

/// `drift` is of the leading effect; empty where there is none. After the deadline: what there is.
Symptoms symptoms_of(const SymptomsInput& input, std::optional<RunDrift> drift,
                     const Deadline& deadline = {});

}  // namespace flexarm::diagnose
