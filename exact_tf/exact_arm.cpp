#include "exact_tf/exact_arm.hpp"

#include "arm/input_error.hpp"
#include "exact_tf/root_search.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace flexarm::exact_tf {

namespace {

void require_count(int count) {
  arm::require_count(count);
  if (count > kMostRoots) {
    throw arm::out_of_range("count", count, "", fmt::format("from 1 to {}", kMostRoots));
  }
}

/// The arm's numbers, where this formulation can answer for it.
arm::LinearArm honoured(const arm::Arm& arm) {
  require_computable(arm);
  require_honoured(arm.effects, ExactArm::kName, arm::kLinearArmPorts);
  return linear_arm(arm);
}

std::variant<PlainArm, TransferMatrixArm> engine_for(const arm::LinearArm& arm,
                                                     Arithmetic arithmetic) {
  if (arm.is_plain()) return PlainArm(arm, arithmetic);
  return TransferMatrixArm(arm, arithmetic);
}

/// Throws InputError by the name of an effect that leaves an arm without closed form.
const PlainArm& plain(const std::variant<PlainArm, TransferMatrixArm>& engine,
                      const arm::Arm& arm) {
  if (const auto* plain_arm = std::get_if<PlainArm>(&engine)) return *plain_arm;
  require_plain(arm, "the closed form");
  throw std::logic_error("an arm that is not plain without an effect");
}

}  // namespace

ExactArm::ExactArm(arm::Arm arm, Arithmetic arithmetic)
    : arm_(std::move(arm)), linear_(honoured(arm_)), engine_(engine_for(linear_, arithmetic)) {}

std::vector<double> ExactArm::pole_lambdas(int count) const {
  require_count(count);
  return plain(engine_, arm_).pole_lambdas(count);
}

std::vector<double> ExactArm::hub_zero_lambdas(int count) const {
  require_count(count);
  return plain(engine_, arm_).hub_zero_lambdas(count);
}

arm::PoleSet ExactArm::poles(int count) const {
  require_count(count);
  return std::visit([&](const auto& engine) { return engine.poles(count); }, engine_);
}

arm::DampedPoleSet ExactArm::damped_poles(int count) const {
  require_count(count);
  return std::visit([&](const auto& engine) { return engine.damped_poles(count); }, engine_);
}

arm::ZeroSet ExactArm::zeros(const arm::Sensor& sensor, int count) const {
  require_count(count);
  const arm::Sensor at = placed(sensor, arm_);
  require_responsive(sensor, arm_);
  return std::visit([&](const auto& engine) { return engine.zeros(at, count); }, engine_);
}

DampedZeroSet ExactArm::damped_zeros(
    const arm::Sensor& sensor, std::span<const std::complex<double>> undamped_rad_per_s) const {
  const arm::Sensor at = placed(sensor, arm_);
  if (const auto* plain_arm = std::get_if<PlainArm>(&engine_)) {
    return plain_arm->damped_zeros(undamped_rad_per_s);
  }
  return std::get<TransferMatrixArm>(engine_).damped_zeros(at, undamped_rad_per_s);
}

std::vector<arm::Mode> ExactArm::modes(int count, std::span<const arm::Sensor> sensors,
                                       std::span<const double> stations_m) const {
  require_count(count);
  const std::vector<arm::Sensor> at = placed(sensors, arm_);
  require_stations(stations_m, arm_);
  return std::visit([&](const auto& engine) { return engine.modes(count, at, stations_m); },
                    engine_);
}

arm::ModalModel ExactArm::modal_model(int count, std::span<const arm::Sensor> sensors,
                                      std::span<const double> stations_m) const {
  require_count(count);
  const std::vector<arm::Sensor> at = placed(sensors, arm_);
  require_stations(stations_m, arm_);
  return std::visit([&](const auto& engine) { return engine.modal_model(count, at, stations_m); },
                    engine_);
}

std::complex<double> ExactArm::transfer_function(const arm::Sensor& sensor,
                                                 std::complex<double> s_rad_per_s) const {
  return transfer_functions({&sensor, 1}, s_rad_per_s).front();
}

std::vector<std::complex<double>> ExactArm::transfer_functions(
    std::span<const arm::Sensor> sensors, std::complex<double> s_rad_per_s) const {
  const std::vector<arm::Sensor> at = placed(sensors, arm_);
  if (s_rad_per_s == 0.0 && linear_.turns_freely()) {
    throw std::domain_error("exact_tf: the transfer function of a free arm has a pole at s = 0");
  }
  if (!std::isfinite(s_rad_per_s.real()) || !std::isfinite(s_rad_per_s.imag())) {
    throw std::domain_error("exact_tf: s must be finite");
  }
  return std::visit([&](const auto& engine) { return engine.transfer_functions(at, s_rad_per_s); },
                    engine_);
}

}  // namespace flexarm::exact_tf
