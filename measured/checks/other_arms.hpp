#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Whether an arm with variations of the described one explains a record better than the described
/// arm explains it without the faults that were `found` by that arm: signs, units, scales, delays
/// or the clock. A finding is then the arm's, not the record's.
///
/// Records are compared by RecordedLines over their first `kMostJudged` samples, where both
/// signals are coherent. The best single variation is compared with the described arm, and the best
/// two with it and the best one: each side has as many numbers to choose. Against a sign a single
/// variation that brings the arm three times nearer than the finding does is enough. False without
/// variations, true where options.deadline leaves it undecided.
bool other_arm_explains_more(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, double period_s, bool from_rest,
                             const std::vector<DataFinding>& found,
                             const DataCheckOptions& options);
inline constexpr std::size_t kMostJudged = 4096;

/// The same of a finding that is another arm, as one with another payload: `mended` describes it.
bool other_arm_explains_more(std::span<const CheckedSignal> signals,
                             const std::vector<bool>& usable, double period_s, bool from_rest,
                             const DataCheckOptions& options, const DataCheckOptions& mended);

}  // namespace flexarm::measured
