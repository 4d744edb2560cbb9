#include "measured/spectra/tail_probability.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace flexarm::measured {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Of tabulated quantiles of six digits.
constexpr double kDigits = 1e-6;

TEST(TailProbability, IsThatOfTables) {
  EXPECT_NEAR(chi_squared_tail(18.307038, 10.0), 0.05, kDigits);
  EXPECT_NEAR(f_tail(3.325835, 5.0, 10.0), 0.05, kDigits);
  EXPECT_NEAR(normal_tails(-1.959964), 0.05, kDigits);
  EXPECT_NEAR(students_t_tails(2.228139, 10.0), 0.05, kDigits);
  EXPECT_NEAR(students_t_tails(-2.228139, 10.0), 0.05, kDigits);
}

TEST(TailProbability, WithNoncentralityIsAboveThatWithout) {
  EXPECT_EQ(chi_squared_tail(18.3, 10.0, 0.0), chi_squared_tail(18.3, 10.0));
  EXPECT_GT(chi_squared_tail(18.3, 10.0, 4.0), chi_squared_tail(18.3, 10.0));
}

TEST(TailProbability, OfWhatIsNoNumberIsOne) {
  EXPECT_EQ(chi_squared_tail(kNaN, 10.0), 1.0);
  EXPECT_EQ(chi_squared_tail(kNaN, 10.0, 1.0), 1.0);
  EXPECT_EQ(f_tail(kNaN, 5.0, 10.0), 1.0);
  EXPECT_EQ(normal_tails(kNaN), 1.0);
  EXPECT_EQ(students_t_tails(kNaN, 5.0), 1.0);
}

TEST(TailProbability, WithoutDegreesOfFreedomIsOne) {
  for (const double freedom : {0.0, -1.0, kNaN}) {
    EXPECT_EQ(chi_squared_tail(3.0, freedom), 1.0);
    EXPECT_EQ(f_tail(3.0, freedom, 10.0), 1.0);
    EXPECT_EQ(f_tail(3.0, 10.0, freedom), 1.0);
    EXPECT_EQ(students_t_tails(3.0, freedom), 1.0);
  }
}

TEST(TailProbability, BeyondEveryValueIsZeroAndBelowAllOne) {
  EXPECT_EQ(chi_squared_tail(kInfinity, 10.0), 0.0);
  EXPECT_EQ(f_tail(kInfinity, 5.0, 10.0), 0.0);
  EXPECT_EQ(normal_tails(-kInfinity), 0.0);
  EXPECT_EQ(students_t_tails(kInfinity, 5.0), 0.0);
  EXPECT_EQ(chi_squared_tail(-1e-12, 10.0), 1.0);
  EXPECT_EQ(f_tail(-1e-12, 5.0, 10.0), 1.0);
  EXPECT_EQ(normal_tails(0.0), 1.0);
  EXPECT_EQ(students_t_tails(0.0, 5.0), 1.0);
}

}  // namespace
}  // namespace flexarm::measured
