#pragma once

#include "measured/modal/modal_fit.hpp"
#include "measured/modal/start_spectra.hpp"

#include <limits>
#include <span>
#include <vector>

namespace flexarm::measured {

/// What a rational fit is made from, checked. Refers to the records, which must outlive it.
struct ModalFitTask {
  std::vector<arm::Sensor> sensors;
  std::vector<Stretch> search;  ///< what blocks are searched for in
  std::vector<Stretch> all;
  std::vector<DenominatorEquation> equations;
  FitBand band;
  double angle_period_s = 0.0;  ///< angle of the equations over omega
  bool in_time = true;
  bool forced = true;  ///< false: the torque of all records is zero, each a free decay
  /// Half the sampling frequency of the fastest run; infinite for frequency responses.
  double highest_Hz = std::numeric_limits<double>::infinity();
  /// Sampling period that all records have; 0 where there is none, so that nothing is an alias in
  /// all of them.
  double period_s = 0.0;
};

/// Both throw as `fit_modes` does.
ModalFitTask time_task(std::span<const TimeRecord> records, const ModalFitOptions& options);
ModalFitTask frequency_task(const FrequencyRecord& record, const ModalFitOptions& options);

}  // namespace flexarm::measured
