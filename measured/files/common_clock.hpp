#pragma once

#include "measured/files/joined_table.hpp"

#include <string>
#include <vector>

namespace flexarm::measured {

/// Moves the times of all files to the clock of the first one with time stamps, by the moments at
/// which their times are 0, and returns a sentence on each that is moved. Clocks without a date are
/// less than half a day apart; beside one of them, the date of another is not used. Numbers from
/// 1e8 s on beside stamps with a date are seconds since 1970.
///
/// Times without stamps stay as they are, but for those of which every head tells the start, unless
/// their first numbers differ as these starts do.
///
/// Throws InputError for stamps in one file and other seconds in another, and for stamps of which
/// those of one file alone have a time zone.
std::vector<std::string> put_on_one_clock(std::vector<TimedSignals>& files);

}  // namespace flexarm::measured
