// The common denominator and its chart: an arm's poles stay over the orders, noise has none that
// do.
#include "measured/modal/stabilisation.hpp"

#include "measured/modal/alias_placement.hpp"
#include "measured/modal/modal_fit.hpp"
#include "tests/fit_cases/fit_cases.hpp"
#include "tests/measured/fit_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace flexarm::measured {
namespace {

TEST(CommonDenominator, OfExactLinesHasTheirPoles) {
  // y = (1 + z)/(1 - 1.6 z^-1 ...) as a ratio with the poles 0.9 exp(+-0.7 i), inside the circle.
  const std::complex<double> p = std::polar(0.9, 0.7);
  constexpr Eigen::Index kLines = 200;
  DenominatorEquation equation{Eigen::ArrayXd::LinSpaced(kLines, 0.01, 3.1),
                               Eigen::ArrayXcd(kLines),
                               {Eigen::ArrayXcd::Ones(kLines)}};
  for (Eigen::Index k = 0; k < kLines; ++k) {
    const auto z = std::polar(1.0, equation.angle(k));
    equation.y(k) = (1.0 + z) / ((z - p) * (z - std::conj(p)));
  }
  const CommonDenominator denominator({equation}, 8);
  for (const int order : {2, 4, 8}) {
    const DenominatorPoles poles = denominator.poles(order);
    ASSERT_EQ(poles.z.size(), order);
    // Normal equations square the condition number: half the digits, at worst.
    EXPECT_LT((poles.z.array() - p).abs().minCoeff(), 1e-8) << order;
  }
}

OrderPoles order_with(int order, std::vector<std::complex<double>> poles) {
  const auto count = static_cast<Eigen::Index>(poles.size());
  return {order, std::move(poles), Eigen::MatrixXcd::Ones(2, count)};
}

TEST(StabilisationChart, FlagsWhatStays) {
  const std::complex<double> stays(-0.5, 70.0);
  const auto chart = stabilisation_chart(
      {order_with(2, {stays}), order_with(4, {stays * 1.001, {-2.0, 150.0}}),
       order_with(6, {stays, {-2.0, 190.0}}), order_with(8, {stays, {-9.0, 191.0}})},
      0.1, 100.0, {});
  EXPECT_THAT(chart.orders, testing::ElementsAre(2, 4, 6, 8));
  ASSERT_EQ(chart.poles.size(), 7U);
  EXPECT_FALSE(chart.poles[0].stable());  // nothing before the lowest order
  EXPECT_TRUE(chart.poles[1].stable());
  EXPECT_TRUE(chart.poles.back().frequency_stable);
  EXPECT_FALSE(chart.poles.back().damping_stable);
  const auto found = stable_poles(chart, 3);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].orders, 3);
}

TEST(StabilisationChart, OfAnArmHasAColumnAMode) {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  const std::array records = {record_of(fit_case)};
  const ModalFit fit = fit_modes(records, {.modes = 3});
  const auto found = stable_poles(fit.chart, 3);
  for (const auto& s : exact_roots(model_of(fit_case), 0).poles) {
    const bool there = std::ranges::any_of(found, [&](const StablePole& pole) {
      return std::abs(pole.frequency_Hz / natural_Hz(s) - 1.0) < 0.01;
    });
    EXPECT_TRUE(there) << natural_Hz(s);
  }
}

TEST(AliasPlacement, PutsHighModesWhereTheyBelong) {
  FitCase fit_case;
  fit_case.modes = 6;  // the last three above 100 Hz
  const std::array records = {record_of(fit_case)};
  const ModalFit fit = fit_modes(records);
  const auto exact = exact_roots(model_of(fit_case), 0).poles;
  ASSERT_EQ(fit.poles.size(), exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(fit.poles[i].frequency_Hz / natural_Hz(exact[i]), 1.0, 1e-6);
    EXPECT_EQ(fit.poles[i].is_mode, natural_Hz(exact[i]) < 100.0);
  }
  EXPECT_FALSE(fit.aliases.empty());
}

TEST(ResidualQuality, SaysThatAModeIsMissing) {
  FitCase fit_case;
  fit_case.relative_noise = 0.01;
  fit_case.duration_s = 20.0;
  const std::array records = {record_of(fit_case)};
  const ModalFit fit = fit_modes(records, {.modes = 2});
  EXPECT_TRUE(fit.robust_covariance);
  for (const FittedSensor& sensor : fit.sensors) {
    if (arm::derivative_order(sensor.sensor) == 0) continue;
    EXPECT_FALSE(sensor.residual.is_noise()) << arm::to_string(sensor.sensor);
    EXPECT_GT(sensor.residual.explained_share, 0.1);
  }
}

}  // namespace
}  // namespace flexarm::measured
