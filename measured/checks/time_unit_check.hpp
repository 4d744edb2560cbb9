#pragma once

#include "measured/files/time_record.hpp"

#include <optional>
#include <string>

namespace flexarm::measured {

/// Times that are probably in another unit than they were read in.
struct TimeUnitDoubt {
  double factor = 1.0;   ///< the unit that the times are in, in that they were read in: 1e-3
  std::string evidence;  ///< what speaks for it, a phrase
};

/// Whether milliseconds were probably read as seconds and the like. Two things speak for it:
///
/// - The hub velocity, where there is one beside the hub angle: the change of the angle over ten
///   samples is the integral of the velocity times r, correlation above 0.7, and r is a power of
///   1000 within a factor of 1.5. If r is 1 within a factor of 3, there is no doubt.
/// - The sampling period: above 0.25 s no flexible mode of an arm is seen, below 1 us no log is
///   taken. The unit is the nearest one, ms, us or ns, of which neither is so.
///
/// `record` has two samples or more; its times may be uneven.
std::optional<TimeUnitDoubt> doubt_time_unit(const TimeRecord& record);

}  // namespace flexarm::measured
