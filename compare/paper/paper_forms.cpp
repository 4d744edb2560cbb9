#include "compare/paper/paper_forms.hpp"

#include <Eigen/LU>
#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace flexarm::compare::paper {

namespace {

using Complex = std::complex<double>;
using Row = Eigen::RowVector4cd;

/// Row of the coefficients of the derivative of order `order` at beta x, over beta^order.
Row derivative(Complex argument, int order) {
  const Complex s = std::sin(argument), c = std::cos(argument);
  const Complex sh = std::sinh(argument), ch = std::cosh(argument);
  const bool odd = order % 2 == 1;
  const double sign = order % 4 < 2 ? 1.0 : -1.0;
  return {sign * (odd ? c : s), sign * (odd ? -s : c), odd ? ch : sh, odd ? sh : ch};
}

double refine(const std::function<double(double)>& f, double low, double high) {
  std::uintmax_t iterations = 200;
  const auto [a, b] = boost::math::tools::toms748_solve(
      f, low, high, boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (a + b);
}

}  // namespace

Eigen::Matrix4cd matrix_22(const arm::Arm& arm, Complex beta, Form form) {
  const double m = arm.beam.linear_density_kg_per_m();
  const Complex tip = beta * arm.beam.length_m;
  const Complex b2 = beta * beta, b3 = b2 * beta, b4 = b2 * b2, b5 = b4 * beta;
  Eigen::Matrix4cd s;
  s.row(0) = derivative(0.0, 0);
  s.row(1) = b5 * arm.hub.inertia_kg_m2 / m * derivative(0.0, 1) + b2 * derivative(0.0, 2);
  s.row(2) = b5 * arm.payload.inertia_kg_m2 / m * derivative(tip, 1) - b2 * derivative(tip, 2);
  s.row(3) = b4 * arm.payload.mass_kg / m * derivative(tip, 0) + b3 * derivative(tip, 3);
  if (form == Form::printed) {
    s.row(0) += beta * Row(-1.0, 0.0, 1.0, 0.0);
    s.row(1) += b3 * Row(1.0, 0.0, -1.0, 0.0);
  }
  return s;
}

Eigen::Matrix4cd matrix_14_printed(const arm::Arm& arm, Complex beta) {
  Eigen::Matrix4cd s = matrix_22(arm, beta, Form::corrected);
  const Complex tip = beta * arm.beam.length_m;
  const double ei = arm.beam.flexural_rigidity_N_m2();
  s.row(3) = beta * beta * beta * derivative(tip, 3) -
             arm.payload.mass_kg / ei * beta * beta * derivative(tip, 2);
  return s;
}

double scaled_determinant(const Eigen::Matrix4cd& s, double lambda, double length_m) {
  return s.determinant().real() / (std::pow(lambda / length_m, 7) * std::exp(lambda));
}

double denominator_38(double lambda, double epsilon, double eta, Form form) {
  const double s = std::sin(lambda), c = std::cos(lambda);
  // Hyperbolic functions times exp(-lambda).
  const double decay = std::exp(-lambda);
  const double sh = -0.5 * std::expm1(-2.0 * lambda);
  const double ch = 0.5 * (1.0 + std::exp(-2.0 * lambda));
  const bool printed = form == Form::printed;
  const double free_hub = s * ch - (printed ? c * s * decay : c * sh) + 2.0 * eta * lambda * s * sh;
  const double locked_hub =
      decay + c * ch + eta * lambda * ((printed ? s * c * decay : sh * c) - s * ch);
  return 2.0 * free_hub + 2.0 * epsilon * std::pow(lambda, 3) * locked_hub;
}

double numerator_39(double lambda, double eta) {
  const double s = std::sin(lambda), c = std::cos(lambda);
  const double sh = -0.5 * std::expm1(-2.0 * lambda);
  const double ch = 0.5 * (1.0 + std::exp(-2.0 * lambda));
  return std::exp(-lambda) + c * ch + eta * lambda * (sh * c - s * ch);
}

std::vector<double> roots(const std::function<double(double)>& f, int count) {
  std::vector<double> found;
  double low = kLowestLambda;
  double at_low = f(low);
  while (static_cast<int>(found.size()) < count) {
    const double high = low + kLambdaStep;
    if (high > kHighestLambda) throw std::runtime_error("roots: no more sign changes");
    const double at_high = f(high);
    if ((at_low < 0.0) != (at_high < 0.0)) found.push_back(refine(f, low, high));
    low = high;
    at_low = at_high;
  }
  return found;
}

std::vector<double> poles_from_clamped_shapes(const arm::Arm& arm, double hub_inertia, int count,
                                              int clamped_modes) {
  const double beam = arm.beam.linear_density_kg_per_m() * std::pow(arm.beam.length_m, 3);
  const double scale = arm::omega_scale_rad_per_s(arm);
  const auto clamped =
      roots([](double lambda) { return numerator_39(lambda, 0.0); }, clamped_modes);
  const auto balance = [&](double omega) {
    double sum = 0.0;
    for (const double lambda : clamped) {
      const double own = lambda * lambda * scale;
      sum += omega * omega / (std::pow(lambda, 4) * (own * own - omega * omega));
    }
    return hub_inertia + beam / 3.0 + 4.0 * beam * sum;
  };
  std::vector<double> poles;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    // The sum runs from minus to plus infinity between two clamped frequencies.
    constexpr double kMargin = 1e-9;
    const double low = clamped.at(i) * clamped.at(i) * scale * (1.0 + kMargin);
    const double high = clamped.at(i + 1) * clamped.at(i + 1) * scale * (1.0 - kMargin);
    poles.push_back(refine(balance, low, high));
  }
  return poles;
}

}  // namespace flexarm::compare::paper
