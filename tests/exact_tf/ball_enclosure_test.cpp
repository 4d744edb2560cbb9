#include "exact_tf/ball_enclosure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flexarm::exact_tf::ball {
namespace {

ComplexBall number(double real, double imaginary = 0.0) {
  return {RealBall(real), RealBall(imaginary)};
}

/// (w - 1 - 2i)^2 (w - 3), of winding number 2, 1 and 3.
ComplexBall cubic(const ComplexBall& w) {
  const ComplexBall double_factor = w - number(1.0, 2.0);
  return double_factor * double_factor * (w - number(3.0));
}

std::optional<long> winding_number(double x, double y, double radius) {
  long values_left = 10'000;
  const auto circle = [=](const RealBall& t) {
    return number(x, y) + number(radius) * ComplexBall::unit_at_half_turns(t + t);
  };
  const auto change = argument_change(cubic, circle, values_left);
  if (!change) return std::nullopt;
  return (*change / (RealBall(2) * RealBall::pi())).unique_integer();
}

TEST(BallEnclosure, WindingNumbersCountZerosWithMultiplicity) {
  EXPECT_EQ(winding_number(0.0, 0.0, 10.0), 3);
  EXPECT_EQ(winding_number(1.0, 2.0, 1.0), 2);
  EXPECT_EQ(winding_number(3.0, 0.0, 0.5), 1);
  EXPECT_EQ(winding_number(-3.0, 0.0, 0.5), 0);
  // Just inside and just outside.
  EXPECT_EQ(winding_number(0.0, 0.0, 3.0 + 1e-12), 3);
  EXPECT_EQ(winding_number(0.0, 0.0, 3.0 - 1e-12), 2);
}

TEST(BallEnclosure, WindingNumbersAreRefusedOnAZero) {
  EXPECT_EQ(winding_number(2.0, 0.0, 1.0), std::nullopt);
}

TEST(BallEnclosure, ComplexZerosAreEnclosed) {
  // cosh w = 2 at acosh 2 + 2 pi i.
  const auto function = [](const ComplexBall& w) { return exp(w) + exp(-w) - number(4.0); };
  constexpr double kReach = 1e-18;
  const auto zero = enclose_complex_zero(function, number(1.3, 6.28), kReach);
  ASSERT_TRUE(zero);
  const auto exact = ComplexBall(RealBall(std::acosh(2.0)), RealBall(2.0) * RealBall::pi());
  EXPECT_LE(abs(*zero - exact).upper_bound(), 1e-15);  // acosh in double
  EXPECT_TRUE(function(*zero).contains_zero());
}

TEST(BallEnclosure, DoubleZerosAreNotTakenForSingleOnes) {
  EXPECT_FALSE(enclose_complex_zero(cubic, number(1.0, 2.0 + 1e-10), 1e-12));
}

TEST(BallEnclosure, SignChangesAreEnclosedAndTangenciesAreNot) {
  const auto root_of_two = enclose_sign_change(
      [](const RealBall& x) { return x * x - RealBall(2); }, RealBall(1.4), 1e-18);
  ASSERT_TRUE(root_of_two);
  EXPECT_LE(std::abs((*root_of_two - sqrt(RealBall(2))).upper_bound()), 2e-18);
  EXPECT_FALSE(
      enclose_sign_change([](const RealBall& x) { return (x - RealBall(2)) * (x - RealBall(2)); },
                          RealBall(1.4), 1e-18));
  EXPECT_FALSE(enclose_sign_change([](const RealBall& x) { return x * x + RealBall(1); },
                                   RealBall(1.4), 1e-18));
}

}  // namespace
}  // namespace flexarm::exact_tf::ball
