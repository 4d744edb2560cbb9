// The start of a fit: NLopt's DIRECT-L beside a uniform grid of as many places. How often a fit
// from there ends at the least sum of squares, for causes of the vocabulary at values drawn at
// random.
//
// global_start_benchmark [TRIALS]
#include "diagnose/search/fit.hpp"
#include "diagnose/search/scan.hpp"
#include "effects/registry/vocabulary.hpp"
#include "tests/diagnose/simulated_experiments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace flexarm::diagnose;

/// As diagnose/search/selection.cpp has it for causes of so many parameters.
constexpr int kEvaluations[] = {40, 90, 160};
/// Sums of squares nearer than this are those of one minimum.
constexpr double kSame = 1.001;

struct Tally {
  int direct = 0;
  int grid = 0;
  int middle = 0;
};

void run(const std::string& effect, int trials) {
  const Experiment plain = simulated_experiment({});
  const auto known = named(plain, {effect}).front();
  const std::size_t parameters = known.parameters.size();
  const int evaluations = kEvaluations[std::min<std::size_t>(parameters, 3) - 1];
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> drawn(0.2, 0.95);
  Tally tally;
  for (int trial = 0; trial < trials; ++trial) {
    std::map<std::string, double> hidden;
    std::vector<double> middle;
    for (const SearchedParameter& parameter : known.parameters) {
      hidden[parameter.name] = parameter.value(drawn(generator));
      middle.push_back(parameter.value(0.5));
    }
    const Experiment experiment = simulated_experiment(
        {flexarm::effects::named(effect, hidden)}, {.seed = static_cast<std::uint64_t>(trial + 1)});
    const Problem problem(experiment);
    const auto hypothesis = named(experiment, {effect}).front();
    const Candidate start = Candidate{}.with(hypothesis, middle);
    const auto by = [&](ScanMethod method) {
      const ScanOptions options{.evaluations = evaluations, .method = method};
      const Candidate best = scan(problem, start, last_coordinates(start), options).front();
      return fit(problem, best).sum_of_squares;
    };
    const double direct = by(ScanMethod::direct);
    const double grid = by(ScanMethod::grid);
    const double alone = fit(problem, start).sum_of_squares;
    const double least = std::min({direct, grid, alone});
    if (direct <= kSame * least) ++tally.direct;
    if (grid <= kSame * least) ++tally.grid;
    if (alone <= kSame * least) ++tally.middle;
  }
  fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", effect, parameters, evaluations, trials,
             tally.direct, tally.grid, tally.middle);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int trials = argc > 1 ? std::atoi(argv[1]) : 12;
  fmt::print(
      "| cause | parameters | evaluations | trials | least by DIRECT-L | by a grid | from the "
      "middle "
      "|\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const char* effect : {"root_compliance", "flexural_rigidity", "time_delay", "hub_spring",
                             "local_stiffness_loss", "torque_ripple", "stribeck_friction"}) {
    run(effect, trials);
  }
}
