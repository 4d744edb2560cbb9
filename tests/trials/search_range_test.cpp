// Sizes of the trials against the ranges in which the product looks for them.
#include "diagnose/experiment.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "tests/trials/trial_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace flexarm::trials {
namespace {

/// A cause at the end of its range is no cause (diagnose/search/admission.hpp): a trial must not
/// hide one there.
TEST(SearchRange, HasTheLargestSizeOfEachCauseInside) {
  constexpr double kInside = 0.01;
  for (const Cause& cause : causes()) {
    if (cause.outside) continue;
    const auto kind =
        cause.shown_in == ShownIn::time ? measured::RunKind::time : measured::RunKind::frf;
    const auto folder = std::filesystem::path(testing::TempDir()) / ("largest-" + cause.name);
    const TrialKey key{.kind = kind, .hidden = {cause.name}, .size = cause.largest};
    const Truth truth = write_case(key, folder);
    const auto experiment = diagnose::read_experiment(folder / "measurement.toml");
    std::filesystem::remove_all(folder);
    const auto hypotheses = diagnose::hypotheses(experiment);
    const auto hypothesis =
        std::ranges::find(hypotheses, cause.name, &diagnose::Hypothesis::effect);
    ASSERT_NE(hypothesis, hypotheses.end()) << cause.name;
    std::vector<double> values;
    for (const diagnose::SearchedParameter& parameter : hypothesis->parameters) {
      values.push_back(truth.world.hidden.front().parameters.at(parameter.name));
    }
    const auto places = effects::coordinates_of(hypothesis->parameters, values);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const diagnose::SearchedParameter& parameter = hypothesis->parameters[i];
      if (parameter.periodic) continue;
      EXPECT_GT(places[i], kInside) << cause.name << '.' << parameter.name;
      EXPECT_LT(places[i], 1.0 - kInside) << cause.name << '.' << parameter.name;
    }
  }
}

}  // namespace
}  // namespace flexarm::trials
