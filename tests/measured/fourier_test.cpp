#include "measured/spectra/fourier.hpp"

#include "arm/input_error.hpp"
#include "tests/measured/signals.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace flexarm::measured {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
/// Both the transform and the sum it is compared with are sums of n rounded terms: epsilon times
/// the root of their energy times a few for the direct sum's n.
double rounding(std::size_t n) {
  return kEpsilon * static_cast<double>(n);
}

TEST(RealTransformTest, IsTheSumAtAnyLength) {
  for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 7U, 8U, 12U, 30U, 49U, 64U, 97U, 101U, 121U, 211U,
                              1000U, 1009U, 1024U, 2018U}) {
    const auto x = white_noise(n, n);
    RealTransform transform(n);
    std::vector<std::complex<double>> found(transform.lines());
    ASSERT_EQ(found.size(), n / 2 + 1);
    transform(x, found);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_LT(std::abs(found[k] - direct_line(x, k)),
                10.0 * rounding(n) * std::sqrt(mean_square(x) * static_cast<double>(n)))
          << n << ", line " << k;
    }
  }
}

TEST(RealTransformTest, OfALargePrimeIsQuickAndAsExact) {
  constexpr std::size_t kPrime = 1'000'003;
  const auto x = white_noise(kPrime, 5);
  RealTransform transform(kPrime);
  std::vector<std::complex<double>> found(transform.lines());
  transform(x, found);
  // Parseval: sum x^2 = (X_0^2 + 2 sum |X_k|^2)/n for odd n.
  double power = std::norm(found[0]);
  for (std::size_t k = 1; k < found.size(); ++k) power += 2.0 * std::norm(found[k]);
  EXPECT_NEAR(power / static_cast<double>(kPrime * kPrime), mean_square(x), 1e-13);
  for (const std::size_t k : {1U, 499'999U}) {
    EXPECT_LT(std::abs(found[k] - direct_line(x, k)), 1e-9) << k;
  }
}

TEST(RealTransformTest, RefusesALengthThatIsNone) {
  EXPECT_THROW(RealTransform(0), arm::InputError);
  EXPECT_THROW(RealTransform(RealTransform::kMostSamples + 1), arm::InputError);
}

TEST(FastLength, IsTheNextMultipleOfFourWithoutLargeFactors) {
  EXPECT_EQ(fast_length(1), 4U);
  EXPECT_EQ(fast_length(64), 64U);
  EXPECT_EQ(fast_length(65), 72U);
  EXPECT_EQ(fast_length(1009), 1024U);
}

}  // namespace
}  // namespace flexarm::measured
