#include "tests/measured/unlike_coverage.hpp"

#include "fem/fem_arm.hpp"
#include "measured/modal/modal_gains.hpp"
#include "tests/measured/coverage_study.hpp"
#include "tests/measured/fit_errors.hpp"
#include "tests/trials/excitations.hpp"
#include "tests/trials/time_simulation.hpp"
#include "tests/trials/trial_arms.hpp"

#include <boost/math/distributions/binomial.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace flexarm::measured {

namespace {

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

}  // namespace

std::string to_string(Drive drive) {
  switch (drive) {
    case Drive::random:
      return "random";
    case Drive::multisine:
      return "multisine";
    case Drive::bang_bang:
      return "bang-bang";
  }
  return "";
}

UnlikeCase::UnlikeCase(std::size_t arm, Drive drive, double relative_noise)
    : arm_(arm),
      drive_(drive),
      relative_noise_(relative_noise),
      name_(trials::trial_arms()[arm].arm.name + ", " + to_string(drive)),
      sensors_(sensors_named({"hub_angle", "tip_acceleration", "strain@0.05"})) {
  const trials::PlantOptions plant;
  const fem::FemArm model(trials::trial_arms()[arm].arm,
                          {.mesh = {.elements = plant.elements}, .degree = 3});
  const arm::ModalModel modes = model.modal_model(plant.flexible_modes, sensors_, {});
  roots_ = exact_roots(modes, sensors_.size());
  gains_ = exact_gains(modes, 0, 1);
}

TimeRecord UnlikeCase::record(std::uint64_t seed) const {
  const trials::TrialArm& trial = trials::trial_arms()[arm_];
  trials::Random random(seed, name_);
  std::vector<double> torque;
  switch (drive_) {
    case Drive::random:
      torque = trials::random_torque(trial.low_torque_N_m, random);
      break;
    case Drive::multisine:
      torque = trials::multisine_torque(trial.low_torque_N_m, random);
      break;
    case Drive::bang_bang:
      torque = trials::bang_bang_torque(trial.low_torque_N_m);
      break;
  }
  auto readings = trials::simulate_in_time({trial.arm}, sensors_, torque);
  TimeRecord record;
  for (std::size_t k = 0; k < torque.size(); ++k) {
    record.time_s.push_back(static_cast<double>(k) * trials::kSampleTime_s);
  }
  record.torque_N_m = torque;
  for (std::size_t j = 0; j < sensors_.size(); ++j) {
    const double deviation = relative_noise_ * rms(readings[j]);
    for (double& value : readings[j]) value += deviation * random.normal();
    record.channels.push_back({sensors_[j], std::move(readings[j])});
  }
  return record;
}

bool KindCoverage::is_as_stated(double chance) const {
  if (fits == 0) return true;
  using boost::math::binomial;
  const double trials = fits;
  const double held = share() * trials;
  const bool enough = boost::math::cdf(binomial(trials, kLeastCoverage), held) >= chance;
  const bool not_too_many =
      held < 1.0 || boost::math::cdf(boost::math::complement(binomial(trials, kMostCoverage),
                                                             held - 1.0)) >= chance;
  return enough && not_too_many;
}

void UnlikeStudy::run(const UnlikeCase& unlike, std::uint64_t seed) {
  const std::vector<TimeRecord> records = {unlike.record(seed)};
  const ModalFit fit = fit_modes(records);
  ++fits_;
  note_poles(unlike, fit);
  for (std::size_t j = 0; j < fit.sensors.size(); ++j) note_zeros(unlike, fit, j);
  note_gains(unlike, fit);
}

void UnlikeStudy::note(const std::string& kind, double value, double truth, double standard_error) {
  KindCoverage& entry = kinds_[kind];
  const double off = std::abs(value - truth) / standard_error;
  ++entry.stated;
  if (std::exchange(last_fit_[kind], fits_) != fits_) ++entry.fits;
  if (off <= kNormal95) ++entry.covered;
  entry.sum_of_squares += off * off;
  entry.largest = std::max(entry.largest, off);
}

void UnlikeStudy::note_poles(const UnlikeCase& unlike, const ModalFit& fit) {
  for (const FittedPole& pole : fit.poles) {
    if (!pole.is_mode) continue;
    const auto truth = *std::ranges::min_element(
        unlike.roots().poles, {}, [&](const auto& s) { return std::abs(s - pole.s_rad_per_s[0]); });
    note("pole frequency", pole.frequency_Hz, natural_Hz(truth), pole.frequency_std_Hz);
    note("pole damping ratio", pole.damping_ratio, damping_of(truth), pole.damping_ratio_std);
  }
}

void UnlikeStudy::note_zeros(const UnlikeCase& unlike, const ModalFit& fit, std::size_t sensor) {
  const std::string name = arm::to_string(fit.sensors[sensor].sensor);
  for (const FittedZero& zero : fit.sensors[sensor].zeros) {
    if (!zero.in_band) continue;
    const std::string kind = name + (zero.s_rad_per_s.imag() == 0.0 ? " real zero" : " zero");
    if (!zero.is_told) {
      ++kinds_[kind + " frequency"].withheld;
      continue;
    }
    const auto truth =
        *std::ranges::min_element(unlike.roots().zeros[sensor], {},
                                  [&](const auto& s) { return std::abs(s - zero.s_rad_per_s); });
    note(kind + " frequency", zero.frequency_Hz, natural_Hz(truth), zero.frequency_std_Hz);
    if (zero.s_rad_per_s.imag() == 0.0) continue;
    note(kind + " damping ratio", zero.damping_ratio, damping_of(truth), zero.damping_ratio_std);
  }
}

void UnlikeStudy::note_gains(const UnlikeCase& unlike, const ModalFit& fit) {
  const ModalGains found = modal_gains(fit);
  const ExactGains& truth = unlike.gains();
  const auto note_estimate = [this](const std::string& kind,
                                    const std::optional<Estimate>& estimate, double exact) {
    if (estimate) note(kind, estimate->value, exact, estimate->standard_error);
  };
  note_estimate("total inertia", found.total_inertia_kg_m2, truth.total_inertia_kg_m2);
  for (std::size_t i = 0; i < std::min(found.modes.size(), truth.hub_slopes.size()); ++i) {
    note_estimate("hub slope (48)", found.modes[i].hub_slope, truth.hub_slopes[i]);
    note_estimate("tip gain (49)", found.modes[i].tip_gain_m, truth.tip_gains_m[i]);
    note_estimate("tip gain (52)", found.modes[i].tip_gain_of_ratio_m,
                  truth.tip_gains_of_ratio_m[i]);
  }
}

}  // namespace flexarm::measured
