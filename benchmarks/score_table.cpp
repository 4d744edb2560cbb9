#include "benchmarks/score_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace flexarm::benchmarks {

namespace {

/// Slope of log y over log x by least squares.
double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
  double sum_x = 0.0;
  double sum_y = 0.0;
  double sum_xx = 0.0;
  double sum_xy = 0.0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]);
    const double v = std::log(y[i]);
    sum_x += u;
    sum_y += v;
    sum_xx += u * u;
    sum_xy += u * v;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

}  // namespace

bool ScoreTable::ReportContext(const Context&) {
  GetOutputStream() << fmt::format("{:<64} {:>12}\n", "", "CPU time");
  return true;
}

void ScoreTable::ReportRuns(const std::vector<Run>& runs) {
  std::vector<Run> measured;
  for (const Run& run : runs) {
    if (run.error_occurred) {
      GetErrorStream() << run.benchmark_name() << ": " << run.error_message << '\n';
    } else if (run.run_type == Run::RT_Iteration) {
      measured.push_back(run);
    }
  }
  if (measured.empty()) return;
  const Run& best =
      *std::ranges::min_element(measured, {}, [](const Run& r) { return r.GetAdjustedCPUTime(); });

  std::string name = best.run_name.function_name;
  std::string line = name;
  if (!best.run_name.args.empty()) line += ' ' + best.run_name.args;
  line = fmt::format("{:<64} {:>9.4g} {:<2}", line, best.GetAdjustedCPUTime(),
                     benchmark::GetTimeUnitString(best.time_unit));
  for (const auto& [counter, value] : best.counters) {
    line += fmt::format("  {} {:<9.3g}", counter, value.value);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  GetOutputStream() << line << '\n' << std::flush;

  if (best.complexity_n == 0) return;
  Series& series = series_[name];
  series.sizes.push_back(static_cast<double>(best.complexity_n));
  series.values["time"].push_back(best.GetAdjustedCPUTime());
  for (const auto& [counter, value] : best.counters) {
    // An error ends at its rounding floor and follows no power of n.
    if (!counter.starts_with("error")) series.values[counter].push_back(value.value);
  }
}

void ScoreTable::Finalize() {
  for (const auto& [name, series] : series_) {
    if (series.sizes.size() < 3) continue;
    std::string line = fmt::format("{}: slopes over log n, n = {:g} to {:g}:", name,
                                   series.sizes.front(), series.sizes.back());
    for (const auto& [what, values] : series.values) {
      line += fmt::format("  {} {:.2f}", what, fitted_slope(series.sizes, values));
    }
    GetOutputStream() << line << '\n';
  }
}

}  // namespace flexarm::benchmarks
