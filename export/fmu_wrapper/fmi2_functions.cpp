#include "export/fmu_wrapper/c_boundary.hpp"
#include "export/fmu_wrapper/fmi2_interface.hpp"
#include "export/fmu_wrapper/resource_folder.hpp"

#include <memory>
#include <optional>
#include <string>

using namespace flexarm::fmu;
using flexarm::arm::InputError;

namespace {

/// What a fmi2Component points to.
struct Component2 {
  std::string name;
  fmi2CallbackFunctions callbacks;
  std::unique_ptr<FmuInstance> instance;
  fmi2Status last_step = fmi2OK;

  void log(const char* message) const {
    if (callbacks.logger == nullptr) return;
    callbacks.logger(callbacks.componentEnvironment, name.c_str(), fmi2Error, "logStatusError",
                     "%s", message);
  }
};

/// Does `work` with the component. An exception becomes a line of the log and fmi2Error.
template <class Work>
fmi2Status with2(fmi2Component component, Work work) noexcept {
  if (component == nullptr) return fmi2Error;
  auto& of = *static_cast<Component2*>(component);
  const bool is_done =
      without_exceptions([&] { work(of); }, [&](const char* line) { of.log(line); });
  return is_done ? fmi2OK : fmi2Error;
}

fmi2Status refuse2(fmi2Component component, const char* line) noexcept {
  return with2(component, [&](Component2&) { throw InputError(line); });
}

fmi2Status only_reals(fmi2Component component, std::size_t count) noexcept {
  if (count == 0 && component != nullptr) return fmi2OK;
  return refuse2(component, "all variables of this FMU are of type Real");
}

}  // namespace

