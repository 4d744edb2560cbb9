// How often the 95 % intervals of a rational fit cover the truth: the paper's arm with damping, a
// minute at 200 Hz, 1 % noise, another torque and other noise in every run.
//
// modal_coverage [RUNS]
#include "tests/measured/coverage_study.hpp"

#include <fmt/format.h>

#include <cstdlib>

int main(int argc, char** argv) {
  using namespace flexarm::measured;
  constexpr int kRuns = 300;
  const int runs = argc > 1 ? std::atoi(argv[1]) : kRuns;
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  CoverageStudy study(fit_case);
  for (int run = 1; run <= runs; ++run) study.run(static_cast<std::uint64_t>(run));
  fmt::print("{} runs; {} with another number of blocks than modes, {} with coloured residuals\n\n",
             study.runs(), study.other_orders(), study.robust());
  fmt::print("| quantity | covered [%] | rms error [standard errors] | largest error [%] |\n");
  fmt::print("| --- | --- | --- | --- |\n");
  for (const Coverage& entry : study.coverage()) {
    fmt::print("| {} | {:.1f} | {:.3f} | {:.4f} |\n", entry.quantity, 100.0 * entry.share(),
               entry.spread(), 100.0 * entry.largest_relative_error);
  }
}
