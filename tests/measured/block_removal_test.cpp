// BIC without each block, all of them from one pass, beside evaluations of the smaller sets.
#include "measured/modal/variable_projection.hpp"
#include "tests/fit_cases/fit_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flexarm::measured {
namespace {

TEST(BicWithoutEach, IsThatOfTheSmallerSetAsItIs) {
  FitCase fit_case;
  fit_case.duration_s = 5.0;
  fit_case.relative_noise = 0.01;
  const TimeRecord record = record_of(fit_case);
  const std::vector<Eigen::Index> all = {0, 1, 2, 3};
  const std::size_t samples = record.time_s.size();
  // A run from rest, and one whose free motion has columns of its own.
  const std::vector<Stretch> stretches = {
      time_stretch(record, all, TorqueHold::zero, InitialState::rest, samples),
      time_stretch(record, all, TorqueHold::zero, InitialState::free, samples)};
  const auto block = [](double frequency_Hz, double damping_ratio) {
    return block_of(2.0 * std::numbers::pi * frequency_Hz, damping_ratio);
  };
  const BlockSet blocks{
      .blocks = {{1.0, 0.0}, block(12.0, 0.02), block(31.0, 0.1), block(50.0, 0.5)}};
  const ColumnChoices choices;
  const ProjectionOptions as_is{.most_iterations = 0};
  const BlockFit fit = fit_blocks(stretches, fit_case.sensors, blocks, choices, as_is);
  const std::vector<double> bic = bic_without_each(stretches, fit, 1);
  ASSERT_EQ(bic.size(), 3U);
  for (std::size_t m = 0; m < bic.size(); ++m) {
    BlockSet fewer = blocks;
    fewer.blocks.erase(fewer.blocks.begin() + static_cast<std::ptrdiff_t>(m + 1));
    const double expected = fit_blocks(stretches, fit_case.sensors, fewer, choices, as_is).bic();
    // Sums over 8000 values of a logarithm of squares.
    EXPECT_NEAR(bic[m], expected, 1e-7 * std::abs(expected));
    EXPECT_GT(bic[m], fit.bic());
  }
}

}  // namespace
}  // namespace flexarm::measured
