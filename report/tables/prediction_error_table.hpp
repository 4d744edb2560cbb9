#pragma once

#include "diagnose/prediction_errors.hpp"
#include "report/tables/table.hpp"

#include <vector>

namespace flexarm::report {

/// NRMSE of predictions k samples ahead, mean of the channels, a row a k and the simulation last;
/// no rows without any.
Table prediction_error_table(const std::vector<diagnose::PredictionError>& errors);

/// The same channel by channel.
Table channel_prediction_error_table(const std::vector<diagnose::PredictionError>& errors);

}  // namespace flexarm::report
