#include "export/fmu_wrapper/fmu_instance.hpp"

#include "arm/input_error.hpp"
#include "effects/registry/vocabulary.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/text_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <utility>

namespace flexarm::fmu {

namespace {

using arm::InputError;

constexpr std::size_t kLargestFile_bytes = 1 << 20;
/// Of a sample time: rounding of an environment that adds up its steps is less.
constexpr double kSamePoint = 1e-4;
/// At the head of a serialised state.
constexpr double kStateFormat = 1.0;

std::string_view name_of(Phase phase) {
  switch (phase) {
    case Phase::instantiated:
      return "instantiated";
    case Phase::initialising:
      return "initialization mode";
    case Phase::stepping:
      return "step mode";
    case Phase::terminated:
      return "terminated";
    case Phase::failed:
      return "step failed";
  }
  return "";
}

InputError other_state() {
  return InputError("serialised state: not of this FMU");
}

}  // namespace

FmuInstance::FmuInstance(const std::filesystem::path& resources, std::string_view token) {
  const auto settings_file = resources / kSettingsFile;
  settings_ = parse_settings(measured::read_text_file(settings_file, kLargestFile_bytes),
                             settings_file.string());
  if (settings_.token != token) {
    throw InputError(
        fmt::format("GUID or instantiation token {}: must be {}, that of the model "
                    "description",
                    arm::shown(token), settings_.token));
  }
  const auto arm_file = resources / kArmFile;
  filed_ = measured::parse_arm(measured::read_text_file(arm_file, measured::kLargestArmFile_bytes),
                               arm_file.string(), effects::vocabulary());
  variables_ = fmu_variables(filed_, settings_.sensors);
  state_.arm = filed_;
}

void FmuInstance::require(bool is_allowed, std::string_view call) const {
  if (is_allowed) return;
  throw InputError(fmt::format("{}: not allowed in state \"{}\"", call, name_of(state_.phase)));
}

void FmuInstance::set_up(double start_s, std::optional<double> stop_s) {
  require(state_.phase == Phase::instantiated, "setting up the experiment");
  if (!std::isfinite(start_s)) throw arm::out_of_range("start time", start_s, "s", "finite");
  if (stop_s && !(*stop_s >= start_s)) {
    throw arm::out_of_range("stop time", *stop_s, "s", "at or after the start time");
  }
  state_.start_s = start_s;
  state_.stop_s = stop_s;
}

void FmuInstance::enter_initialisation() {
  require(state_.phase == Phase::instantiated, "entering initialization mode");
  state_.phase = Phase::initialising;
}

void FmuInstance::exit_initialisation() {
  require(state_.phase == Phase::initialising, "exiting initialization mode");
  motion();
  state_.phase = Phase::stepping;
}

void FmuInstance::terminate() {
  require(state_.phase == Phase::stepping || state_.phase == Phase::failed, "terminating");
  state_.phase = Phase::terminated;
}

void FmuInstance::reset() {
  state_ = {.arm = filed_};
}

const FmuVariable& FmuInstance::variable(std::uint32_t reference) const {
  if (reference < variables_.size()) return variables_[reference];
  throw InputError(fmt::format("value reference {}: unknown; there are 0 to {}", reference,
                               variables_.size() - 1));
}

/// The model of the arm with its present parameters, at rest.
response::CosimulatedArm& FmuInstance::motion() {
  if (!state_.motion) {
    state_.motion.emplace(make_cosimulated(state_.arm, settings_));
    state_.motion->set_torque(state_.torque_N_m);
    state_.readings.reset();
  }
  return *state_.motion;
}

double FmuInstance::parameter(std::uint32_t reference) const {
  return fmu_variables(state_.arm, settings_.sensors)[reference].start;
}

double FmuInstance::get(std::uint32_t reference) {
  const FmuVariable& of = variable(reference);
  require(state_.phase != Phase::instantiated, fmt::format("getting {}", of.name));
  switch (of.causality) {
    case Causality::independent:
      return time_s();
    case Causality::input:
      return state_.torque_N_m;
    case Causality::parameter:
      return parameter(reference);
    case Causality::output:
      break;
  }
  if (!state_.readings) state_.readings = motion().readings();
  return (*state_.readings)[reference - kFirstOutputReference];
}

void FmuInstance::set(std::uint32_t reference, double value) {
  const FmuVariable& of = variable(reference);
  const bool is_before = state_.phase == Phase::instantiated || state_.phase == Phase::initialising;
  const auto call = [&] { return fmt::format("setting {}", of.name); };
  if (of.causality == Causality::input) {
    require(is_before || state_.phase == Phase::stepping, call());
    if (!std::isfinite(value)) throw arm::out_of_range(of.name, value, of.unit, "finite");
    if (state_.motion) state_.motion->set_torque(value);
    state_.torque_N_m = value;
    state_.readings.reset();
    return;
  }
  if (of.causality != Causality::parameter) {
    throw InputError(fmt::format("setting {}: neither an input nor a parameter", of.name));
  }
  require(is_before, call());
  set_parameter(state_.arm, of, value);
  state_.motion.reset();
  state_.readings.reset();
}

double FmuInstance::time_s() const {
  return state_.start_s + (state_.motion ? state_.motion->time_s() : 0.0);
}

void FmuInstance::step(double communication_point_s, double step_s) {
  require(state_.phase == Phase::stepping, "doing a step");
  if (!std::isfinite(step_s) || step_s < 0.0) {
    throw arm::out_of_range("communication step size", step_s, "s", "0 or more");
  }
  const double tolerance_s = kSamePoint * settings_.sample_time_s;
  // What the environment's clock has gained by rounding; more than that is another point.
  const double ahead_s = communication_point_s - time_s();
  if (!(std::abs(ahead_s) <= 10.0 * tolerance_s)) {
    throw InputError(fmt::format("communication point {} s: must be {} s, the end of the last step",
                                 communication_point_s, time_s()));
  }
  if (state_.stop_s && communication_point_s + step_s > *state_.stop_s + tolerance_s) {
    throw InputError(fmt::format("step to {} s: beyond the stop time {} s",
                                 communication_point_s + step_s, *state_.stop_s));
  }
  try {
    const bool is_off = std::abs(ahead_s) > tolerance_s;
    motion().advance(is_off ? std::max(0.0, step_s + ahead_s) : step_s);
  } catch (...) {
    state_.phase = Phase::failed;
    throw;
  }
  state_.readings.reset();
}

std::vector<double> FmuInstance::numbers_of(const State& state) const {
  std::vector<double> numbers = {kStateFormat,
                                 static_cast<double>(state.phase),
                                 state.start_s,
                                 state.stop_s ? 1.0 : 0.0,
                                 state.stop_s.value_or(0.0),
                                 state.torque_N_m,
                                 state.motion ? 1.0 : 0.0,
                                 static_cast<double>(variables_.size())};
  for (const FmuVariable& number : fmu_variables(state.arm, settings_.sensors)) {
    numbers.push_back(number.start);
  }
  if (state.motion) {
    const std::vector<double> moving = state.motion->state();
    numbers.insert(numbers.end(), moving.begin(), moving.end());
  }
  return numbers;
}

std::vector<char> FmuInstance::serialise(const State& state) const {
  const std::vector<double> numbers = numbers_of(state);
  std::vector<char> bytes(settings_.token.size() + numbers.size() * sizeof(double));
  std::memcpy(bytes.data(), settings_.token.data(), settings_.token.size());
  std::memcpy(bytes.data() + settings_.token.size(), numbers.data(),
              numbers.size() * sizeof(double));
  return bytes;
}

FmuInstance::State FmuInstance::deserialise(std::span<const char> bytes) const {
  const std::size_t token = settings_.token.size();
  constexpr std::size_t kHead = 8;
  if (bytes.size() < token + (kHead + variables_.size()) * sizeof(double) ||
      std::string_view(bytes.data(), token) != settings_.token ||
      (bytes.size() - token) % sizeof(double) != 0) {
    throw other_state();
  }
  std::vector<double> numbers((bytes.size() - token) / sizeof(double));
  std::memcpy(numbers.data(), bytes.data() + token, numbers.size() * sizeof(double));
  const double last_phase = static_cast<double>(Phase::failed);
  if (numbers[0] != kStateFormat || !(numbers[1] >= 0.0 && numbers[1] <= last_phase) ||
      numbers[7] != static_cast<double>(variables_.size())) {
    throw other_state();
  }
  State made{.phase = static_cast<Phase>(static_cast<int>(numbers[1])),
             .start_s = numbers[2],
             .arm = filed_,
             .torque_N_m = numbers[5]};
  if (numbers[3] != 0.0) made.stop_s = numbers[4];
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const FmuVariable& of = variables_[i];
    const double value = numbers[kHead + i];
    if (of.causality == Causality::parameter && value != of.start)
      set_parameter(made.arm, of, value);
  }
  if (numbers[6] != 0.0) {
    made.motion.emplace(make_cosimulated(made.arm, settings_));
    made.motion->restore(std::span(numbers).subspan(kHead + variables_.size()));
  }
  return made;
}

}  // namespace flexarm::fmu
