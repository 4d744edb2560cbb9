#include "report/tables/measured_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace flexarm::report {

namespace {

constexpr double kWithin = 2.0;  // standard deviations

bool is_known(double value) {
  return std::isfinite(value);
}

bool has_measured_std(const std::vector<compare::MeasuredRow>& rows) {
  return std::ranges::any_of(
      rows, [](const auto& row) { return row.measured.frequency_std_Hz.has_value(); });
}

bool has_model_std(const std::vector<compare::MeasuredRow>& rows) {
  return std::ranges::any_of(rows, [](const auto& row) { return row.model_std_Hz.has_value(); });
}

Cell order_cell(const compare::MeasuredRow& row) {
  return row.order ? Cell(std::int64_t{*row.order}) : Cell();
}

std::string sensor_cell(const compare::MeasuredRow& row) {
  return row.measured.sensor ? arm::to_string(*row.measured.sensor) : "";
}

std::string sensors_of(const compare::MeasuredShape& shape) {
  std::vector<std::string> names;
  for (const auto& sensor : shape.sensors) names.push_back(arm::to_string(sensor));
  return fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

Table measured_table(const std::vector<compare::MeasuredRow>& rows,
                     const std::vector<std::string>& models) {
  Table table{"Measured and exact_tf: natural frequencies |s|/2 pi of damped poles and zeros",
              {{"feature"}, {"no."}, {"sensor"}, {"measured", "Hz", 5}}};
  const bool has_std = has_measured_std(rows);
  const bool has_arm_std = has_model_std(rows);
  if (has_std) table.columns.push_back({"std", "Hz", 2});
  table.columns.push_back({"model", "Hz", 6});
  if (has_arm_std) table.columns.push_back({"arm file std", "Hz", 2});
  table.columns.push_back({"error", "%", 3});
  if (has_std) {
    for (const auto& model : models) table.columns.push_back({model, "std", 3});
  }
  if (has_arm_std) table.columns.push_back({"both", "std", 3});
  for (const auto& row : rows) {
    std::vector<Cell> cells = {std::string(measured::to_string(row.measured.feature)),
                               order_cell(row), sensor_cell(row),
                               row.measured.frequency_Hz.value_or(kMissing)};
    if (has_std) cells.emplace_back(row.measured.frequency_std_Hz.value_or(kMissing));
    cells.emplace_back(row.model_frequency_Hz.value_or(kMissing));
    if (has_arm_std) cells.emplace_back(row.model_std_Hz.value_or(kMissing));
    cells.emplace_back(row.error_percent);
    for (std::size_t k = 0; has_std && k < models.size(); ++k) {
      cells.emplace_back(k < row.deviations.size() ? row.deviations[k] : kMissing);
    }
    if (has_arm_std) cells.emplace_back(row.combined_deviation);
    table.add_row(std::move(cells));
  }
  return table;
}

Table measured_damping_table(const std::vector<compare::MeasuredRow>& rows) {
  Table table{"Measured damping ratios and those of the damped poles and zeros of exact_tf",
              {{"feature"},
               {"no."},
               {"sensor"},
               {"measured", "", 3},
               {"std", "", 2},
               {"model", "", 4},
               {"difference", "std", 3}}};
  for (const auto& row : rows) {
    if (!row.measured.damping_ratio) continue;
    table.add_row({std::string(measured::to_string(row.measured.feature)), order_cell(row),
                   sensor_cell(row), *row.measured.damping_ratio,
                   row.measured.damping_ratio_std.value_or(kMissing),
                   row.model_damping_ratio.value_or(kMissing), row.damping_deviation});
  }
  return table;
}

std::string measured_summary(const std::vector<compare::MeasuredRow>& rows) {
  std::size_t known = 0;
  std::size_t within = 0;
  double largest = 0.0;
  for (const auto& row : rows) {
    if (!is_known(row.combined_deviation)) continue;
    ++known;
    within += std::abs(row.combined_deviation) <= kWithin ? 1U : 0U;
    largest = std::fmax(largest, std::abs(row.combined_deviation));
  }
  if (known == 0) return "";
  return fmt::format(
      "{} of {} measured frequencies are within {:g} standard deviations of the model, the "
      "farthest at {:.3g}. Standard deviations: {}.",
      within, known, kWithin, largest,
      has_model_std(rows) ? "of the measurement and of the uncertain numbers of the arm file"
                          : "of the measurement; the arm file states no uncertain number");
}

Table measured_runs_table(const std::vector<compare::MeasuredTimeRun>& runs) {
  Table table{"Measured time runs and their simulation with all effects of the arm",
              {{"run"}, {"start"}, {"loop"}, {"channel"}, {"fit", "%", 4}, {"NRMSE", "%", 3}}};
  for (const auto& run : runs) {
    for (const auto& signal : run.signals) {
      table.add_row({run.run, std::string(run.free_start ? "free" : "rest"),
                     std::string(run.closed_loop ? "closed" : "open"), signal.sensor,
                     signal.fit_percent(), signal.nrmse_percent});
    }
  }
  return table;
}

std::string out_of_time_text(const compare::Comparison& comparison,
                             const compare::MeasuredComparison& measured) {
  std::vector<std::string> left_out;
  if (!comparison.are_refinements_complete) left_out.emplace_back("the whole convergence study");
  if (!measured.runs_out_of_time.empty()) {
    left_out.push_back(
        fmt::format("simulations of {}", fmt::join(measured.runs_out_of_time, ", ")));
  }
  if (left_out.empty()) return "";
  return fmt::format("the time limit left no time for {}", fmt::join(left_out, " and "));
}

Table measured_run_listing(const compare::MeasuredTimeRun& run) {
  Table table{run.run, {{"time", "s"}, {"torque", "N m"}}};
  for (const auto& signal : run.signals) {
    table.columns.push_back({signal.sensor + " measured", signal.unit});
    table.columns.push_back({signal.sensor + " simulated", signal.unit});
  }
  for (std::size_t k = 0; k < run.time_s.size(); ++k) {
    std::vector<Cell> cells = {run.time_s[k], run.torque_N_m[k]};
    for (const auto& signal : run.signals) {
      const bool is_reading = !std::ranges::binary_search(signal.left_out, k);
      cells.push_back(is_reading ? Cell(signal.measured[k]) : Cell());
      cells.emplace_back(signal.simulated[k]);
    }
    table.add_row(std::move(cells));
  }
  return table;
}

std::string measured_verdict_line(const compare::MeasuredVerdict& verdict) {
  std::string line = verdict.agreement == compare::MeasuredAgreement::agrees
                         ? "Measurement: agrees with the model."
                         : "Measurement: DIFFERS from the model.";
  if (verdict.judged_by_std > 0) {
    line += fmt::format(
        " Largest difference: {:.3g} standard deviations ({}); chi-square {:.3g} of {} number{}, "
        "probability {:.2g}, limit {:.2g}.",
        verdict.in_std.size, verdict.in_std.of, verdict.chi_square, verdict.judged_by_std,
        verdict.judged_by_std == 1 ? "" : "s", verdict.p_value,
        compare::MeasuredVerdict::kLeastProbability);
  }
  if (verdict.judged_by_percent > 0) {
    const double percent = verdict.in_percent.size;
    line += fmt::format(
        " Largest difference{}: {} % ({}), tolerance {:g} %.",
        verdict.judged_by_std > 0 ? " without a standard deviation" : "",
        percent < 1000.0 ? fmt::format("{:.3g}", percent) : fmt::format("{:.0f}", percent),
        verdict.in_percent.of, verdict.tolerance_percent);
  }
  return line;
}

Table measured_response_table(const std::vector<compare::MeasuredResponse>& responses) {
  const bool is_whole =
      std::ranges::all_of(responses, [](const auto& response) { return response.left_out == 0; });
  Table table{is_whole ? "Measured frequency responses and those of the models"
                       : fmt::format("Measured frequency responses and those of the models, at "
                                     "lines with a coherence of {:g} or more",
                                     compare::kLeastCoherence),
              {{"run"},
               {"sensor"},
               {"lines"},
               {"from", "Hz", 4},
               {"to", "Hz", 4},
               {"model"},
               {"error", "%", 3},
               {"median", "%", 3}}};
  for (const auto& response : responses) {
    const auto& frequency_Hz = response.measured.frequency_Hz;
    for (std::size_t k = 0; k < response.models.size(); ++k) {
      table.add_row({response.run, arm::to_string(response.measured.sensor),
                     static_cast<std::int64_t>(frequency_Hz.size()), frequency_Hz.front(),
                     frequency_Hz.back(), response.models[k], response.relative_error_percent[k],
                     response.median_error_percent[k]});
    }
  }
  return table;
}

Table mac_table(const compare::ShapeCorrelation& shapes) {
  Table table{fmt::format("MAC of measured mode shapes (rows) and those of {} (columns); largest "
                          "MAC of two computed ones at these sensors {:.2g}",
                          shapes.models.front(), shapes.largest_auto_mac),
              {{"no."}, {"measured", "Hz", 5}, {"sensors"}}};
  for (std::size_t k = 0; k < shapes.model_frequencies_Hz.size(); ++k) {
    table.columns.push_back(
        {fmt::format("{}", k + 1), fmt::format("{:.4g} Hz", shapes.model_frequencies_Hz[k]), 3});
  }
  for (std::size_t i = 0; i < shapes.measured.size(); ++i) {
    const auto& shape = shapes.measured[i];
    std::vector<Cell> cells = {std::int64_t{shape.order}, shape.frequency_Hz.value_or(kMissing),
                               static_cast<std::int64_t>(shape.sensors.size())};
    for (const double value : shapes.mac.front()[i]) cells.emplace_back(value);
    table.add_row(std::move(cells));
  }
  return table;
}

Table mac_listing(const std::vector<compare::ShapeCorrelation>& shapes) {
  Table table{"",
              {{"model"},
               {"measured mode"},
               {"measured", "Hz"},
               {"sensors"},
               {"computed mode"},
               {"computed", "Hz"},
               {"MAC"}}};
  for (const auto& one : shapes) {
    for (std::size_t m = 0; m < one.models.size(); ++m) {
      for (std::size_t i = 0; i < one.measured.size(); ++i) {
        for (std::size_t j = 0; j < one.mac[m][i].size(); ++j) {
          table.add_row({one.models[m], std::int64_t{one.measured[i].order},
                         one.measured[i].frequency_Hz.value_or(kMissing),
                         sensors_of(one.measured[i]), static_cast<std::int64_t>(j + 1),
                         one.model_frequencies_Hz[j], one.mac[m][i][j]});
        }
      }
    }
  }
  return table;
}

}  // namespace flexarm::report
