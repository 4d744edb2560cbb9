#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/tables/table.hpp"

#include <string>
#include <vector>

namespace flexarm::report {

/// The uncertain numbers that were refitted by more than kPlausibleDeviation; empty without any.
std::string implausible_numbers_text(const diagnose::Diagnosis& diagnosis);

/// The verdict in a sentence or two, as an engineer would say it.
std::string verdict_text(const diagnose::Diagnosis& diagnosis);

/// What was not searched for: sets of effects that the time limit left untried, excluded effects.
/// Empty where the whole library was searched.
std::string search_text(const diagnose::Diagnosis& diagnosis);

/// A sentence for each fault of the data that counts as none.
std::vector<std::string> accepted_texts(const diagnose::Diagnosis& diagnosis);

/// The predictor and why it was that one; by a Kalman filter also the disturbance of the hub torque
/// before and after. Empty without `time` runs.
std::string predictor_text(const diagnose::Diagnosis& diagnosis);

/// The causes, a row a parameter, with standard errors and shares.
Table cause_table(const diagnose::Diagnosis& diagnosis);

/// Relative errors of runs and sensors before and after, beside the noise [per cent].
Table channel_gain_table(const diagnose::Diagnosis& diagnosis);

/// The error on runs that were fitted and on those that were not.
Table gain_table(const diagnose::Diagnosis& diagnosis);

/// What came nearest without being named; no rows without any.
Table near_miss_table(const diagnose::Diagnosis& diagnosis);

/// Uncertain numbers of the arm file that were refitted; no rows without any.
Table refitted_table(const diagnose::Diagnosis& diagnosis);

/// Whether the three formulations agree on the extended arm: one sentence.
std::string formulations_text(const diagnose::FormulationCheck& check);

}  // namespace flexarm::report
