#pragma once

#include "arm/input_error.hpp"
#include "export/fmu_wrapper/fmu_instance.hpp"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <span>
#include <utility>

namespace flexarm::fmu {

/// Does `work`. No exception leaves: `failed(line)` is called with what one says, and the result is
/// false.
template <class Work, class Failed>
bool without_exceptions(Work work, Failed failed) noexcept {
  try {
    work();
    return true;
  } catch (const std::exception& error) {
    failed(error.what());
  } catch (...) {
    failed("unknown error");
  }
  return false;
}

/// Throws unless all of the pointers that a caller handed over point somewhere.
template <class... Pointers>
void require_given(Pointers... pointers) {
  if ((... && (pointers != nullptr))) return;
  throw arm::InputError("argument: null pointer");
}

/// What both versions of the interface do with values and saved states.

template <class Reference>
void get_all(FmuInstance& instance, const Reference* references, std::size_t count,
             double* values) {
  if (count == 0) return;
  require_given(references, values);
  for (std::size_t i = 0; i < count; ++i) values[i] = instance.get(references[i]);
}

template <class Reference>
void set_all(FmuInstance& instance, const Reference* references, std::size_t count,
             const double* values) {
  if (count == 0) return;
  require_given(references, values);
  for (std::size_t i = 0; i < count; ++i) instance.set(references[i], values[i]);
}

inline FmuInstance::State& state_at(void* state) {
  require_given(state);
  return *static_cast<FmuInstance::State*>(state);
}

inline void save_state(const FmuInstance& instance, void** state) {
  require_given(state);
  if (*state != nullptr) {
    state_at(*state) = instance.state();
  } else {
    *state = new FmuInstance::State(instance.state());
  }
}

inline void free_state(void** state) {
  if (state != nullptr) delete static_cast<FmuInstance::State*>(std::exchange(*state, nullptr));
}

inline void measure_state(const FmuInstance& instance, void* state, std::size_t* size) {
  require_given(size);
  *size = instance.serialise(state_at(state)).size();
}

template <class Byte>
void write_state(const FmuInstance& instance, void* state, Byte* bytes, std::size_t size) {
  require_given(bytes);
  const std::vector<char> made = instance.serialise(state_at(state));
  if (size < made.size()) throw arm::InputError("serialised state: too little room");
  std::ranges::transform(made, bytes, [](char byte) { return static_cast<Byte>(byte); });
}

inline void read_state(const FmuInstance& instance, std::span<const char> bytes, void** state) {
  require_given(bytes.data(), state);
  *state = new FmuInstance::State(instance.deserialise(bytes));
}

}  // namespace flexarm::fmu
