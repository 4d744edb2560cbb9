#include "diagnose/search/line_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>

namespace flexarm::diagnose {
namespace {

constexpr int kValues = 40;
constexpr int kSamples = 400;

using Eigen::VectorXd;

struct Found {
  int best = 0;
  int looks = 0;
};

Found scanned(const ResidualsAtValue& residuals) {
  Found found;
  found.best = least_on_line(
      [&](int i) {
        ++found.looks;
        return residuals(i);
      },
      kValues);
  return found;
}

int by_all(const ResidualsAtValue& residuals) {
  double least = std::numeric_limits<double>::infinity();
  int best = 0;
  for (int i = 0; i < kValues; ++i) {
    const auto left = residuals(i);
    if (!left || left->norm() >= least) continue;
    least = left->norm();
    best = i;
  }
  return best;
}

VectorXd sine(double cycles) {
  return VectorXd::LinSpaced(kSamples, 0.0, 2.0 * M_PI * cycles).array().sin();
}

/// A wrong size of something beside what is left, at unequal steps.
TEST(LineScan, LooksAtFewValuesOfWhatIsLinear) {
  for (const double size : {0.02, 0.3, 0.97}) {
    const auto residuals = [&](int i) -> std::optional<VectorXd> {
      const double at = std::pow((i + 0.5) / kValues, 2);
      return VectorXd(0.1 * sine(31.0) + (size - at) * sine(3.0));
    };
    const Found found = scanned(residuals);
    EXPECT_EQ(found.best, by_all(residuals));
    EXPECT_LE(found.looks, 12);
  }
}

/// A time constant: the course turns, but never by much.
TEST(LineScan, FindsTheLeastOfACourseThatBends) {
  const VectorXd time = VectorXd::LinSpaced(kSamples, 0.0, 1.0);
  for (const double constant : {0.03, 0.1, 0.4}) {
    const auto residuals = [&](int i) -> std::optional<VectorXd> {
      const double at = 0.01 * std::pow(100.0, (i + 0.5) / kValues);
      return VectorXd((-time.array() / at).exp() - (-time.array() / constant).exp());
    };
    const Found found = scanned(residuals);
    EXPECT_EQ(found.best, by_all(residuals));
    EXPECT_LE(found.looks, 25);
  }
}

/// A frequency of which 1 value in 40 lies in the only minimum: the phase turns over between all
/// others, and most of them leave more than the first, which does next to nothing.
TEST(LineScan, FindsANarrowMinimumOfAFrequency) {
  for (const int place : {1, 13, 38}) {
    const auto residuals = [&](int i) -> std::optional<VectorXd> {
      const VectorXd rest = 0.1 * sine(7.0);
      if (i == 0) return VectorXd(rest + 0.3 * sine(9.0));
      return VectorXd(rest + sine(20.0 + place) - sine(20.0 + i));
    };
    EXPECT_EQ(scanned(residuals).best, place);
  }
}

TEST(LineScan, PassesOverValuesThatCannotBeComputed) {
  const auto residuals = [](int i) -> std::optional<VectorXd> {
    if (i == 0 || i == 20 || i == kValues - 1) return std::nullopt;
    return VectorXd((i - 17.2) * sine(3.0));
  };
  EXPECT_EQ(scanned(residuals).best, 17);
  EXPECT_EQ(scanned([](int) { return std::optional<VectorXd>(); }).best, 0);
}

TEST(LineScan, OfOneValueAndOfTwo) {
  const auto residuals = [](int i) { return std::optional<VectorXd>((2.0 - i) * sine(3.0)); };
  EXPECT_EQ(least_on_line(residuals, 1), 0);
  EXPECT_EQ(least_on_line(residuals, 2), 1);
}

}  // namespace
}  // namespace flexarm::diagnose
