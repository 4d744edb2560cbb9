#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/time_record.hpp"
#include "measured/modal/common_denominator.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Frequencies that count.
struct FitBand {
  double from_Hz = 0.0;
  double to_Hz = 0.0;

  bool contains(double frequency_Hz) const {
    return frequency_Hz >= from_Hz && frequency_Hz <= to_Hz;
  }
  bool operator==(const FitBand&) const = default;
};

/// Whether the torque is 0 at all samples.
bool is_zero(std::span<const double> torque_N_m);

/// Where the torque has power, all where it is zero: from two lines above 0 to the highest of 100
/// equal bands up to half the sampling frequency whose mean power is kBandPower of the largest or
/// more.
FitBand excited_band(const TimeRecord& record);
inline constexpr double kBandPower = 1e-4;

/// Equations of a record's sensors in the lines of its first `samples` samples, rounded down to a
/// product of 2, 3 and 5. The angle is pi at band.to_Hz. Each has the torque's line, unless the
/// torque is zero, and a transient as inputs: a polynomial in z for what the record's begin and end
/// differ by [PintelonSchoukens2012], so that lines are exact without window or average; both over
/// (1 - 1/z)^k where the sensor integrates k times, a double or single pole at z = 1 that the
/// denominator then need not have.
std::vector<DenominatorEquation> time_equations(const TimeRecord& record, bool rigid,
                                                const FitBand& band, std::size_t samples);

/// The same for a frequency response, each line over its standard deviation.
DenominatorEquation frequency_equation(const FrequencyChannel& channel,
                                       std::span<const double> deviation, bool rigid,
                                       const FitBand& band);

}  // namespace flexarm::measured
