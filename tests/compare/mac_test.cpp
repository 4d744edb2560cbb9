#include "compare/mac.hpp"

#include "tests/compare/models.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

namespace flexarm::compare {
namespace {

using Complex = std::complex<double>;
using Shape = std::vector<Complex>;
using measured::Feature;

/// sin(n pi x) at the inner points of an even grid: orthogonal for different n.
Shape sine(int n) {
  constexpr int kPoints = 12;
  Shape shape;
  for (int i = 1; i < kPoints; ++i) {
    shape.emplace_back(std::sin(n * std::numbers::pi * i / kPoints));
  }
  return shape;
}

/// Rounding of sums of a dozen products.
constexpr double kRounding = 1e-14;

TEST(Mac, IsOneForAComplexMultipleAndZeroForOrthogonalShapes) {
  for (int n = 1; n <= 5; ++n) {
    Shape turned = sine(n);
    for (auto& value : turned) value *= Complex(-0.3, 2.0);
    EXPECT_NEAR(mac(sine(n), turned), 1.0, kRounding);
    for (int m = 1; m < n; ++m) EXPECT_NEAR(mac(sine(n), sine(m)), 0.0, kRounding);
  }
}

TEST(Mac, IsTheSquaredCosineOfTheSum) {
  // (a + b)/sqrt 2 of two orthogonal shapes of one norm.
  Shape sum = sine(1);
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += sine(2)[i];
  EXPECT_NEAR(mac(sum, sine(1)), 0.5, kRounding);
}

TEST(Mac, OfComplexShapesConjugatesTheFirst) {
  const Shape wave = {1.0, Complex(0.0, 1.0)};
  const Shape opposite = {1.0, Complex(0.0, -1.0)};
  EXPECT_NEAR(mac(wave, wave), 1.0, kRounding);
  EXPECT_NEAR(mac(wave, opposite), 0.0, kRounding);
  EXPECT_TRUE(std::isnan(mac(wave, Shape{0.0, 0.0})));
}

class Correlated : public testing::Test {
 protected:
  static Options options() {
    Options few = quick();
    few.poles = 4;
    few.non_collocated_zeros = 1;
    few.response_points = 2;
    return few;
  }

  std::vector<arm::Sensor> gauges() const {
    std::vector<arm::Sensor> sensors;
    for (const double x_m : {0.0, 0.2, 0.4, 0.6, 0.8}) {
      sensors.push_back({arm::SensorKind::strain, x_m});
    }
    return sensors;
  }

  /// Rows of a mode stated as `order`, with the computed shape of mode `of` times `factor`.
  std::vector<MeasuredRow> rows(int order, int of, Complex factor,
                                const std::vector<arm::Sensor>& sensors) const {
    const auto subject = standard_subjects(arm::paper_arm(), 4).front();
    const auto mode =
        response::modes(subject.formulation, 4, sensors, {}).at(static_cast<std::size_t>(of) - 1);
    std::vector<MeasuredRow> all;
    for (std::size_t i = 0; i < sensors.size(); ++i) {
      MeasuredRow row;
      row.order = order;
      row.measured.feature = Feature::pole;
      row.measured.sensor = sensors[i];
      row.measured.shape_re = (factor * mode.sensor_values[i]).real();
      row.measured.shape_im = (factor * mode.sensor_values[i]).imag();
      all.push_back(row);
    }
    return all;
  }

  const Comparison comparison_ = compare(arm::paper_arm(), options());
};

/// The formulations agree to 1e-7 in shape, and the MAC is quadratic in an error.
constexpr double kAgreement = 1e-9;

TEST_F(Correlated, AMeasuredShapeIsThatOfItsModeByEveryFormulation) {
  const auto shapes = correlate_shapes(rows(2, 2, {0.7, -1.3}, gauges()), comparison_);
  ASSERT_TRUE(shapes);
  ASSERT_EQ(shapes->models.size(), 3U);
  ASSERT_EQ(shapes->model_frequencies_Hz.size(), 4U);
  EXPECT_NEAR(shapes->model_frequencies_Hz[0], 11.8618, 1e-4);
  for (const auto& matrix : shapes->mac) {
    ASSERT_EQ(matrix.size(), 1U);
    EXPECT_NEAR(matrix[0][1], 1.0, kAgreement);
    EXPECT_LT(matrix[0][0], 0.5);
    EXPECT_LT(matrix[0][2], 0.5);
  }
}

TEST_F(Correlated, AShapeUnderTheWrongOrderIsLow) {
  const auto shapes = correlate_shapes(rows(1, 3, 1.0, gauges()), comparison_);
  ASSERT_TRUE(shapes);
  EXPECT_LT(shapes->mac.front()[0][0], 0.3);
  EXPECT_NEAR(shapes->mac.front()[0][2], 1.0, kAgreement);
}

TEST_F(Correlated, UnlikeQuantitiesHaveOneScaleEach) {
  // Strains of 1e-2 beside displacements of 1 m: without scales the tip alone would count.
  auto sensors = gauges();
  sensors.push_back({arm::SensorKind::tip_displacement, 0.0});
  auto wrong = rows(1, 1, 1.0, sensors);
  const auto right = correlate_shapes(wrong, comparison_);
  for (std::size_t i = 0; i + 1 < wrong.size(); ++i) {
    wrong[i].measured.shape_re = -*wrong[i].measured.shape_re;
    wrong[i].measured.shape_im = 0.0;
  }
  EXPECT_NEAR(right->mac.front()[0][0], 1.0, kAgreement);
  EXPECT_LT(correlate_shapes(wrong, comparison_)->mac.front()[0][0], 0.8);
}

TEST_F(Correlated, OneSensorIsNoShapeAndTwoTellModesApartPoorly) {
  auto one = rows(1, 1, 1.0, {{arm::SensorKind::strain, 0.2}});
  EXPECT_FALSE(correlate_shapes(one, comparison_));
  EXPECT_FALSE(correlate_shapes({}, comparison_));
  const auto two = correlate_shapes(
      rows(1, 1, 1.0, {{arm::SensorKind::strain, 0.0}, {arm::SensorKind::strain, 0.01}}),
      comparison_);
  EXPECT_GT(two->largest_auto_mac, 0.99);
  const auto five = correlate_shapes(rows(1, 1, 1.0, gauges()), comparison_);
  EXPECT_LT(five->largest_auto_mac, 0.5);
}

}  // namespace
}  // namespace flexarm::compare
