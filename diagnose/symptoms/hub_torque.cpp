#include "diagnose/symptoms/hub_torque.hpp"

#include "diagnose/search/misfit.hpp"
#include "diagnose/symptoms/hub_regression.hpp"
#include "measured/spectra/tail_probability.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace flexarm::diagnose {

namespace {

using Eigen::Index;

/// Saturation is looked for above these parts of the largest torque.
constexpr std::array kSaturated = {0.5, 0.75};
/// Of a coefficient, its error by first order: a step is up to 10 % too small where the hub rests
/// often, which is two of these.
constexpr double kFirstOrder = 0.05;
/// Ripple is looked for at these multiples of the angle [1/rad].
constexpr double kLeastCycles = 0.5;
constexpr double kMostCycles = 40.0;
constexpr double kMostGrid = 400.0;
/// Of the samples that show which multiple.
constexpr std::size_t kRippleStride = 4;

/// A dependence with the readings that it makes in all hub signals of all runs, in standard
/// deviations of their noise: a column, of a ripple two.
struct Tested {
  HubTorqueTerm term;
  Eigen::MatrixXd readings;
};

double sign(double value) {
  return value == 0.0 ? 0.0 : std::copysign(1.0, value);
}

template <class Torque>
Tested tested(const HubRegression& all, HubTorqueKind kind, const char* unit, Torque torque,
              double at = 0.0) {
  HubTorques torques;
  for (const HubMotion& motion : all.motions()) {
    auto& own = torques.emplace_back(motion.time_s.size());
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = torque(motion, k);
  }
  return {{.kind = kind, .unit = unit, .at = at}, all.readings(torques)};
}

std::vector<Tested> simple_terms(const HubRegression& all, const std::vector<HubMotion>& motions) {
  using Motion = HubMotion;
  using Kind = HubTorqueKind;
  std::vector<Tested> made;
  made.push_back(tested(all, Kind::coulomb_friction, "N m",
                        [](const Motion& m, std::size_t k) { return -sign_at_sample(m, k); }));
  made.push_back(tested(
      all, Kind::viscous_friction, "N m s/rad",
      [](const Motion& m, std::size_t k) { return -at_sample(m, m.velocity_rad_per_s, k); }));
  made.push_back(tested(all, Kind::inertia, "kg m^2", [](const Motion& m, std::size_t k) {
    return -at_sample(m, m.acceleration_rad_per_s2, k);
  }));
  made.push_back(tested(all, Kind::spring, "N m/rad", [](const Motion& m, std::size_t k) {
    return -at_sample(m, m.angle_rad, k);
  }));
  made.push_back(tested(all, Kind::bias, "N m", [](const Motion&, std::size_t) { return 1.0; }));
  made.push_back(tested(all, Kind::time, "N m/s", [](const Motion& m, std::size_t k) {
    return m.time_s[k] - 0.5 * (m.time_s.front() + m.time_s.back());
  }));
  made.push_back(
      tested(all, Kind::gain, "1", [](const Motion& m, std::size_t k) { return m.torque_N_m[k]; }));
  made.push_back(tested(all, Kind::dead_zone, "N m",
                        [](const Motion& m, std::size_t k) { return -sign(m.torque_N_m[k]); }));
  double largest_N_m = 0.0;
  for (const Motion& motion : motions) {
    for (const double torque : motion.torque_N_m) {
      largest_N_m = std::max(largest_N_m, std::abs(torque));
    }
  }
  for (const double part : kSaturated) {
    const double from_N_m = part * largest_N_m;
    made.push_back(tested(
        all, Kind::saturation, "1",
        [&](const Motion& m, std::size_t k) {
          const double torque = m.torque_N_m[k];
          return -sign(torque) * std::max(0.0, std::abs(torque) - from_N_m);
        },
        from_N_m));
  }
  return made;
}

/// Multiples of the angle that a periodogram over all runs tells apart.
std::vector<double> ripple_grid(const std::vector<HubMotion>& motions) {
  double range_rad = 0.0;
  for (const HubMotion& motion : motions) {
    const auto [least, most] = std::ranges::minmax_element(motion.angle_rad);
    range_rad = std::max(range_rad, *most - *least);
  }
  const double step = std::max(0.25 * std::numbers::pi / range_rad, kMostCycles / kMostGrid);
  std::vector<double> grid;
  // A period must lie within the range: less of it is a spring or a bias.
  for (double cycles = std::max(kLeastCycles, 2.0 * std::numbers::pi / range_rad);
       cycles <= kMostCycles; cycles += step) {
    grid.push_back(cycles);
  }
  return grid;
}

/// The multiple of the angle at which `torques` have the largest part along its sine and cosine.
double strongest_cycles(const std::vector<HubMotion>& motions, const HubTorques& torques,
                        const std::vector<double>& grid) {
  double strongest = grid.front();
  double most = -1.0;
  for (const double cycles : grid) {
    Eigen::Vector2d along = Eigen::Vector2d::Zero();
    for (std::size_t m = 0; m < motions.size(); ++m) {
      for (std::size_t k = 0; k < torques[m].size(); k += kRippleStride) {
        const double angle = cycles * motions[m].angle_rad[k];
        along += torques[m][k] * Eigen::Vector2d(std::sin(angle), std::cos(angle));
      }
    }
    if (along.squaredNorm() > most) {
      most = along.squaredNorm();
      strongest = cycles;
    }
  }
  return strongest;
}

Tested ripple(const HubRegression& all, double cycles) {
  Tested sine = tested(
      all, HubTorqueKind::ripple, "N m",
      [&](const HubMotion& m, std::size_t k) {
        return std::sin(cycles * at_sample(m, m.angle_rad, k));
      },
      cycles);
  const Tested cosine =
      tested(all, HubTorqueKind::ripple, "N m",
             [&](const HubMotion& m, std::size_t k) { return std::cos(cycles * m.angle_rad[k]); });
  sine.readings.conservativeResize(Eigen::NoChange, 2);
  sine.readings.col(1) = cosine.readings.col(0);
  return sine;
}

/// Least squares of the residuals on some terms.
struct Regressed {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;  ///< for residuals of deviation 1
  Eigen::VectorXd left;
};

Regressed regress(const Eigen::VectorXd& residuals, const std::vector<const Tested*>& terms) {
  Index columns = 0;
  for (const Tested* term : terms) columns += term->readings.cols();
  Eigen::MatrixXd readings(residuals.size(), columns);
  Index at = 0;
  for (const Tested* term : terms) {
    readings.middleCols(at, term->readings.cols()) = term->readings;
    at += term->readings.cols();
  }
  // Columns of unlike units are scaled to one length.
  const Eigen::VectorXd length = readings.colwise().norm();
  const Eigen::VectorXd scale =
      (length.array() > 0.0).select(length.cwiseInverse(), Eigen::VectorXd::Zero(columns));
  readings *= scale.asDiagonal();
  const Eigen::MatrixXd normal = readings.transpose() * readings;
  const Eigen::LDLT<Eigen::MatrixXd> solver(normal);
  const Eigen::VectorXd solution = solver.solve(readings.transpose() * residuals);
  Regressed made;
  made.left = residuals - readings * solution;
  made.coefficients = scale.cwiseProduct(solution);
  made.covariance = scale.asDiagonal() * solver.solve(Eigen::MatrixXd::Identity(columns, columns)) *
                    scale.asDiagonal();
  return made;
}

/// The last term of a regression beside the others, with its F test; `before` is the sum of squares
/// without it, `excess` that of the residuals beyond noise.
void put_last(const HubRegression& all, const Regressed& regressed, double before, double excess,
              Tested& tested) {
  HubTorqueTerm& term = tested.term;
  const Index own = tested.readings.cols();
  const Index last = regressed.coefficients.size() - own;
  const auto n = static_cast<double>(regressed.left.size());
  const double left = regressed.left.squaredNorm();
  const double independent = std::max(1.0, all.independent(regressed.left));
  const double scale = std::max(1.0, left / n) * n / independent;
  term.coefficient =
      own == 1 ? regressed.coefficients(last) : regressed.coefficients.tail(2).norm();
  const double of_residuals =
      std::sqrt(scale * regressed.covariance.diagonal().tail(own).maxCoeff());
  term.std_error = std::hypot(of_residuals, kFirstOrder * term.coefficient);
  term.share = (before - left) / excess;
  const double freedom = static_cast<double>(own);
  term.probability = measured::f_tail((before - left) / freedom / scale, freedom,
                                      std::max(1.0, independent - freedom));
}

/// The largest of any hub signal, relative to the signal.
double error_beyond_noise(const std::vector<HubMotion>& motions) {
  double most = 0.0;
  for (const HubMotion& motion : motions) {
    for (const HubReading& reading : motion.readings) {
      const auto n = static_cast<double>(reading.residual.size());
      const double squares =
          Eigen::VectorXd::Map(reading.residual.data(), static_cast<Index>(n)).squaredNorm();
      const double beyond = squares / (n * reading.noise * reading.noise) - 1.0;
      most = std::max(most, reading.relative_noise * std::sqrt(std::max(0.0, beyond)));
    }
  }
  return most;
}

}  // namespace

