#include "response/excitation/excitation_keys.hpp"

#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "arm/number.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <utility>

namespace flexarm::response {

namespace {

using arm::InputError;

/// Where a number of an excitation lies.
struct Slot {
  const char* name;
  const char* unit;
  std::variant<double*, int*, std::uint64_t*, Sweep*> target;
};

std::vector<Slot> slots_of(BangBang& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m},
          {"pulse", "s", &signal.pulse_s},
          {"start", "s", &signal.start_s},
          {"pairs", "", &signal.pairs}};
}

std::vector<Slot> slots_of(Step& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m}, {"start", "s", &signal.start_s}};
}

std::vector<Slot> slots_of(RandomNoise& signal) {
  return {{"rms", "N m", &signal.rms_N_m},
          {"from", "Hz", &signal.from_Hz},
          {"to", "Hz", &signal.to_Hz},
          {"seed", "", &signal.seed}};
}

std::vector<Slot> slots_of(Multisine& signal) {
  return {{"rms", "N m", &signal.rms_N_m},
          {"from", "Hz", &signal.from_Hz},
          {"to", "Hz", &signal.to_Hz},
          {"period", "s", &signal.period_s},
          {"detection", "", &signal.detection_group},
          {"seed", "", &signal.seed}};
}

std::vector<Slot> slots_of(Chirp& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m},
          {"from", "Hz", &signal.from_Hz},
          {"to", "Hz", &signal.to_Hz},
          {"sweep", "", &signal.sweep}};
}

std::vector<Slot> slots_of(Staircase& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m},
          {"dwell", "s", &signal.dwell_s},
          {"start", "s", &signal.start_s},
          {"levels", "", &signal.levels}};
}

std::vector<Slot> slots_of(Prbs& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m},
          {"clock", "s", &signal.clock_s},
          {"register", "", &signal.register_length},
          {"seed", "", &signal.seed}};
}

std::vector<Slot> slots_of(Sine& signal) {
  return {{"amplitude", "N m", &signal.amplitude_N_m},
          {"frequency", "Hz", &signal.frequency_Hz},
          {"offset", "N m", &signal.offset_N_m},
          {"phase", "rad", &signal.phase_rad},
          {"start", "s", &signal.start_s}};
}

/// Each kind of excitation, with its defaults.
std::vector<Excitation> every_kind() {
  return {BangBang{}, Step{}, RandomNoise{}, Multisine{}, Chirp{}, Staircase{}, Prbs{}, Sine{}};
}

constexpr std::array<std::pair<Sweep, const char*>, 2> kSweeps = {
    {{Sweep::linear, "linear"}, {Sweep::logarithmic, "logarithmic"}}};

std::string text_of(double value) {
  return fmt::format("{}", value);
}

std::string text_of(int value) {
  return fmt::format("{}", value);
}

std::string text_of(std::uint64_t value) {
  return fmt::format("{}", value);
}

std::string text_of(Sweep value) {
  for (const auto& [sweep, word] : kSweeps) {
    if (sweep == value) return word;
  }
  return "";
}

template <class T>
std::string set_number(std::string_view text, T& number, const char* what) {
  const auto value = arm::parse_number<T>(text);
  if (!value) return what;
  number = *value;
  return "";
}

/// Reads `text` into the target; what it must be when it is not, else "".
std::string set(std::string_view text, double& value) {
  return set_number(text, value, "a number");
}

std::string set(std::string_view text, int& value) {
  return set_number(text, value, "a whole number");
}

std::string set(std::string_view text, std::uint64_t& value) {
  return set_number(text, value, "a whole number, 0 or more");
}

std::string set(std::string_view text, Sweep& value) {
  for (const auto& [sweep, word] : kSweeps) {
    if (text != word) continue;
    value = sweep;
    return "";
  }
  return "linear or logarithmic";
}

std::vector<Slot> slots_of(Excitation& excitation) {
  return std::visit([](auto& signal) { return slots_of(signal); }, excitation);
}

}  // namespace

const std::vector<std::string>& excitation_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Excitation& excitation : every_kind()) all.emplace_back(name(excitation));
    return all;
  }();
  return names;
}

Excitation excitation_of(std::string_view typed, const std::vector<std::string>& further) {
  for (const Excitation& excitation : every_kind()) {
    if (name(excitation) == typed) return excitation;
  }
  std::vector<std::string> allowed = excitation_names();
  allowed.insert(allowed.end(), further.begin(), further.end());
  throw InputError(fmt::format("excitation {}: unknown{}; allowed: {}", arm::shown(typed),
                               arm::did_you_mean(typed, allowed), fmt::join(allowed, ", ")));
}

std::vector<ExcitationKey> keys_of(const Excitation& excitation) {
  Excitation copy = excitation;
  std::vector<ExcitationKey> keys;
  for (const auto& slot : slots_of(copy)) {
    keys.push_back({slot.name, slot.unit,
                    std::visit([](const auto* value) { return text_of(*value); }, slot.target)});
  }
  return keys;
}

void set_key(Excitation& excitation, std::string_view key, std::string_view value,
             const std::vector<std::string>& further) {
  std::vector<std::string> allowed;
  for (const auto& slot : slots_of(excitation)) {
    allowed.emplace_back(slot.name);
    if (key != slot.name) continue;
    const std::string wrong =
        std::visit([&](auto* target) { return set(value, *target); }, slot.target);
    if (wrong.empty()) return;
    throw InputError(fmt::format("{}.{} = {}: must be {}{}", name(excitation), key,
                                 arm::shown(value), wrong,
                                 *slot.unit == '\0' ? "" : fmt::format(" [{}]", slot.unit)));
  }
  allowed.insert(allowed.end(), further.begin(), further.end());
  throw InputError(fmt::format("{}.{}: unknown{}; allowed: {}", name(excitation), arm::shown(key),
                               arm::did_you_mean(key, allowed), fmt::join(allowed, ", ")));
}

std::string describe(std::string_view excitation, const std::vector<ExcitationKey>& keys) {
  std::string text(excitation);
  for (const auto& key : keys) {
    text += fmt::format(", {} {}{}{}", key.name, key.value, key.unit.empty() ? "" : " ", key.unit);
  }
  return text;
}

}  // namespace flexarm::response
