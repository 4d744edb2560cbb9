#include "exact_tf/analytic_zeros.hpp"

#include "exact_tf/numerator.hpp"
#include "sample_arms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace flexarm::exact_tf {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;

/// Simple zeros: brackets of 2^-61 and values that are lost to a few units of 2^-64 of their
/// largest term, which no zero below magnifies by more than 100.
constexpr Real kSimple = 1e-16L;

/// (sinh b + sin b)/b - J b^2 (cosh b - cos b), times exp(-Re b): the tip's numerator.
SectorFunction tip_function(Real payload_inertia) {
  return [=](const Complex& b) {
    const Complex growing = std::exp(Complex(0.0L, b.imag()));
    const Complex decaying = std::exp(-2.0L * b.real()) * std::conj(growing);
    const Real scale = std::exp(-b.real());
    return (0.5L * (growing - decaying) + std::sin(b) * scale) / b -
           payload_inertia * b * b * (0.5L * (growing + decaying) - std::cos(b) * scale);
  };
}

/// A zero of tip_function at z = -4 p^4: tan p = -1/(coth p + 4 J p^3), near n pi.
Real tip_zero(int n, Real payload_inertia) {
  Real p = n * kPi;
  for (int i = 0; i < 200; ++i) {
    p = n * kPi - std::atan(1.0L / (1.0L / std::tanh(p) + 4.0L * payload_inertia * p * p * p));
  }
  return std::numbers::sqrt2_v<Real> * p;
}

/// `base` with further zeros in z (those off the real axis with their conjugates).
SectorFunction with_zeros(SectorFunction base, std::vector<Complex> zeros) {
  return [base = std::move(base), zeros = std::move(zeros)](const Complex& lambda) {
    const Complex z = lambda * lambda * lambda * lambda;
    Complex value = base(lambda);
    for (const Complex& zero : zeros) {
      value *= 1.0L - z / zero;
      if (zero.imag() != 0.0L) value *= 1.0L - z / std::conj(zero);
    }
    return value;
  };
}

/// z of lambda, given by modulus and argument.
Complex z_at(Real modulus, Real angle) {
  return std::polar(std::pow(modulus, 4.0L), 4.0L * angle);
}

Real negative_z(Real modulus) {
  return -std::pow(modulus, 4.0L);
}

int number_at(const AnalyticZeros& result, ZeroLocus locus) {
  return static_cast<int>(std::count_if(result.zeros.begin(), result.zeros.end(),
                                        [=](const auto& zero) { return zero.locus == locus; }));
}

const AnalyticZero& nearest(const AnalyticZeros& result, const Complex& lambda) {
  return *std::min_element(result.zeros.begin(), result.zeros.end(),
                           [&](const auto& a, const auto& b) {
                             return std::abs(a.lambda - lambda) < std::abs(b.lambda - lambda);
                           });
}

void expect_complete(const AnalyticZeros& result, int count) {
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.missing(), 0);
  EXPECT_GE(std::ssize(result.zeros), count);
  EXPECT_TRUE(std::is_sorted(
      result.zeros.begin(), result.zeros.end(),
      [](const auto& a, const auto& b) { return std::abs(a.lambda) < std::abs(b.lambda); }));
}

TEST(AnalyticZeros, OfSinPlusSinhAreOnTheDiagonal) {
  constexpr int kCount = 300;
  const auto result = find_analytic_zeros(tip_function(0.0L), kCount);
  expect_complete(result, kCount);
  for (std::size_t i = 0; i < result.zeros.size(); ++i) {
    EXPECT_EQ(result.zeros[i].locus, ZeroLocus::negative_axis);
    const Real expected = tip_zero(static_cast<int>(i) + 1, 0.0L);
    EXPECT_LE(std::abs(std::abs(result.zeros[i].lambda) - expected), kSimple * expected);
  }
}