HubTorque hub_torque(const std::vector<HubMotion>& motions, double least_error) {
  HubTorque made;
  if (motions.empty()) return made;
  const HubRegression all(motions);
  const double squares = all.residuals().squaredNorm();
  const double excess = beyond_noise(all.residuals());
  const bool is_wrong = error_beyond_noise(motions) >= least_error;
  std::vector<Tested> candidates = simple_terms(all, motions);
  const std::vector<double> grid = ripple_grid(motions);
  made.tests = candidates.size() + grid.size();

  std::vector<Tested> chosen;
  chosen.reserve(kMostHubTerms);
  Eigen::VectorXd left = all.residuals();
  while (true) {
    HubTorques torques = all.torques(left);
    if (chosen.empty()) {
      for (std::size_t m = 0; m < motions.size(); ++m) {
        made.traces.push_back({motions[m].run_id, motions[m].time_s, torques[m],
                               motions[m].velocity_rad_per_s, motions[m].angle_rad});
      }
    }
    std::erase_if(candidates,
                  [](const Tested& one) { return one.term.kind == HubTorqueKind::ripple; });
    if (!grid.empty()) candidates.push_back(ripple(all, strongest_cycles(motions, torques, grid)));
    std::vector<const Tested*> terms;
    for (const Tested& one : chosen) terms.push_back(&one);
    std::size_t best = 0;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      terms.push_back(&candidates[i]);
      put_last(all, regress(all.residuals(), terms), left.squaredNorm(), excess, candidates[i]);
      terms.pop_back();
      if (candidates[i].term.share > candidates[best].term.share) best = i;
    }
    const HubTorqueTerm& found = candidates[best].term;
    const bool is_one = is_wrong &&
                        found.probability * static_cast<double>(made.tests) < kSignificantSymptom &&
                        found.share >= kLeastHubShare;
    if (!is_one || chosen.size() == kMostHubTerms) break;
    chosen.push_back(std::move(candidates[best]));
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
    terms.clear();
    for (const Tested& one : chosen) terms.push_back(&one);
    left = regress(all.residuals(), terms).left;
  }
  made.share = std::min(1.0, (squares - left.squaredNorm()) / excess);
  // Coefficients of each beside all the others.
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    std::vector<const Tested*> terms;
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      if (j != i) terms.push_back(&chosen[j]);
    }
    terms.push_back(&chosen[i]);
    Tested& own = chosen[i];
    const double share = own.term.share;
    const double probability = own.term.probability;
    put_last(all, regress(all.residuals(), terms), left.squaredNorm(), excess, own);
    own.term.share = share;
    own.term.probability = probability;
    made.terms.push_back(own.term);
  }
  for (const Tested& one : candidates) made.left_over.push_back(one.term);
  return made;
}

}  // namespace flexarm::diagnose
