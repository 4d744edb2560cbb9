#include "response/residual_mode.hpp"

#include "response/frequency/frequency_response.hpp"
#include "response/frequency/modal_response.hpp"
#include "tests/response/models.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace flexarm::response {
namespace {

using Complex = std::complex<double>;

/// Slope of log |error| over log omega, least squares.
double fitted_order(const std::vector<double>& omega, const std::vector<double>& error) {
  double x_mean = 0.0;
  double y_mean = 0.0;
  const auto n = static_cast<double>(omega.size());
  for (std::size_t i = 0; i < omega.size(); ++i) {
    x_mean += std::log(omega[i]) / n;
    y_mean += std::log(error[i]) / n;
  }
  double xy = 0.0;
  double xx = 0.0;
  for (std::size_t i = 0; i < omega.size(); ++i) {
    const double x = std::log(omega[i]) - x_mean;
    xy += x * (std::log(error[i]) - y_mean);
    xx += x * x;
  }
  return xy / xx;
}

/// Orders in omega of the modal sum's error at each sensor, over a range in which neither rounding
/// nor the next order counts: the error of the hub, which falls faster, is rounding before.
std::vector<double> orders(const AnyFormulation& formulation, const arm::ModalModel& model,
                           double first_left_out) {
  std::vector<double> fitted;
  for (std::size_t k = 0; k < every_sensor().size(); ++k) {
    const double from = arm::is_collocated(every_sensor()[k]) ? 0.12 : 0.04;
    std::vector<double> omega;
    for (double ratio = from; ratio < 2.5 * from; ratio *= 1.07) {
      omega.push_back(ratio * first_left_out);
    }
    std::vector<double> error;
    for (const double w : omega) {
      const Complex s(0.0, w);
      error.push_back(std::abs(transfer_function(formulation, every_sensor()[k], s) -
                               modal_response(model, every_sensor(), s)[k]));
    }
    fitted.push_back(fitted_order(omega, error));
  }
  return fitted;
}

TEST(ResidualMode, ErrorsBetweenTheKeptModesFallByTwoAndFourOrdersMore) {
  // The next order is (omega/omega_{n+1})^2 of it, 1 to 10 % over the range, or a little more.
  constexpr double kNextOrder = 0.2;
  constexpr int kModes = 4;
  for (const char* name : kFormulations) {
    arm::Arm arm = arm::paper_arm();
    arm.payload.mass_kg = 0.03;
    const auto formulation = make_formulation(name, arm, 20);
    const double left_out = poles(formulation, kModes + 1).omega_rad_per_s.back();
    const auto kept = modal_model(formulation, kModes, every_sensor(), {});
    const auto without = orders(formulation, kept, left_out);
    const auto with =
        orders(formulation, with_residual_mode(formulation, kept, every_sensor()), left_out);
    for (std::size_t k = 0; k < every_sensor().size(); ++k) {
      const arm::Sensor& sensor = every_sensor()[k];
      const int derivatives = arm::derivative_order(sensor);
      EXPECT_NEAR(without[k], derivatives, kNextOrder) << name << " " << arm::to_string(sensor);
      EXPECT_NEAR(with[k], derivatives + (arm::is_collocated(sensor) ? 4 : 2), kNextOrder)
          << name << " " << arm::to_string(sensor);
    }
  }
}

TEST(ResidualMode, DampedResponsesGainAsMuch) {
  constexpr int kModes = 4;
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, damped_arm(), 20);
    const auto kept = modal_model(formulation, kModes, every_sensor(), {});
    const auto corrected = with_residual_mode(formulation, kept, every_sensor());
    const double left_out = poles(formulation, kModes + 1).omega_rad_per_s.back();
    const auto at = [&](const arm::ModalModel& model, std::size_t k) {
      double largest = 0.0;
      for (const double ratio : {0.05, 0.1, 0.2}) {
        const Complex s(0.0, ratio * left_out);
        const Complex exact = transfer_function(formulation, every_sensor()[k], s);
        const Complex modal = modal_response(model, every_sensor(), s)[k];
        largest = std::max(largest, std::abs(modal - exact) / std::abs(exact));
      }
      return largest;
    };
    for (std::size_t k = 0; k < every_sensor().size(); ++k) {
      EXPECT_LT(at(corrected, k), 0.1 * at(kept, k))
          << name << " " << arm::to_string(every_sensor()[k]);
    }
  }
}