TEST(AnalyticZeros, OfOnePlusCosCoshAreReal) {
  constexpr int kCount = 100;
  const auto result = find_analytic_zeros(
      [](const Complex& b) {
        const Real scale = std::exp(-b.real() - b.imag());
        const Complex cosh_scaled = 0.5L * (std::exp(Complex(0.0L, b.imag())) +
                                            std::exp(Complex(-2.0L * b.real(), -b.imag())));
        return scale + std::cos(b) * std::exp(-b.imag()) * cosh_scaled;
      },
      kCount);
  expect_complete(result, kCount);
  for (std::size_t i = 0; i < result.zeros.size(); ++i) {
    EXPECT_EQ(result.zeros[i].locus, ZeroLocus::positive_axis);
    // cos b = -1/cosh b, by the fixed point about (n - 1/2) pi.
    const auto n = static_cast<Real>(i + 1);
    const Real side = i % 2 == 0 ? 1.0L : -1.0L;
    Real expected = (n - 0.5L) * kPi;
    for (int k = 0; k < 200; ++k) {
      expected = (n - 0.5L) * kPi + side * std::asin(1.0L / std::cosh(expected));
    }
    EXPECT_LE(std::abs(std::abs(result.zeros[i].lambda) - expected), kSimple * expected);
  }
}

class TipWithInertia : public testing::TestWithParam<Real> {};

