// The sampled response of a block against closed forms, and its derivatives against differences.
#include "measured/modal/held_response.hpp"

#include "measured/files/sensor_columns.hpp"
#include "measured/modal/block_signals.hpp"
#include "response/time/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace flexarm::measured {
namespace {

constexpr double kPeriod_s = 0.005;
constexpr int kSamples = 400;
/// Steps times the rounding of a step, and some.
constexpr double kStepRounding = 1e-12;

TEST(HeldResponse, OfAnOscillatorToAStepIsTheClosedForm) {
  const double omega = 75.0;
  const HeldResponse step(block_of(omega, 0.0), kPeriod_s, TorqueHold::zero);
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kPeriod_s;
    EXPECT_NEAR(x(0) * omega * omega, 1.0 - std::cos(omega * t), kStepRounding);
    EXPECT_NEAR(x(1) * omega, std::sin(omega * t), kStepRounding);
    step.step(x, 1.0, 1.0);
  }
}

TEST(HeldResponse, OfARigidBodyToARampIsACubic) {
  const HeldResponse step({0.0, 0.0}, kPeriod_s, TorqueHold::first);
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kPeriod_s;
    EXPECT_NEAR(x(0), t * t * t / 6.0, kStepRounding);
    EXPECT_NEAR(x(1), t * t / 2.0, kStepRounding);
    step.step(x, t, t + kPeriod_s);
  }
}

TEST(HeldResponse, OfRealPolesToAStepIsTheClosedForm) {
  // 1/((s + 2)(s + 30)).
  const HeldResponse step({32.0, 60.0}, kPeriod_s, TorqueHold::zero);
  Eigen::Vector4d x = Eigen::Vector4d::Zero();
  for (int k = 0; k < kSamples; ++k) {
    const double t = k * kPeriod_s;
    const double expected = 1.0 / 60.0 - std::exp(-2.0 * t) / 56.0 + std::exp(-30.0 * t) / 840.0;
    EXPECT_NEAR(x(0), expected, kStepRounding);
    step.step(x, 1.0, 1.0);
  }
}

TimeRecord random_torque() {
  TimeRecord record;
  response::RandomNumbers random(5);
  for (int k = 0; k < kSamples; ++k) {
    record.time_s.push_back(k * kPeriod_s);
    record.torque_N_m.push_back(random.normal());
  }
  return record;
}

Eigen::MatrixXd rows_of(const Stretch& stretch, const BlockSet& set) {
  Eigen::MatrixXd all(stretch.rows, stretch.layout(set).first_reading());
  Eigen::Index at = 0;
  stretch.visit(set, [&](const Eigen::Ref<const Eigen::MatrixXd>& rows) {
    all.middleRows(at, rows.rows()) = rows;
    at += rows.rows();
  });
  return all;
}

TEST(SensorColumns, HaveTheDerivativesThatDifferencesHave) {
  const TimeRecord record = random_torque();
  const BlockSet set{{{0.3, 0.0}, block_of(60.0, 0.02), block_of(90.0, 1.3)}, true};
  for (const TorqueHold hold : {TorqueHold::zero, TorqueHold::first}) {
    const Stretch stretch = time_stretch(record, {}, hold, InitialState::free, kSamples);
    const SignalLayout layout = stretch.layout(set);
    const Eigen::MatrixXd rows = rows_of(stretch, set);
    for (std::size_t m = 0; m < set.blocks.size(); ++m) {
      for (int power = 0; power < 3; ++power) {
        for (const auto kind : {SensorColumn::Kind::forced, SensorColumn::Kind::free}) {
          if (kind == SensorColumn::Kind::free && power == 2) continue;
          const SensorColumn column{kind, m, power, 0};
          const Eigen::MatrixXd derivatives = column_derivatives(column, rows, layout, set);
          for (Eigen::Index i = 0; i < derivatives.cols(); ++i) {
            // Central differences: their error is step^2, rounding over step.
            constexpr double kStep = 1e-5;
            constexpr double kDifference = 1e-6;
            Eigen::VectorXd theta = set.theta();
            const Eigen::Index at = set.first_parameter(m) + i;
            theta(at) += kStep;
            const BlockSet above = set.with(theta);
            theta(at) -= 2.0 * kStep;
            const BlockSet below = set.with(theta);
            const Eigen::VectorXd difference =
                (column_of(column, rows_of(stretch, above), layout, above) -
                 column_of(column, rows_of(stretch, below), layout, below)) /
                (2.0 * kStep);
            EXPECT_LT((difference - derivatives.col(i)).norm(), kDifference * difference.norm())
                << m << ' ' << power << ' ' << i;
          }
        }
      }
    }
  }
}

TEST(Triangle, HasTheCrossProductsOfTheRows) {
  const TimeRecord record = random_torque();
  const BlockSet set{{{0.3, 0.0}, block_of(60.0, 0.02)}, true};
  const Stretch stretch = time_stretch(record, {}, TorqueHold::zero, InitialState::rest, kSamples);
  const Eigen::MatrixXd rows = rows_of(stretch, set);
  const Eigen::MatrixXd r = triangle(stretch, set);
  const Eigen::MatrixXd expected = rows.transpose() * rows;
  const Eigen::VectorXd size = expected.diagonal().cwiseSqrt();
  const Eigen::MatrixXd difference = size.cwiseInverse().asDiagonal() *
                                     (r.transpose() * r - expected) *
                                     size.cwiseInverse().asDiagonal();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), kStepRounding);
}

TEST(SecondOrderBlock, HasTheRootsOfItsPolynomial) {
  for (const SecondOrderBlock block :
       {SecondOrderBlock{1e-3, 0.0}, SecondOrderBlock{1e6, 1.0}, SecondOrderBlock{2.0, 2.0},
        SecondOrderBlock{0.0, 4.0}, SecondOrderBlock{-0.1, 9.0}}) {
    const auto [first, second] = block.poles_rad_per_s();
    EXPECT_NEAR(std::abs(first + second + block.a1_rad_per_s), 0.0,
                1e-15 * std::abs(block.a1_rad_per_s));
    EXPECT_NEAR(std::abs(first * second - block.a0_rad2_per_s2), 0.0, 1e-15 * block.a0_rad2_per_s2);
  }
}

}  // namespace
}  // namespace flexarm::measured
