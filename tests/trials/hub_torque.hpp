#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

namespace flexarm::trials {

/// A step of the simulation, seen from the hub.
struct HubStep {
  double time_s = 0.0;           ///< its middle
  double angle_rad = 0.0;        ///< there
  double turn_rad = 0.0;         ///< by which the hub turns in the step
  double speed_rad_per_s = 0.0;  ///< mean of the step
  double driving_N_m = 0.0;      ///< what comes to the hub from the actuator, mean of the step
  double duration_s = 0.0;
};

/// A torque on the hub that depends on its motion or on time, with a memory if it needs one.
class HubTorque {
 public:
  HubTorque() = default;
  HubTorque(const HubTorque&) = delete;
  HubTorque& operator=(const HubTorque&) = delete;
  virtual ~HubTorque() = default;

  /// Mean over the step.
  virtual double mean_N_m(const HubStep& step) const = 0;
  /// Takes note that the hub has turned.
  virtual void turned(double /*turn_rad*/) {}
  /// Takes note of a step that has been made.
  virtual void made(const HubStep& /*step*/) {}
};

/// What is not the same in every run.
struct RunConditions {
  double duration_s = 0.0;
  std::uint64_t seed = 1;
};

using MakeHubTorque = std::function<std::unique_ptr<HubTorque>(const RunConditions&)>;

/// Size of dry friction at a speed of 0 or more, or below it by symmetry [N m].
using FrictionSize = std::function<double(double speed_rad_per_s)>;

/// A torque without a memory.
class PlainHubTorque : public HubTorque {
 public:
  explicit PlainHubTorque(std::function<double(const HubStep&)> torque_N_m)
      : torque_N_m_(std::move(torque_N_m)) {}
  double mean_N_m(const HubStep& step) const override { return torque_N_m_(step); }

 private:
  std::function<double(const HubStep&)> torque_N_m_;
};

/// The same in every run.
inline MakeHubTorque plain_hub_torque(std::function<double(const HubStep&)> torque_N_m) {
  return [law = std::move(torque_N_m)](const RunConditions& /*run*/) {
    return std::make_unique<PlainHubTorque>(law);
  };
}

}  // namespace flexarm::trials