TEST_P(TipWithInertia, HasOnePositiveZeroAmongTheNegativeOnes) {
  const Real inertia = GetParam();
  // For small J the positive zero comes last: b^3 = 1/J.
  const int count = 12 + static_cast<int>(std::cbrt(1.0L / inertia) / 4.0L);
  const auto result = find_analytic_zeros(tip_function(inertia), count);
  expect_complete(result, count);
  ASSERT_EQ(number_at(result, ZeroLocus::positive_axis), 1);
  int n = 0;
  for (const auto& zero : result.zeros) {
    const Real modulus = std::abs(zero.lambda);
    if (zero.locus == ZeroLocus::positive_axis) {
      const Real left = std::sin(modulus) + std::sinh(modulus);
      const Real right =
          inertia * std::pow(modulus, 3.0L) * (std::cosh(modulus) - std::cos(modulus));
      EXPECT_LE(std::abs(left / right - 1.0L), 10.0L * kSimple);
    } else {
      const Real expected = tip_zero(++n, inertia);
      EXPECT_LE(std::abs(modulus - expected), kSimple * expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(SmallToLarge, TipWithInertia,
                         testing::Values(1e-8L, 1e-4L, 0.02L, 1.0L, 1e4L));

TEST(AnalyticZeros, OffTheAxesAreFoundWithTheirConjugates) {
  const std::vector<Complex> lambdas = {std::polar(1.3L, 0.4L), std::polar(9.0L, 0.1L),
                                        std::polar(9.5L, 0.7L), std::polar(30.0L, 0.35L),
                                        std::polar(30.2L, 0.33L)};
  std::vector<Complex> zeros;
  for (const Complex& lambda : lambdas) zeros.push_back(std::pow(lambda, 4));
  constexpr int kCount = 20;
  const auto result = find_analytic_zeros(with_zeros(tip_function(0.0L), zeros), kCount);
  expect_complete(result, kCount);
  EXPECT_EQ(number_at(result, ZeroLocus::off_axis), std::ssize(lambdas));
  for (const Complex& lambda : lambdas) {
    const auto& found = nearest(result, lambda);
    EXPECT_EQ(found.locus, ZeroLocus::off_axis);
    EXPECT_LE(std::abs(found.lambda - lambda), kSimple * std::abs(lambda));
  }
}

TEST(AnalyticZeros, CloseToAnAxisAreToldFromDoubleOnes) {
  // A pair of angle d beside a double zero: N is lost to 2^-64 where N'' d^2/2 matters, hence
  // errors of 2^-64/d.
  for (const Real angle : {1e-3L, 1e-5L, 1e-7L}) {
    for (const bool at_negative : {false, true}) {
      const Real from_real = at_negative ? kSectorAngle - angle : angle;
      const auto result =
          find_analytic_zeros(with_zeros(tip_function(0.0L), {z_at(11.0L, from_real)}), 6);
      expect_complete(result, 6);
      EXPECT_EQ(number_at(result, ZeroLocus::off_axis), 1);
      const Complex expected = std::polar(11.0L, from_real);
      EXPECT_LE(std::abs(nearest(result, expected).lambda - expected), 11.0L * 1e-17L / angle);
    }
  }
}

TEST(AnalyticZeros, NearlyDoubleOnesAreTakenApart) {
  for (const Real gap : {1e-2L, 1e-5L, 1e-8L}) {
    const std::vector<Complex> zeros = {negative_z(7.0L), negative_z(7.0L * (1.0L + gap)),
                                        std::pow(10.0L, 4.0L),
                                        std::pow(10.0L * (1.0L + gap), 4.0L)};
    const auto result = find_analytic_zeros(with_zeros(tip_function(0.0L), zeros), 8);
    expect_complete(result, 8);
    EXPECT_EQ(number_at(result, ZeroLocus::positive_axis), 2);
    EXPECT_EQ(number_at(result, ZeroLocus::off_axis), 0);
    for (const Real modulus : {7.0L, 10.0L}) {
      const Real angle = modulus == 7.0L ? kSectorAngle : 0.0L;
      for (const Real expected : {modulus, modulus * (1.0L + gap)}) {
        const auto& found = nearest(result, on_ray(expected, angle));
        EXPECT_LE(std::abs(std::abs(found.lambda) - expected), expected * 1e-17L / gap);
      }
    }
  }
}

TEST(AnalyticZeros, DoubleOnesCountTwice) {
  const Complex zero = negative_z(7.0L);
  const auto result = find_analytic_zeros(with_zeros(tip_function(0.0L), {zero, zero}), 5);
  expect_complete(result, 5);
  // A double zero is known to the root of the rounding only.
  const Real tolerance = 7.0L * 1e-8L;
  int near = 0;
  for (const auto& found : result.zeros) {
    if (std::abs(found.lambda - on_ray(7.0L, kSectorAngle)) <= tolerance) {
      near += found.multiplicity();
    }
  }
  EXPECT_EQ(near, 2);
}

TEST(AnalyticZeros, ThatACoarseSearchMissesAreRevealedByTheCount) {
  const std::vector<Complex> pair = {std::pow(5.0L, 4.0L), std::pow(5.2L, 4.0L)};
  const auto function = with_zeros(tip_function(0.0L), pair);
  AnalyticZeroOptions coarse;
  coarse.axis_step = 2.0L;
  coarse.locate_missing = false;
  const auto searched = find_analytic_zeros(function, 6, coarse);
  EXPECT_FALSE(searched.converged);
  EXPECT_EQ(searched.missing(), 2);
  EXPECT_EQ(number_at(searched, ZeroLocus::positive_axis), 0);

  coarse.locate_missing = true;
  const auto located = find_analytic_zeros(function, 6, coarse);
  expect_complete(located, 6);
  EXPECT_EQ(number_at(located, ZeroLocus::positive_axis), 2);
}

TEST(AnalyticZeros, ArePrescribedOnesWhereverTheseLie) {
  std::mt19937 generator(20260);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<Complex> lambdas;
    for (int i = 0; i < 6; ++i) {
      const Real modulus = 0.5L + 20.0L * static_cast<Real>(uniform(generator));
      const double place = uniform(generator);
      const Real angle = place < 0.3   ? 0.0L
                         : place < 0.6 ? kSectorAngle
                                       : kSectorAngle * static_cast<Real>(uniform(generator));
      lambdas.push_back(on_ray(modulus, angle));
    }
    std::vector<Complex> zeros;
    for (const Complex& lambda : lambdas) {
      const Real angle = std::arg(lambda);
      const Real fourth = std::pow(std::abs(lambda), 4.0L);
      zeros.push_back(angle == 0.0L                             ? Complex(fourth)
                      : std::abs(angle - kSectorAngle) < 1e-15L ? Complex(-fourth)
                                                                : std::polar(fourth, 4.0L * angle));
    }
    constexpr int kCount = 12;
    const auto result = find_analytic_zeros(with_zeros(tip_function(0.0L), zeros), kCount);
    expect_complete(result, kCount);
    for (const Complex& lambda : lambdas) {
      if (std::abs(lambda) > result.radius) continue;
      // Neighbours at distance d, 1e-3 at the least here, cost 1/d.
      EXPECT_LE(std::abs(nearest(result, lambda).lambda - lambda), 1e-13L * std::abs(lambda))
          << "trial " << trial << ", lambda = " << lambda;
    }
  }
}

TEST(AnalyticZeros, NeedAFunctionThatIsNotZeroAtTheOrigin) {
  const auto function = [](const Complex& lambda) {
    return tip_function(0.0L)(lambda) * std::pow(lambda, 4);
  };
  EXPECT_THROW(find_analytic_zeros(function, 3), std::domain_error);
  EXPECT_THROW(find_analytic_zeros(tip_function(0.0L), 0), std::invalid_argument);
}

TEST(ArgumentPrinciple, CountsDoubleZerosBesideTheContour) {
  // A double zero turns the argument by almost a whole turn between two samples.
  constexpr Real kModulus = 20.0L;
  const int without = 4;  // tip_zero(4) is below 20, tip_zero(5) above
  for (Real angle = 0.1L; angle < 0.7L; angle += 0.0371L) {
    const Complex zero = z_at(kModulus, angle);
    const auto function = with_zeros(tip_function(0.0L), {zero, zero});
    for (const Real distance : {0.1L, 1e-3L, 1e-6L}) {
      ArgumentPrinciple principle(function, {});
      EXPECT_EQ(principle.count({0.0L, kModulus - distance}), without);
      EXPECT_EQ(principle.count({0.0L, kModulus + distance}), without + 4);
      EXPECT_EQ(principle.count({kModulus - distance, kModulus + distance}), 4);
    }
  }
}

TEST(ArgumentPrinciple, CountsInBoxesWithTheirMirrorImages) {
  const auto function =
      with_zeros(tip_function(0.0L), {z_at(5.0L, 0.3L), std::pow(6.0L, 4.0L), negative_z(6.5L)});
  ArgumentPrinciple principle(function, {});
  EXPECT_EQ(principle.count({4.0L, 7.0L}), 4);
  EXPECT_EQ(principle.count({4.0L, 7.0L, 0.2L, 0.4L}), 2);
  EXPECT_EQ(principle.count({4.0L, 7.0L, 0.0L, 0.2L}), 1);
  EXPECT_EQ(principle.count({4.0L, 7.0L, 0.4L, kSectorAngle}), 1);
  EXPECT_EQ(principle.count({4.0L, 5.5L, 0.0L, 0.25L}), 0);
}

TEST(ArgumentPrinciple, DeclinesOnAZero) {
  const auto function = with_zeros(tip_function(0.0L), {z_at(5.0L, 0.3L)});
  ArgumentPrinciple principle(function, {});
  EXPECT_EQ(principle.count({4.0L, 5.0L}), std::nullopt);
}

/// Strain and deflection numerators of arms over the whole range of payloads: the coarse and the
/// fine search end at the same zeros.
TEST(AnalyticZeros, DoNotDependOnTheStepOfTheSearch) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 60; ++trial) {
    const double mass = std::pow(10.0, -3.0 + 5.0 * uniform(generator));
    const double inertia = std::pow(10.0, -6.0 + 6.0 * uniform(generator));
    const arm::Arm arm = unit_arm(0.1, mass, inertia);
    const arm::LinearArm linear = linear_arm(arm);
    const arm::Sensor sensor = trial % 4 == 0
                                   ? arm::Sensor{arm::SensorKind::tip_deflection}
                                   : arm::Sensor{arm::SensorKind::strain, uniform(generator)};
    const auto numerator = [&](const Complex& lambda) {
      return sensor_numerator(linear, inertia_ratios(linear), sensor, lambda).value;
    };
    AnalyticZeroOptions coarse;
    coarse.axis_step = 6.0L;
    AnalyticZeroOptions fine;
    fine.axis_step = 0.1L;
    fine.contour.piece = 0.1L;
    constexpr int kCount = 10;
    const auto a = find_analytic_zeros(numerator, kCount, coarse);
    const auto b = find_analytic_zeros(numerator, kCount, fine);
    expect_complete(a, kCount);
    expect_complete(b, kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      EXPECT_LE(std::abs(a.zeros[i].lambda - b.zeros[i].lambda),
                1e-15L * std::abs(b.zeros[i].lambda))
          << arm.name << ", " << to_string(sensor) << ", zero " << i + 1;
    }
  }
}

}  // namespace
}  // namespace flexarm::exact_tf