TEST(ResidualMode, TheStaticShareOfTheModesLeftOutIsTheirSum) {
  // Terms fall as i^-8 at the hub, as i^-6 at the tip, as i^-4 in strain, and the sums are cut off:
  // what is missing is of the next power.
  constexpr std::array kTailOrder = {7, 7, 5, 5, 5, 3};
  constexpr double kRounding = 1e-9;  // of the sum, a hundredth of the hub's own response
  constexpr std::size_t kAll = 150;
  const auto formulation = make_formulation("exact_tf", damped_arm(), kAll);
  const auto all = modal_model(formulation, kAll, every_sensor(), {});
  for (const int kept_modes : {1, 2, 5, 12, 30}) {
    const auto model = with_residual_mode(
        formulation, modal_model(formulation, kept_modes, every_sensor(), {}), every_sensor());
    const arm::Mode& residual = model.modes.back();
    for (std::size_t k = 0; k < every_sensor().size(); ++k) {
      double sum = 0.0;
      for (std::size_t i = kAll; i > static_cast<std::size_t>(kept_modes); --i) {
        sum += all.modes[i].sensor_values[k] * all.modes[i].hub_slope / omega_squared(all, i);
      }
      const double found = residual.sensor_values[k] * residual.hub_slope /
                           (residual.omega_rad_per_s * residual.omega_rad_per_s);
      const auto& first = all.modes[static_cast<std::size_t>(kept_modes) + 1];
      const double size = std::abs(first.sensor_values[k] * first.hub_slope) /
                          (first.omega_rad_per_s * first.omega_rad_per_s);
      EXPECT_NEAR(
          found, sum,
          (kRounding + kept_modes * std::pow(double(kept_modes) / kAll, kTailOrder[k])) * size)
          << kept_modes << " " << arm::to_string(every_sensor()[k]);
    }
  }
}

TEST(ResidualMode, ItsFrequencyAndSlopeFollowFromTheHubsMoments) {
  constexpr std::size_t kAll = 150;
  const auto formulation = make_formulation("exact_tf", arm::paper_arm(), kAll);
  const auto all = modal_model(formulation, kAll, {}, {});
  for (const std::size_t kept : {1U, 4U, 20U}) {
    double a0 = 0.0;
    double a1 = 0.0;
    for (std::size_t i = kAll; i > kept; --i) {
      const double squared = omega_squared(all, i);
      const double term =
          all.modes[i].hub_slope * all.modes[i].hub_slope / (all.modal_mass_kg_m2 * squared);
      a0 += term;
      a1 += term / squared;
    }
    const auto model = with_residual_mode(
        formulation, modal_model(formulation, static_cast<int>(kept), {}, {}), {});
    // Rounding, and the tail of a sum of i^-8 that is cut off.
    const double kCancelled = 1e-9 + 2.0 * std::pow(double(kept) / kAll, 7);
    const double omega = model.modes.back().omega_rad_per_s;
    EXPECT_NEAR(omega * omega, a0 / a1, kCancelled * a0 / a1) << kept;
    const double slope = model.modes.back().hub_slope;
    EXPECT_NEAR(slope, a0 * std::sqrt(all.modal_mass_kg_m2 / a1), kCancelled * slope) << kept;
  }
}

TEST(ResidualMode, StaticGainsAreExact) {
  // At omega_1/1000 the next order is 1e-6 (omega_1/omega_n+1)^2 of what is left out.
  constexpr double kStatic = 1e-9;
  for (const char* name : kFormulations) {
    const auto formulation = make_formulation(name, arm::paper_arm(), 12);
    const auto kept = modal_model(formulation, 3, every_sensor(), {});
    const auto corrected = with_residual_mode(formulation, kept, every_sensor());
    const Complex s(0.0, 1e-3 * kept.modes[1].omega_rad_per_s);
    for (std::size_t k : {4U, 5U}) {  // tip deflection and strain have no rigid-body part
      const Complex exact = transfer_function(formulation, every_sensor()[k], s);
      EXPECT_LT(std::abs(modal_response(corrected, every_sensor(), s)[k] - exact),
                kStatic * std::abs(exact))
          << name << " " << k;
      EXPECT_GT(std::abs(modal_response(kept, every_sensor(), s)[k] - exact),
                1e-5 * std::abs(exact));
    }
  }
}

