#include "compare/measured_responses.hpp"

#include "arm/input_error.hpp"
#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <vector>

namespace flexarm::compare {
namespace {

measured::FrequencyRecord exact_record(double factor) {
  const auto subject = standard_subjects(arm::paper_arm(), 5).front();
  measured::FrequencyChannel channel;
  channel.sensor = kHubAngle;
  for (const double frequency_Hz : {0.5, 2.0, 9.0, 25.0, 40.0}) {
    channel.frequency_Hz.push_back(frequency_Hz);
    channel.response.push_back(
        factor * response::transfer_function(subject.formulation, kHubAngle,
                                             {0.0, 2.0 * std::numbers::pi * frequency_Hz}));
    channel.coherence.push_back(kNaN);
  }
  return {{channel}};
}

/// 100 times the agreement of responses off resonance, 1e-7.
constexpr double kAgreement_percent = 1e-5;

TEST(MeasuredResponses, OfTheModelItselfHaveNoError) {
  const auto compared = responses_beside_models(arm::paper_arm(), "sine", exact_record(1.0));
  ASSERT_EQ(compared.size(), 1U);
  EXPECT_EQ(compared[0].run, "sine");
  EXPECT_EQ(compared[0].models, (std::vector<std::string>{"exact_tf", "fem", "assumed_modes"}));
  for (const double error : compared[0].relative_error_percent) {
    EXPECT_LT(error, kAgreement_percent);
  }
}

TEST(MeasuredResponses, AGainIsARelativeErrorOfTheMeasured) {
  const auto compared = responses_beside_models(arm::paper_arm(), "", exact_record(1.25));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(compared[0].relative_error_percent[k], 20.0, kAgreement_percent);
    EXPECT_NEAR(compared[0].median_error_percent[k], 20.0, kAgreement_percent);
  }
}

TEST(MeasuredResponses, ASensorThatTheArmCannotCarryIsRefused) {
  auto record = exact_record(1.0);
  record.channels[0].sensor = {arm::SensorKind::strain, 5.0};
  EXPECT_THROW(responses_beside_models(arm::paper_arm(), "", record), arm::InputError);
}

}  // namespace
}  // namespace flexarm::compare