extern "C" {

const char* fmi2GetTypesPlatform() {
  return "default";
}
const char* fmi2GetVersion() {
  return "2.0";
}

fmi2Status fmi2SetDebugLogging(fmi2Component component, fmi2Boolean /*on*/,
                               std::size_t /*categories*/, const fmi2String /*names*/[]) {
  // Errors are logged always; there is nothing else.
  return component == nullptr ? fmi2Error : fmi2OK;
}

fmi2Component fmi2Instantiate(fmi2String instance_name, fmi2Type type, fmi2String guid,
                              fmi2String resource_location, const fmi2CallbackFunctions* callbacks,
                              fmi2Boolean /*visible*/, fmi2Boolean /*logging_on*/) {
  if (callbacks == nullptr) return nullptr;
  auto made = std::make_unique<Component2>();
  made->callbacks = *callbacks;
  const bool is_made = without_exceptions(
      [&] {
        require_given(instance_name, guid, resource_location);
        made->name = instance_name;
        if (made->name.empty()) throw InputError("instance name: is empty");
        if (type != fmi2CoSimulation) throw InputError("FMU type: only co-simulation");
        made->instance = std::make_unique<FmuInstance>(folder_of_location(resource_location), guid);
      },
      [&](const char* line) { made->log(line); });
  return is_made ? made.release() : nullptr;
}

void fmi2FreeInstance(fmi2Component component) {
  delete static_cast<Component2*>(component);
}

fmi2Status fmi2SetupExperiment(fmi2Component component, fmi2Boolean /*tolerance_defined*/,
                               fmi2Real /*tolerance*/, fmi2Real start_time,
                               fmi2Boolean stop_time_defined, fmi2Real stop_time) {
  return with2(component, [&](Component2& of) {
    of.instance->set_up(start_time,
                        stop_time_defined != fmi2False ? std::optional(stop_time) : std::nullopt);
  });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component component) {
  return with2(component, [](Component2& of) { of.instance->enter_initialisation(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component component) {
  return with2(component, [](Component2& of) { of.instance->exit_initialisation(); });
}

fmi2Status fmi2Terminate(fmi2Component component) {
  return with2(component, [](Component2& of) { of.instance->terminate(); });
}

fmi2Status fmi2Reset(fmi2Component component) {
  return with2(component, [](Component2& of) {
    of.instance->reset();
    of.last_step = fmi2OK;
  });
}

fmi2Status fmi2GetReal(fmi2Component component, const fmi2ValueReference references[],
                       std::size_t count, fmi2Real values[]) {
  return with2(component,
               [&](Component2& of) { get_all(*of.instance, references, count, values); });
}

fmi2Status fmi2SetReal(fmi2Component component, const fmi2ValueReference references[],
                       std::size_t count, const fmi2Real values[]) {
  return with2(component,
               [&](Component2& of) { set_all(*of.instance, references, count, values); });
}

fmi2Status fmi2GetInteger(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                          fmi2Integer[]) {
  return only_reals(component, count);
}

fmi2Status fmi2GetBoolean(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                          fmi2Boolean[]) {
  return only_reals(component, count);
}

fmi2Status fmi2GetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                         fmi2String[]) {
  return only_reals(component, count);
}

fmi2Status fmi2SetInteger(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                          const fmi2Integer[]) {
  return only_reals(component, count);
}

fmi2Status fmi2SetBoolean(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                          const fmi2Boolean[]) {
  return only_reals(component, count);
}

fmi2Status fmi2SetString(fmi2Component component, const fmi2ValueReference[], std::size_t count,
                         const fmi2String[]) {
  return only_reals(component, count);
}

fmi2Status fmi2GetFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return with2(component, [&](Component2& of) { save_state(*of.instance, state); });
}

fmi2Status fmi2SetFMUstate(fmi2Component component, fmi2FMUstate state) {
  return with2(component, [&](Component2& of) { of.instance->put(state_at(state)); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component component, fmi2FMUstate* state) {
  return with2(component, [&](Component2&) { free_state(state); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component component, fmi2FMUstate state,
                                      std::size_t* size) {
  return with2(component, [&](Component2& of) { measure_state(*of.instance, state, size); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component component, fmi2FMUstate state, fmi2Byte bytes[],
                                 std::size_t size) {
  return with2(component, [&](Component2& of) { write_state(*of.instance, state, bytes, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component component, const fmi2Byte bytes[],
                                   std::size_t size, fmi2FMUstate* state) {
  return with2(component, [&](Component2& of) { read_state(*of.instance, {bytes, size}, state); });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component component, const fmi2ValueReference[],
                                        std::size_t, const fmi2ValueReference[], std::size_t,
                                        const fmi2Real[], fmi2Real[]) {
  return refuse2(component, "directional derivatives are not provided");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component component, const fmi2ValueReference[],
                                       std::size_t, const fmi2Integer[], const fmi2Real[]) {
  return refuse2(component, "inputs are not interpolated: the torque is constant over a step");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component component, const fmi2ValueReference[],
                                        std::size_t, const fmi2Integer[], fmi2Real[]) {
  return refuse2(component, "derivatives of outputs are not provided");
}

fmi2Status fmi2DoStep(fmi2Component component, fmi2Real communication_point, fmi2Real step_size,
                      fmi2Boolean /*no_set_state_before*/) {
  const fmi2Status status =
      with2(component, [&](Component2& of) { of.instance->step(communication_point, step_size); });
  if (component != nullptr) static_cast<Component2*>(component)->last_step = status;
  return status;
}

fmi2Status fmi2CancelStep(fmi2Component component) {
  return refuse2(component, "steps are not asynchronous");
}

fmi2Status fmi2GetStatus(fmi2Component component, fmi2StatusKind kind, fmi2Status* value) {
  return with2(component, [&](Component2& of) {
    if (kind != fmi2DoStepStatus) throw InputError("status: not of that type");
    require_given(value);
    *value = of.last_step;
  });
}

fmi2Status fmi2GetRealStatus(fmi2Component component, fmi2StatusKind kind, fmi2Real* value) {
  return with2(component, [&](Component2& of) {
    if (kind != fmi2LastSuccessfulTime) throw InputError("status: not of that type");
    require_given(value);
    *value = of.instance->time_s();
  });
}

fmi2Status fmi2GetIntegerStatus(fmi2Component component, fmi2StatusKind, fmi2Integer*) {
  return refuse2(component, "status: not of that type");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component component, fmi2StatusKind kind, fmi2Boolean* value) {
  return with2(component, [&](Component2&) {
    if (kind != fmi2Terminated) throw InputError("status: not of that type");
    require_given(value);
    *value = fmi2False;
  });
}

fmi2Status fmi2GetStringStatus(fmi2Component component, fmi2StatusKind kind, fmi2String* value) {
  return with2(component, [&](Component2&) {
    if (kind != fmi2PendingStatus) throw InputError("status: not of that type");
    require_given(value);
    *value = "";
  });
}
}