TEST(ResidualMode, DampingStaysPositiveAndIsThatOfItsShape) {
  const auto formulation = make_formulation("exact_tf", damped_arm(), 12);
  const auto kept = modal_model(formulation, 5, every_sensor(), {});
  const auto model = with_residual_mode(formulation, kept, every_sensor());
  EXPECT_NO_THROW(require_consistent(model, every_sensor()));
  const std::size_t n = model.modes.size();
  ASSERT_EQ(n, 7U);
  // Of Kelvin-Voigt damping and friction the projection is known in closed form.
  constexpr double kRounding = 1e-8;  // of the hub's moments
  const arm::Mode& residual = model.modes.back();
  const double friction = 2e-3 / model.modal_mass_kg_m2;
  const double expected = 1e-4 * residual.omega_rad_per_s * residual.omega_rad_per_s +
                          friction * residual.hub_slope * residual.hub_slope;
  EXPECT_NEAR(model.damping_rad_per_s.back(), expected, kRounding * expected);
  EXPECT_DOUBLE_EQ(residual.damping_ratio,
                   model.damping_rad_per_s.back() / (2.0 * residual.omega_rad_per_s));
  for (std::size_t j = 0; j + 1 < n; ++j) {
    const double coupling = friction * residual.hub_slope * model.modes[j].hub_slope;
    EXPECT_NEAR(model.damping_rad_per_s[(n - 1) * n + j], coupling, kRounding * coupling);
    for (std::size_t i = 0; i + 1 < n; ++i) {
      EXPECT_EQ(model.damping_rad_per_s[i * n + j], kept.damping_rad_per_s[i * (n - 1) + j]);
    }
  }
}

TEST(ResidualMode, AHubThatHardlyMovesTakesTheFirstModeLeftOut) {
  arm::Arm arm = arm::paper_arm();
  for (const double hub_inertia_kg_m2 : {1.0, 1e4, 1e9}) {
    arm.hub.inertia_kg_m2 = hub_inertia_kg_m2;
    const auto formulation = make_formulation("exact_tf", arm, 12);
    const auto known = modes(formulation, 5, every_sensor(), {});
    const auto model = with_residual_mode(
        formulation, modal_model(formulation, 4, every_sensor(), {}), every_sensor());
    const arm::Mode& residual = model.modes.back();
    // Terms fall as i^-8 where the hub is heavy: the first has all but (9/11)^8 of them.
    EXPECT_GE(residual.omega_rad_per_s, known[4].omega_rad_per_s * (1.0 - 1e-12));
    EXPECT_LT(residual.omega_rad_per_s, known[4].omega_rad_per_s * 1.2);
    EXPECT_GT(residual.hub_slope, 0.9 * known[4].hub_slope);
    for (std::size_t k = 0; k < every_sensor().size(); ++k) {
      const double ratio = residual.sensor_values[k] / known[4].sensor_values[k];
      EXPECT_GT(ratio, 0.4) << hub_inertia_kg_m2 << " " << arm::to_string(every_sensor()[k]);
      EXPECT_LT(ratio, 2.5) << hub_inertia_kg_m2 << " " << arm::to_string(every_sensor()[k]);
    }
  }
}

TEST(ResidualMode, AModelWithAllItsModesIsLeftAsItIs) {
  const AnyFormulation coarse =
      fem::FemArm(arm::paper_arm(), {.mesh = {.elements = 2}, .degree = 3});
  const int flexible = degrees_of_freedom(coarse) - 1;
  const auto all = modal_model(coarse, flexible, every_sensor(), {});
  EXPECT_EQ(with_residual_mode(coarse, all, every_sensor()).modes.size(), all.modes.size());
  // One mode is left out: the pseudo-mode is that mode.
  const auto most = with_residual_mode(
      coarse, modal_model(coarse, flexible - 1, every_sensor(), {}), every_sensor());
  ASSERT_EQ(most.modes.size(), all.modes.size());
  constexpr double kCancelled = 1e-6;
  EXPECT_NEAR(most.modes.back().omega_rad_per_s, all.modes.back().omega_rad_per_s,
              kCancelled * all.modes.back().omega_rad_per_s);
  // Not for deflection and strain: a mesh takes them from the inertia forces, which are not all in
  // its modes.
  for (std::size_t k = 0; k < 4; ++k) {
    const double expected = all.modes.back().sensor_values[k];
    EXPECT_NEAR(most.modes.back().sensor_values[k], expected, kCancelled * std::abs(expected));
  }
}

TEST(ResidualMode, StationsStayAtRestAndAnotherModelIsRefused) {
  const auto formulation = make_formulation("exact_tf", arm::paper_arm(), 5);
  const std::array stations_m = {0.1, 0.5};
  const auto kept = modal_model(formulation, 2, every_sensor(), stations_m);
  EXPECT_EQ(with_residual_mode(formulation, kept, every_sensor()).modes.back().displacement_m,
            (std::vector<double>{0.0, 0.0}));
  EXPECT_THROW(with_residual_mode(formulation, kept, {}), std::invalid_argument);
  EXPECT_THROW(with_residual_mode(formulation, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::response
