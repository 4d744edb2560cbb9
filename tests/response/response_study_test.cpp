#include "response/frequency/response_study.hpp"

#include "response/formulation_maker.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace flexarm::response {
namespace {

TEST(ResponseStudy, ReportsEachFrequencyOfBothResponses) {
  const arm::Arm arm = arm::paper_arm();
  ResponseOptions options;
  options.sensors = {{arm::SensorKind::hub_angle, 0.0}};
  options.frequency_Hz = {1.0, 4.0, 9.0, 20.0};
  std::vector<double> fractions;
  options.progress = [&fractions](double fraction) { fractions.push_back(fraction); };
  study_response(arm, make_formulation("exact_tf", arm, 8), options);
  EXPECT_EQ(fractions, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));

  fractions.clear();
  options.state_space = true;
  study_response(arm, make_formulation("exact_tf", arm, 8), options);
  EXPECT_EQ(fractions, (std::vector<double>{0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875, 1.0}));
}

}  // namespace
}  // namespace flexarm::response
