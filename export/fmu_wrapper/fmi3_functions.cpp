#include "export/fmu_wrapper/c_boundary.hpp"
#include "export/fmu_wrapper/fmi3_interface.hpp"

#include <memory>
#include <optional>
#include <string>

using namespace flexarm::fmu;
using flexarm::arm::InputError;

namespace {

/// What a fmi3Instance points to.
struct Component3 {
  fmi3InstanceEnvironment environment = nullptr;
  fmi3LogMessageCallback log_message = nullptr;
  std::unique_ptr<FmuInstance> instance;

  void log(const char* message) const {
    if (log_message != nullptr) log_message(environment, fmi3Error, "logStatusError", message);
  }
};

/// Does `work` with the instance. An exception becomes a line of the log and fmi3Error.
template <class Work>
fmi3Status with3(fmi3Instance instance, Work work) noexcept {
  if (instance == nullptr) return fmi3Error;
  auto& of = *static_cast<Component3*>(instance);
  const bool is_done =
      without_exceptions([&] { work(of); }, [&](const char* line) { of.log(line); });
  return is_done ? fmi3OK : fmi3Error;
}

void require_same(std::size_t references, std::size_t values) {
  if (references == values) return;
  throw InputError("number of values: must be that of value references; all are scalars");
}

}  // namespace

extern "C" {

const char* fmi3GetVersion() {
  return "3.0";
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean /*on*/,
                               std::size_t /*categories*/, const fmi3String /*names*/[]) {
  // Errors are logged always; there is nothing else.
  return instance == nullptr ? fmi3Error : fmi3OK;
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instance_name, fmi3String instantiation_token, fmi3String resource_path,
    fmi3Boolean /*visible*/, fmi3Boolean /*logging_on*/, fmi3Boolean event_mode_used,
    fmi3Boolean /*early_return_allowed*/,
    const fmi3ValueReference /*required_intermediate_variables*/[], std::size_t required_count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log_message,
    fmi3IntermediateUpdateCallback /*intermediate_update*/) {
  std::unique_ptr<Component3> made;
  const auto make = [&] {
    made = std::make_unique<Component3>();
    made->environment = environment;
    made->log_message = log_message;
    require_given(instance_name, instantiation_token, resource_path);
    if (std::string(instance_name).empty()) throw InputError("instance name: is empty");
    if (event_mode_used) throw InputError("event mode: the FMU has none");
    if (required_count > 0) throw InputError("intermediate variables: the FMU provides none");
    made->instance = std::make_unique<FmuInstance>(resource_path, instantiation_token);
  };
  const bool is_made = without_exceptions(make, [&](const char* line) {
    if (made) made->log(line);
  });
  return is_made ? made.release() : nullptr;
}

void fmi3FreeInstance(fmi3Instance instance) {
  delete static_cast<Component3*>(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean /*tolerance_defined*/,
                                       fmi3Float64 /*tolerance*/, fmi3Float64 start_time,
                                       fmi3Boolean stop_time_defined, fmi3Float64 stop_time) {
  return with3(instance, [&](Component3& of) {
    of.instance->set_up(start_time, stop_time_defined ? std::optional(stop_time) : std::nullopt);
    of.instance->enter_initialisation();
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return with3(instance, [](Component3& of) { of.instance->exit_initialisation(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return with3(instance, [](Component3& of) { of.instance->terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return with3(instance, [](Component3& of) { of.instance->reset(); });
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t count, fmi3Float64 values[], std::size_t value_count) {
  return with3(instance, [&](Component3& of) {
    require_same(count, value_count);
    get_all(*of.instance, references, count, values);
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
                          std::size_t count, const fmi3Float64 values[], std::size_t value_count) {
  return with3(instance, [&](Component3& of) {
    require_same(count, value_count);
    set_all(*of.instance, references, count, values);
  });
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance, fmi3ValueReference reference,
                                               std::size_t* count) {
  return with3(instance, [&](Component3& of) {
    require_given(count);
    *count = of.instance->follows_torque(reference) ? 1 : 0;
  });
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       std::size_t of_dependent[],
                                       fmi3ValueReference independents[],
                                       std::size_t of_independents[], fmi3DependencyKind kinds[],
                                       std::size_t count) {
  return with3(instance, [&](Component3& of) {
    const std::size_t there_are = of.instance->follows_torque(dependent) ? 1 : 0;
    if (count != there_are) throw InputError("number of dependencies: not that of the variable");
    if (count == 0) return;
    require_given(of_dependent, independents, of_independents, kinds);
    of_dependent[0] = 0;
    independents[0] = kTorqueReference;
    of_independents[0] = 0;
    kinds[0] = fmi3Dependent;
  });
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return with3(instance, [&](Component3& of) { save_state(*of.instance, state); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState state) {
  return with3(instance, [&](Component3& of) { of.instance->put(state_at(state)); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* state) {
  return with3(instance, [&](Component3&) { free_state(state); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState state,
                                      std::size_t* size) {
  return with3(instance, [&](Component3& of) { measure_state(*of.instance, state, size); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState state, fmi3Byte bytes[],
                                 std::size_t size) {
  return with3(instance, [&](Component3& of) { write_state(*of.instance, state, bytes, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte bytes[], std::size_t size,
                                   fmi3FMUState* state) {
  return with3(instance, [&](Component3& of) {
    read_state(*of.instance, {reinterpret_cast<const char*>(bytes), size}, state);
  });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 communication_point, fmi3Float64 step_size,
                      fmi3Boolean /*no_set_state_before*/, fmi3Boolean* event_handling_needed,
                      fmi3Boolean* terminate_simulation, fmi3Boolean* early_return,
                      fmi3Float64* last_successful_time) {
  return with3(instance, [&](Component3& of) {
    require_given(event_handling_needed, terminate_simulation, early_return, last_successful_time);
    *event_handling_needed = false;
    *terminate_simulation = false;
    *early_return = false;
    *last_successful_time = of.instance->time_s();
    if (!(step_size > 0.0)) {
      throw flexarm::arm::out_of_range("communication step size", step_size, "s", "above 0");
    }
    of.instance->step(communication_point, step_size);
    *last_successful_time = of.instance->time_s();
  });
}
}
