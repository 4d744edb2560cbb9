#include "diagnose/unknown/empirical_law.hpp"

#include "arm/given_effects.hpp"
#include "diagnose/search/misfit.hpp"
#include "diagnose/unknown/balanced_motion.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Places on each side of velocity 0, and on all of the angle; fewer of each in a table over both.
constexpr int kVelocities = 4;
constexpr int kAngles = 17;
constexpr int kFewVelocities = 2;
constexpr int kFewAngles = 9;
/// Gauss-Newton steps: the balance is linear in the torques but for friction that holds.
constexpr int kSteps = 2;
/// Step of a difference quotient, over the missing torque.
constexpr double kPart = 0.1;
/// A place that no sample is near has the torque of its neighbour by this weight, over that of a
/// mean place; by the second, which is far less, that of a side which no sample is on is 0.
constexpr double kLikeNeighbour = 1e-6;
constexpr double kRidge = 1e-10;

/// The value below which this part of the values is.
double quantile(std::vector<double> values, double part) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, values.begin() + at);
  return values[static_cast<std::size_t>(at)];
}

/// Up to the velocity that a hundredth of the samples is above; 0 twice where friction may jump.
std::vector<double> velocity_axis(const BalancedMotion& motion, int a_side, bool jumps) {
  std::vector<double> speeds;
  for (const double velocity : motion.velocity_rad_per_s) speeds.push_back(std::abs(velocity));
  const double fastest = quantile(std::move(speeds), 0.99);
  std::vector<double> axis;
  for (int i = -a_side; i <= a_side; ++i) {
    axis.push_back(fastest * static_cast<double>(i) / a_side);
    if (i == 0 && jumps) axis.push_back(0.0);
  }
  return axis;
}

std::vector<double> angle_axis(const BalancedMotion& motion, int places) {
  const double least = quantile(motion.angle_rad, 0.005);
  const double most = quantile(motion.angle_rad, 0.995);
  std::vector<double> axis;
  for (int i = 0; i < places; ++i) {
    axis.push_back(std::lerp(least, most, static_cast<double>(i) / (places - 1)));
  }
  return axis;
}

arm::Arm with_table(arm::Arm arm, const arm::HubTorqueTable& table) {
  arm.effects[std::string(arm::kHubTorqueTable)] = {.definition = arm::define_effect(table)};
  return arm;
}

/// A table with the torques of least squares.
struct FittedTable {
  arm::HubTorqueTable table;
  std::vector<double> std_errors_N_m = {};  ///< of each
};

/// Whether a step of this torque upwards would make dry friction, by which the torque falls at
/// velocity 0, less than none.
bool is_above_jump(const arm::HubTorqueTable& table, std::size_t j) {
  const auto& velocity = table.velocity_rad_per_s;
  return table.angle_rad.empty() && j > 0 && velocity[j] == 0.0 && velocity[j - 1] == 0.0;
}

/// Of the squares of differences between neighbouring torques, half the second derivatives. Where
/// friction jumps there are no neighbours.
Eigen::MatrixXd roughness(const arm::HubTorqueTable& table) {
  const std::size_t columns = table.columns();
  const std::size_t rows = std::max<std::size_t>(1, table.angle_rad.size());
  const auto& velocity = table.velocity_rad_per_s;
  Eigen::MatrixXd made =
      Eigen::MatrixXd::Zero(static_cast<Index>(rows * columns), static_cast<Index>(rows * columns));
  const auto join = [&](std::size_t one, std::size_t other) {
    const auto i = static_cast<Index>(one);
    const auto j = static_cast<Index>(other);
    made(i, i) += 1.0;
    made(j, j) += 1.0;
    made(i, j) -= 1.0;
    made(j, i) -= 1.0;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const std::size_t at = row * columns + column;
      if (row + 1 < rows) join(at, at + columns);
      if (column + 1 < columns && velocity[column] != velocity[column + 1]) join(at, at + 1);
    }
  }
  return made;
}

