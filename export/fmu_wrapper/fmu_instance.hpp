#pragma once

#include "arm/arm.hpp"
#include "export/fmu/fmu_settings.hpp"
#include "export/fmu/fmu_variables.hpp"
#include "response/time/cosimulated_arm.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::fmu {

/// Where an instance is in the state machine of the standard. `failed`: a step did not succeed;
/// only a saved state or a reset leads out of it.
enum class Phase { instantiated, initialising, stepping, terminated, failed };

/// An instance of the FMU, whatever the version of the interface. It has no part in any other.
///
/// Every function throws arm::InputError, with one line for the environment's log, for a call that
/// the standard does not allow in the phase, and for values that cannot be taken; the instance is
/// then as before, unless a step failed.
class FmuInstance {
 public:
  /// Reads arm and settings from the folder of resources. Throws for files that cannot be used, and
  /// where `token` is not that of the settings: the model description is of another FMU.
  FmuInstance(const std::filesystem::path& resources, std::string_view token);

  Phase phase() const { return state_.phase; }

  /// The time of the first communication point, and that which steps must not pass.
  void set_up(double start_s, std::optional<double> stop_s);
  void enter_initialisation();
  void exit_initialisation();
  void terminate();
  void reset();

  double get(std::uint32_t reference);
  /// Of a variable that jumps with the torque.
  bool follows_torque(std::uint32_t reference) const { return variable(reference).follows_torque; }
  /// Parameters until initialisation ends, the torque at any communication point.
  void set(std::uint32_t reference, double value);

  /// Goes on by `step_s`, from the communication point that it is at.
  void step(double communication_point_s, double step_s);
  /// Of the communication point that the instance is at.
  double time_s() const;

  /// All that changes. A copy of it, given back, continues to the last bit.
  struct State {
    Phase phase = Phase::instantiated;
    double start_s = 0.0;
    std::optional<double> stop_s = {};
    arm::Arm arm = {};
    double torque_N_m = 0.0;
    std::optional<response::CosimulatedArm> motion = {};  ///< empty: to be made anew
    std::optional<std::vector<double>> readings = {};     ///< empty: to be read anew
  };
  const State& state() const { return state_; }
  void put(const State& state) { state_ = state; }

  /// A state as bytes, which another instance of the same FMU reads, in another process too, on a
  /// machine with the same order of bytes.
  std::vector<char> serialise(const State& state) const;
  State deserialise(std::span<const char> bytes) const;

 private:
  void require(bool is_allowed, std::string_view call) const;
  const FmuVariable& variable(std::uint32_t reference) const;
  double parameter(std::uint32_t reference) const;
  response::CosimulatedArm& motion();
  std::vector<double> numbers_of(const State& state) const;

  FmuSettings settings_;
  arm::Arm filed_;
  std::vector<FmuVariable> variables_;
  State state_;
};

}  // namespace flexarm::fmu
