#include "measured/modal/circle_fit.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <stdexcept>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

double sum_of_squares(std::span<const Complex> points, Complex centre, double radius) {
  double sum = 0.0;
  for (const auto& point : points) {
    const double distance = std::abs(point - centre) - radius;
    sum += distance * distance;
  }
  return sum;
}

/// a (|z|^2 - mean |z|^2)/(2 rms) + b x + c y least in the sense of Taubin, with x, y, z from their
/// mean [Chernov2010]: the eigenvector of the smallest eigenvalue
/// of the moments. A start value: half the digits will do.
Circle taubin(std::span<const Complex> points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Complex mean = Eigen::Map<const Eigen::VectorXcd>(points.data(), count).mean();
  Eigen::VectorXd squares(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    squares(i) = std::norm(points[static_cast<std::size_t>(i)] - mean);
  }
  const double mean_square = squares.mean();
  const double scale = 2.0 * std::sqrt(mean_square);
  if (!(scale > 0.0)) throw std::invalid_argument("a circle through a single point");
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (Eigen::Index i = 0; i < count; ++i) {
    const Complex from_mean = points[static_cast<std::size_t>(i)] - mean;
    const Eigen::Vector3d row((squares(i) - mean_square) / scale, from_mean.real(),
                              from_mean.imag());
    moments += row * row.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(moments);
  const Eigen::Vector3d v = eigen.eigenvectors().col(0);
  const double a = v(0) / scale;
  constexpr double kStraight = 1e-7;  // rounding leaves 1e-8 of points on a line
  if (!(std::abs(a) * scale > kStraight)) {
    throw std::invalid_argument("a circle through points on a line");
  }
  const Complex from_mean(-0.5 * v(1) / a, -0.5 * v(2) / a);
  Circle made;
  made.centre = mean + from_mean;
  made.radius = std::sqrt(std::norm(from_mean) + mean_square);
  return made;
}

}  // namespace

Circle fit_circle(std::span<const Complex> points) {
  if (points.size() < 3) throw std::invalid_argument("a circle through fewer than three points");
  Circle circle = taubin(points);
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::MatrixXd jacobian(count, 3);
  Eigen::VectorXd residual(count);
  double sum = sum_of_squares(points, circle.centre, circle.radius);
  double damping = 0.0;
  constexpr int kMostIterations = 100;
  constexpr double kSmallStep = 1e-13;
  for (; circle.iterations < kMostIterations && !circle.converged; ++circle.iterations) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const Complex from_centre = points[static_cast<std::size_t>(i)] - circle.centre;
      const double distance = std::abs(from_centre);
      const Complex direction = distance > 0.0 ? from_centre / distance : Complex(1.0);
      jacobian.row(i) << -direction.real(), -direction.imag(), -1.0;
      residual(i) = distance - circle.radius;
    }
    const Eigen::Matrix3d normal = jacobian.transpose() * jacobian;
    const Eigen::Vector3d gradient = jacobian.transpose() * residual;
    const Eigen::Matrix3d damped = normal + damping * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d step = -damped.ldlt().solve(gradient);
    const Complex centre = circle.centre + Complex(step(0), step(1));
    const double radius = circle.radius + step(2);
    const double next = sum_of_squares(points, centre, radius);
    circle.converged = step.norm() <= kSmallStep * circle.radius;
    if (next <= sum) {
      circle.centre = centre;
      circle.radius = radius;
      sum = next;
      damping *= 0.1;
    } else if (!circle.converged) {
      damping = damping == 0.0 ? 1e-3 * static_cast<double>(count) : 10.0 * damping;
    }
  }
  circle.rms_distance = std::sqrt(sum / static_cast<double>(count));
  return circle;
}

}  // namespace flexarm::measured
