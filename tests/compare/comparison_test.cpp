#include "compare/comparison.hpp"

#include "arm/input_error.hpp"
#include "tests/compare/models.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <functional>
#include <stdexcept>

namespace flexarm::compare {
namespace {

using testing::HasSubstr;

TEST(Comparison, ThePapersArmAgrees) {
  const auto comparison = compare(arm::paper_arm(), quick());
  EXPECT_TRUE(comparison.verdict.agree) << comparison.verdict.worst.quantity;
  EXPECT_EQ(comparison.subjects, (std::vector<std::string>{"exact_tf", "fem", "assumed_modes"}));
  EXPECT_EQ(comparison.roots.size(), 10U + 10U + 10U + 6U);
  EXPECT_EQ(comparison.responses.size(), 3U);
  EXPECT_TRUE(comparison.refinements.empty());
  // Roots by each of three pairs; shapes and responses by each of two against the first.
  EXPECT_EQ(comparison.findings.size(), 36U * 3U + 10U * 2U + 3U * 2U);
}

TEST(Comparison, ThePapersPolesAndZerosAreTheKnownOnes) {
  // /work/shared/design.md: poles, hub-angle zeros [Hz], tip zeros [rad/s], to six digits.
  const auto comparison = compare(arm::paper_arm(), quick());
  constexpr double kSixDigits = 5e-6;
  const auto expect = [&](std::size_t row, std::complex<double> s_rad_per_s) {
    for (const auto& s : comparison.roots[row].s_rad_per_s) {
      EXPECT_LE(relative_distance(s.value(), s_rad_per_s), kSixDigits) << row;
    }
  };
  const auto at_Hz = [](double f) { return std::complex<double>(0.0, 2.0 * M_PI * f); };
  expect(0, at_Hz(11.8618));
  expect(1, at_Hz(32.2606));
  expect(2, at_Hz(58.5327));
  expect(10, at_Hz(2.87337));
  expect(11, at_Hz(18.0071));
  expect(30, 57.4409);
  expect(31, 310.406);
}

TEST(Comparison, EveryPayloadAndDampingAgrees) {
  for (const auto& [name, arm] : varied_arms()) {
    const auto verdict = compare(arm, quick()).verdict;
    EXPECT_TRUE(verdict.agree) << name << ": " << verdict.worst.quantity << " "
                               << verdict.worst.first << " " << verdict.worst.second << " "
                               << verdict.worst.distance;
  }
}

TEST(Comparison, AgreesHoweverManyRootsAreAskedFor) {
  for (const auto& [poles, zeros] :
       std::vector<std::pair<int, int>>{{1, 1}, {2, 6}, {1, 3}, {30, 6}}) {
    Options options = quick();
    options.poles = poles;
    options.non_collocated_zeros = zeros;
    const auto comparison = compare(arm::paper_arm(), options);
    EXPECT_TRUE(comparison.verdict.agree)
        << poles << " poles, " << zeros << " zeros: " << comparison.verdict.worst.quantity << " "
        << comparison.verdict.worst.second << " " << comparison.verdict.worst.distance;
    EXPECT_EQ(comparison.roots.size(), static_cast<std::size_t>(3 * poles + zeros));
  }
}

TEST(Comparison, TellsItsProgressToTheEnd) {
  Options options = quick();
  options.poles = 2;
  int last = 0;
  int total = 0;
  options.progress = [&](int done, int of) {
    EXPECT_EQ(done, last + 1);
    last = done;
    total = of;
  };
  compare(arm::paper_arm(), options);
  EXPECT_GT(total, 0);
  EXPECT_EQ(last, total);
}

TEST(Comparison, OptionsOutOfRangeAreRefusedByName) {
  const std::vector<std::pair<std::string, std::function<void(Options&)>>> cases = {
      {"poles = 0: ", [](Options& o) { o.poles = 0; }},
      {"zeros = -1: ", [](Options& o) { o.non_collocated_zeros = -1; }},
      {"tolerance = 0: ", [](Options& o) { o.root_tolerance = 0.0; }},
      {"tolerance = nan: ", [](Options& o) { o.root_tolerance = kNaN; }},
      {"tolerance = inf: ", [](Options& o) { o.root_tolerance = HUGE_VAL; }},
      {"shape_tolerance = -1: ", [](Options& o) { o.shape_tolerance = -1.0; }},
      {"response_tolerance = 0: ", [](Options& o) { o.response_tolerance = 0.0; }},
      {"accuracy = 0: ", [](Options& o) { o.wanted_accuracy = 0.0; }},
      {"response_points = 1: ", [](Options& o) { o.response_points = 1; }},
      {"strain",
       [](Options& o) {
         o.sensors = {{arm::SensorKind::strain, 2.0}};
       }},
  };
  for (const auto& [line, change] : cases) {
    Options options = quick();
    change(options);
    try {
      compare(arm::paper_arm(), options);
      ADD_FAILURE() << line << " was accepted";
    } catch (const arm::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(line));
    }
  }
}

TEST(Comparison, HasNoRefinementsAfterTheDeadline) {
  Options options = quick();
  EXPECT_TRUE(compare(arm::paper_arm(), options).are_refinements_complete);
  options.refinements = true;
  options.deadline = std::chrono::steady_clock::now();
  const auto comparison = compare(arm::paper_arm(), options);
  EXPECT_FALSE(comparison.are_refinements_complete);
  EXPECT_TRUE(comparison.refinements.empty());
  EXPECT_TRUE(comparison.verdict.agree);
}

TEST(Comparison, OneModelIsNoComparison) {
  auto subjects = standard_subjects(arm::paper_arm(), 2);
  subjects.erase(subjects.begin() + 1, subjects.end());
  EXPECT_THROW(compare(subjects, quick()), std::invalid_argument);
}

TEST(DampedRoots, AreThoseOfTheCharacteristicEquation) {
  arm::Arm arm = arm::paper_arm();
  Options options;
  options.poles = 3;
  options.non_collocated_zeros = 2;
  options.sensors = {arm::parse_sensor("hub_angle"), arm::parse_sensor("tip_acceleration")};
  options.refinements = false;
  options.response_points = 20;
  EXPECT_TRUE(compare(arm, options).damped.empty());
  // Damping that is proportional to stiffness makes s^2 + kv w^2 s + w^2 = 0 of s^2 + w^2 = 0.
  constexpr double kKv_s = 1e-4;
  arm.damping.kelvin_voigt_s = kKv_s;
  const auto comparison = compare(arm, options);
  ASSERT_EQ(comparison.damped.size(), comparison.subjects.size());
  for (const DampedRoots& damped : comparison.damped) {
    EXPECT_EQ(damped.poles_rad_per_s.size(), 6U);
    ASSERT_EQ(damped.zeros_rad_per_s.size(), 2U);
    std::size_t matched = 0;
    for (const auto& row : comparison.roots) {
      if (!row.family.zeros_of) continue;
      const bool hub = *row.family.zeros_of == options.sensors[0];
      const auto squared = -*row.s_rad_per_s.front() * *row.s_rad_per_s.front();  // w^2
      const auto half = 0.5 * kKv_s * squared;
      for (const auto root :
           {-half + std::sqrt(half * half - squared), -half - std::sqrt(half * half - squared)}) {
        const auto& zeros = damped.zeros_rad_per_s[hub ? 0 : 1];
        EXPECT_TRUE(std::ranges::any_of(zeros, [&](const auto zero) {
          return std::abs(zero - root) <= 1e-6 * std::abs(root);
        })) << root;
        ++matched;
      }
    }
    EXPECT_EQ(matched, damped.zeros_rad_per_s[0].size() + damped.zeros_rad_per_s[1].size());
  }
}

}  // namespace
}  // namespace flexarm::compare
