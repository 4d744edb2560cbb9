#include "report/tables/prediction_error_table.hpp"

#include <cstdint>
#include <map>
#include <optional>

namespace flexarm::report {

namespace {

const char* const kPredictionCaption = "Prediction error k steps ahead, by the Kalman filter";

Cell samples_cell(const std::optional<std::size_t>& samples) {
  if (samples) return static_cast<std::int64_t>(*samples);
  return std::string("simulation");
}

Cell ahead_cell(double ahead_s) {
  if (ahead_s > 0.0) return ahead_s;
  return {};
}

std::vector<Column> error_columns() {
  return {{.name = "samples ahead"},
          {.name = "time ahead", .unit = "s", .significant_digits = 3},
          {.name = "arm file", .unit = "%", .significant_digits = 3},
          {.name = "extended arm", .unit = "%", .significant_digits = 3}};
}

}  // namespace

Table prediction_error_table(const std::vector<diagnose::PredictionError>& errors) {
  struct Mean {
    double ahead_s = 0.0;
    double before = 0.0;
    double after = 0.0;
    double channels = 0.0;
  };
  std::map<std::size_t, Mean> means;  // by samples
  for (const diagnose::PredictionError& error : errors) {
    if (!error.samples_ahead) continue;
    auto [at, is_first] = means.try_emplace(*error.samples_ahead, Mean{.ahead_s = error.ahead_s});
    Mean& mean = at->second;
    // Runs with different sampling periods have no time in common.
    if (mean.ahead_s != error.ahead_s) mean.ahead_s = 0.0;
    mean.before += error.before;
    mean.after += error.after;
    mean.channels += 1.0;
  }
  Table table{std::string(kPredictionCaption) + ", NRMSE, mean of the channels", error_columns()};
  for (const auto& [samples, mean] : means) {
    table.add_row({samples_cell(samples), ahead_cell(mean.ahead_s),
                   100.0 * mean.before / mean.channels, 100.0 * mean.after / mean.channels});
  }
  return table;
}

Table channel_prediction_error_table(const std::vector<diagnose::PredictionError>& errors) {
  Table table{std::string(kPredictionCaption) + ", NRMSE", {{.name = "run"}, {.name = "sensor"}}};
  for (Column& column : error_columns()) table.columns.push_back(std::move(column));
  for (const diagnose::PredictionError& error : errors) {
    table.add_row({error.run, error.sensor, samples_cell(error.samples_ahead),
                   ahead_cell(error.ahead_s), 100.0 * error.before, 100.0 * error.after});
  }
  return table;
}

}  // namespace flexarm::report
