// Sizes of the trials against the ranges in which the product looks for them: a fit begins inside
// (diagnose/search/moves.hpp), so that a trial must not hide one at an end.
#include "diagnose/experiment.hpp"
#include "diagnose/search/hypothesis.hpp"
#include "tests/trials/trial_case.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace flexarm::trials {
namespace {

/// A case, and what is looked for in it. The ranges follow from the arm, the kind of the runs and
/// the sizes of their signals.
struct Searched {
  explicit Searched(const TrialKey& key) {
    const auto folder = std::filesystem::path(testing::TempDir()) / ("search " + key.folder_name());
    truth = write_case(key, folder);
    hypotheses = diagnose::hypotheses(diagnose::read_experiment(folder / "measurement.toml"));
    std::filesystem::remove_all(folder);
  }
  Truth truth;
  std::vector<diagnose::Hypothesis> hypotheses;
};

void expect_inside(const std::vector<diagnose::Hypothesis>& hypotheses, const HiddenCause& hidden) {
  constexpr double kInside = 0.01;
  const auto hypothesis = std::ranges::find_if(hypotheses, [&](const auto& one) {
    return one.effect == hidden.name && one.sensor == hidden.sensor;
  });
  ASSERT_NE(hypothesis, hypotheses.end()) << hidden.name;
  std::vector<double> values;
  for (const diagnose::SearchedParameter& parameter : hypothesis->parameters) {
    values.push_back(hidden.parameters.at(parameter.name));
  }
  const auto places = effects::coordinates_of(hypothesis->parameters, values);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const diagnose::SearchedParameter& parameter = hypothesis->parameters[i];
    if (parameter.periodic) continue;
    EXPECT_GT(places[i], kInside) << hypothesis->label() << ": " << parameter.name;
    EXPECT_LT(places[i], 1.0 - kInside) << hypothesis->label() << ": " << parameter.name;
  }
}

TEST(SearchRange, HasTheLargestSizeOfEachCauseInside) {
  for (const TrialArm& of : trial_arms()) {
    for (const auto kind : {measured::RunKind::time, measured::RunKind::frf}) {
      SCOPED_TRACE(of.arm.name + " " + std::string(measured::to_string(kind)));
      const Searched searched({.kind = kind, .arm = of.arm.name});
      for (const Cause& cause : causes()) {
        if (cause.outside || !cause.shows_in(kind)) continue;
        if (!cause.shows_on_arm.empty() && cause.shows_on_arm != of.arm.name) continue;
        if (cause.name == "sensor_offset") continue;  // its range is that of the readings with it
        Random random(1, cause.name);
        const World world =
            with_hidden(World{of.arm}, of, cause, cause.largest, draw_chance(random));
        expect_inside(searched.hypotheses, world.hidden.front());
      }
    }
  }
}

TEST(SearchRange, OfAnOffsetHasTheLargestInside) {
  for (const TrialArm& of : trial_arms()) {
    SCOPED_TRACE(of.arm.name);
    const Searched searched({.hidden = {"sensor_offset"},
                             .arm = of.arm.name,
                             .size = find_cause("sensor_offset").largest});
    expect_inside(searched.hypotheses, searched.truth.world.hidden.front());
  }
}

}  // namespace
}  // namespace flexarm::trials
