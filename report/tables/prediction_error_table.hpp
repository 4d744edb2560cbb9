#pragma once

#include "diagnose/prediction_errors.hpp"
#include "report/tables/table.hpp"

#include <vector>

namespace flexarm::report {

/// NRMSE of predictions k samples ahead, mean of the channels, a row a k; no rows without any. The
/// filter's own simulation of whole runs is not among them: it begins in other states than the
/// reported one.
Table prediction_error_table(const std::vector<diagnose::PredictionError>& errors);

/// Prediction errors channel by channel, with the filter's simulation.
Table channel_prediction_error_table(const std::vector<diagnose::PredictionError>& errors);

}  // namespace flexarm::report