/// From torques that are 0. Throws InputError where those of least squares are no table.
FittedTable fitted(const Problem& balance, const arm::Arm& arm, arm::HubTorqueTable table,
                   double step_N_m) {
  const auto left_with = [&](const arm::HubTorqueTable& one) {
    const auto left =
        balanced_motion(balance, with_table(arm, one), balance.estimation_runs()).missing_N_m;
    return Eigen::VectorXd(Eigen::VectorXd::Map(left.data(), std::ssize(left)));
  };
  const std::size_t places = std::max<std::size_t>(1, table.angle_rad.size()) * table.columns();
  table.torque_N_m.assign(places, 0.0);
  const auto n = static_cast<Index>(places);
  const Eigen::MatrixXd rough = roughness(table);
  FittedTable made;
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::VectorXd here = left_with(table);
    Eigen::MatrixXd jacobian(here.size(), n);
    for (std::size_t j = 0; j < places; ++j) {
      arm::HubTorqueTable beside = table;
      const double change_N_m = is_above_jump(table, j) ? -step_N_m : step_N_m;
      beside.torque_N_m[j] += change_N_m;
      jacobian.col(static_cast<Index>(j)) = (left_with(beside) - here) / change_N_m;
    }
    Eigen::MatrixXd information = jacobian.transpose() * jacobian;
    const double mean = information.diagonal().mean();
    information += kLikeNeighbour * mean * rough;
    information.diagonal().array() += kRidge * mean;
    const Eigen::LDLT<Eigen::MatrixXd> solver(information);
    const Eigen::VectorXd present = Eigen::VectorXd::Map(table.torque_N_m.data(), n);
    const Eigen::VectorXd change =
        -solver.solve(jacobian.transpose() * here + kLikeNeighbour * mean * (rough * present));
    for (std::size_t j = 0; j < places; ++j) table.torque_N_m[j] += change(static_cast<Index>(j));
    arm::require_valid(table);
    const Eigen::VectorXd left = here + jacobian * change;
    const double variance = left.squaredNorm() / independent(left, measured::RunKind::time);
    const Eigen::MatrixXd covariance = variance * solver.solve(Eigen::MatrixXd::Identity(n, n));
    const Eigen::VectorXd std_errors = covariance.diagonal().cwiseSqrt();
    made.std_errors_N_m = {std_errors.begin(), std_errors.end()};
  }
  made.table = std::move(table);
  return made;
}

/// Tables to be fitted, without torques; that over both axes is the last.
std::vector<arm::HubTorqueTable> tables_for(const BalancedMotion& motion) {
  return {{.velocity_rad_per_s = velocity_axis(motion, kVelocities, true)},
          {.velocity_rad_per_s = velocity_axis(motion, kVelocities, false)},
          {.angle_rad = angle_axis(motion, kAngles)},
          {.angle_rad = angle_axis(motion, kFewAngles),
           .velocity_rad_per_s = velocity_axis(motion, kFewVelocities, false)}};
}

}  // namespace

arm::Arm with_law(const arm::Arm& arm, const EmpiricalLaw& law) {
  return with_table(arm, law.table);
}

std::optional<EmpiricalLaw> empirical_law(const Problem& balance, const Problem& simulated,
                                          const Candidate& candidate) {
  const arm::Arm arm = candidate.extend(balance.experiment().arm);
  if (arm.effects.contains(std::string(arm::kHubTorqueTable))) return std::nullopt;
  const auto& runs = balance.judged_runs();
  const double before = balanced_motion(balance, arm, runs).mean_square_missing();
  std::optional<EmpiricalLaw> best;
  double least = (1.0 - kLeastShare) * before;
  const std::vector<arm::HubTorqueTable> tables =
      tables_for(balanced_motion(balance, arm, balance.estimation_runs()));
  for (const arm::HubTorqueTable& axes : tables) {
    const bool is_over_both = !axes.angle_rad.empty() && !axes.velocity_rad_per_s.empty();
    try {
      const FittedTable found = fitted(balance, arm, axes, kPart * std::sqrt(before));
      const double left =
          balanced_motion(balance, with_table(arm, found.table), runs).mean_square_missing();
      if (!(left < (is_over_both && best ? kMuchLess * least : least))) continue;
      least = left;
      best = EmpiricalLaw{.table = found.table,
                          .std_error_N_m = quantile(found.std_errors_N_m, 0.5),
                          .std_errors_N_m = found.std_errors_N_m,
                          .share = 1.0 - left / before};
    } catch (const std::runtime_error&) {
      // Torques that are no table, such as friction that drives.
    }
  }
  if (!best) return std::nullopt;
  best->error_before = simulated.judged_error(arm);
  best->error_after = simulated.judged_error(with_law(arm, *best));
  if (!(best->error_after < best->error_before)) return std::nullopt;
  best->means = torque_means(best->table, balanced_motion(balance, arm, runs));
  return best;
}

}  // namespace flexarm::diagnose
