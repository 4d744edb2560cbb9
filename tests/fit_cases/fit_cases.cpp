#include "tests/fit_cases/fit_cases.hpp"

#include "response/formulation_maker.hpp"
#include "response/time/random_numbers.hpp"
#include "response/time/sensor_imperfections.hpp"
#include "response/time/time_model.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace flexarm::measured {

arm::Arm damped_paper_arm() {
  arm::Arm arm = arm::paper_arm();
  arm.damping.kelvin_voigt_s = 1e-4;
  arm.hub.viscous_friction_N_m_s_per_rad = 2e-3;
  return arm;
}

std::vector<arm::Sensor> sensors_named(const std::vector<std::string>& names) {
  std::vector<arm::Sensor> sensors;
  for (const std::string& name : names) sensors.push_back(arm::parse_sensor(name));
  return sensors;
}

arm::ModalModel model_of(const FitCase& fit_case) {
  response::ArmParts parts;
  parts.linear = fit_case.arm;
  return response::time_model(response::make_formulation("exact_tf", fit_case.arm, fit_case.modes),
                              parts, fit_case.modes, fit_case.sensors);
}

TimeRecord clean_record(const FitCase& fit_case, const arm::ModalModel& model,
                        const response::ArmParts& parts) {
  const response::SampleGrid grid{
      static_cast<std::size_t>(std::lround(fit_case.duration_s / fit_case.sample_time_s)),
      fit_case.sample_time_s};
  const auto torque = response::sample(fit_case.excitation, grid);
  auto made = response::simulate(
      model, parts, fit_case.sensors, torque.torque_N_m,
      {.sample_time_s = fit_case.sample_time_s, .hold = fit_case.hold, .energy = false});
  TimeRecord record{made.time_s, made.commanded_torque_N_m, {}};
  for (std::size_t j = 0; j < fit_case.sensors.size(); ++j) {
    record.channels.push_back({fit_case.sensors[j], std::move(made.channels[j])});
  }
  return record;
}

TimeRecord clean_record(const FitCase& fit_case, const arm::ModalModel& model) {
  response::ArmParts parts;
  parts.linear = fit_case.arm;
  return clean_record(fit_case, model, parts);
}

void add_noise(TimeRecord& record, double relative_noise, std::uint64_t seed) {
  for (std::size_t j = 0; j < record.channels.size(); ++j) {
    response::RandomNumbers random(seed, static_cast<std::uint32_t>(j));
    response::impair(record.channels[j].values, {.relative_noise = relative_noise}, random);
  }
}

TimeRecord record_of(const FitCase& fit_case) {
  TimeRecord record = clean_record(fit_case, model_of(fit_case));
  if (fit_case.relative_noise > 0.0) add_noise(record, fit_case.relative_noise, fit_case.seed);
  return record;
}

ExactRoots exact_roots(const arm::ModalModel& model, std::size_t sensors) {
  using Eigen::Index;
  const auto n = static_cast<Index>(model.modes.size());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(2 * n);
  a.topRightCorner(n, n).setIdentity();
  for (Index i = 0; i < n; ++i) {
    const auto& mode = model.modes[static_cast<std::size_t>(i)];
    const double omega = mode.omega_rad_per_s;
    a(n + i, i) = -omega * omega;
    b(n + i) = mode.hub_slope / model.modal_mass_kg_m2;
    for (Index k = 0; k < n; ++k) {
      a(n + i, n + k) = -model.damping_rad_per_s[static_cast<std::size_t>(i * n + k)];
    }
  }
  const auto kept = [](const Eigen::VectorXcd& all) {
    std::vector<std::complex<double>> roots;
    for (const auto& s : all) {
      if (s.imag() >= 0.0 && std::abs(s) > 1e-2) roots.push_back(s);
    }
    std::ranges::sort(roots, {}, [](std::complex<double> s) { return std::abs(s); });
    return roots;
  };
  ExactRoots roots;
  for (const auto& s : kept(a.eigenvalues())) {
    if (s.imag() > 0.0) roots.poles.push_back(s);
  }
  for (std::size_t j = 0; j < sensors; ++j) {
    Eigen::MatrixXd pencil = Eigen::MatrixXd::Zero(2 * n + 1, 2 * n + 1);
    Eigen::MatrixXd e = Eigen::MatrixXd::Identity(2 * n + 1, 2 * n + 1);
    e(2 * n, 2 * n) = 0.0;
    pencil.topLeftCorner(2 * n, 2 * n) = a;
    pencil.topRightCorner(2 * n, 1) = b;
    for (Index i = 0; i < n; ++i) {
      pencil(2 * n, i) = model.modes[static_cast<std::size_t>(i)].sensor_values[j];
    }
    const Eigen::GeneralizedEigenSolver<Eigen::MatrixXd> solver(pencil, e, false);
    Eigen::VectorXcd finite(0);
    for (Index i = 0; i < 2 * n + 1; ++i) {
      if (std::abs(solver.alphas()(i)) > 1e7 * std::abs(solver.betas()(i))) continue;
      finite.conservativeResize(finite.size() + 1);
      finite(finite.size() - 1) = solver.alphas()(i) / solver.betas()(i);
    }
    roots.zeros.push_back(kept(finite));
  }
  return roots;
}

}  // namespace flexarm::measured
