#pragma once

namespace flexarm::trials {

/// The probability of an event that was seen `events` times in `trials` is below this with 95 %
/// confidence: the 0.95 quantile of Beta(events + 1, trials - events) [ClopperPearson1934].
double upper_bound_95(int events, int trials);
/// It is above this with 95 % confidence.
double lower_bound_95(int events, int trials);

}  // namespace flexarm::trials
