// Functions that FMI 3.0 asks of the library of every FMU, and that this one has no use for: other
// types of variables, other kinds of interface, events, clocks, derivatives. All of them return
// fmi3Error; values and derivatives of none at all are no error.
#include "export/fmu_wrapper/fmi3_interface.hpp"

extern "C" {

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment,
                                          fmi3LogMessageCallback) {
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment,
                                               fmi3LogMessageCallback, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  return nullptr;
}

#define FLEXARM_NO_VARIABLES(Name, Type)                                        \
  fmi3Status fmi3Get##Name(fmi3Instance instance, const fmi3ValueReference[],   \
                           std::size_t references, Type[], std::size_t) {       \
    return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;         \
  }                                                                             \
  fmi3Status fmi3Set##Name(fmi3Instance instance, const fmi3ValueReference[],   \
                           std::size_t references, const Type[], std::size_t) { \
    return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;         \
  }

FLEXARM_NO_VARIABLES(Float32, fmi3Float32)
FLEXARM_NO_VARIABLES(Int8, std::int8_t)
FLEXARM_NO_VARIABLES(UInt8, std::uint8_t)
FLEXARM_NO_VARIABLES(Int16, std::int16_t)
FLEXARM_NO_VARIABLES(UInt16, std::uint16_t)
FLEXARM_NO_VARIABLES(Int32, std::int32_t)
FLEXARM_NO_VARIABLES(UInt32, std::uint32_t)
FLEXARM_NO_VARIABLES(Int64, std::int64_t)
FLEXARM_NO_VARIABLES(UInt64, std::uint64_t)
FLEXARM_NO_VARIABLES(Boolean, fmi3Boolean)
FLEXARM_NO_VARIABLES(String, fmi3String)

#undef FLEXARM_NO_VARIABLES

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[], std::size_t references,
                         std::size_t[], fmi3Binary[], std::size_t) {
  return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[], std::size_t references,
                         const std::size_t[], const fmi3Binary[], std::size_t) {
  return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3GetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t references,
                        fmi3Clock[]) {
  return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;
}

fmi3Status fmi3SetClock(fmi3Instance instance, const fmi3ValueReference[], std::size_t references,
                        const fmi3Clock[]) {
  return instance != nullptr && references == 0 ? fmi3OK : fmi3Error;
}

#define FLEXARM_NO_CALL(Name)           \
  fmi3Status fmi3##Name(fmi3Instance) { \
    return fmi3Error;                   \
  }

FLEXARM_NO_CALL(EnterConfigurationMode)
FLEXARM_NO_CALL(ExitConfigurationMode)
FLEXARM_NO_CALL(EnterEventMode)
FLEXARM_NO_CALL(EnterStepMode)
FLEXARM_NO_CALL(EnterContinuousTimeMode)
FLEXARM_NO_CALL(EvaluateDiscreteStates)

#undef FLEXARM_NO_CALL

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                        const fmi3ValueReference[], std::size_t,
                                        const fmi3Float64[], std::size_t, fmi3Float64[],
                                        std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                    const fmi3ValueReference[], std::size_t, const fmi3Float64[],
                                    std::size_t, fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                    const std::int32_t[], fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                  fmi3Float64[], fmi3IntervalQualifier[]) {
  return fmi3Error;
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                   std::uint64_t[], std::uint64_t[], fmi3IntervalQualifier[]) {
  return fmi3Error;
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t,
                               fmi3Float64[]) {
  return fmi3Error;
}

fmi3Status fmi3GetShiftFraction(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                std::uint64_t[], std::uint64_t[]) {
  return fmi3Error;
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                  const fmi3Float64[]) {
  return fmi3Error;
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                   const std::uint64_t[], const std::uint64_t[]) {
  return fmi3Error;
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance, const fmi3ValueReference[], std::size_t,
                               const fmi3Float64[]) {
  return fmi3Error;
}

fmi3Status fmi3SetShiftFraction(fmi3Instance, const fmi3ValueReference[], std::size_t,
                                const std::uint64_t[], const std::uint64_t[]) {
  return fmi3Error;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                                    fmi3Boolean*, fmi3Boolean*, fmi3Float64*) {
  return fmi3Error;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance, fmi3Boolean, fmi3Boolean*, fmi3Boolean*) {
  return fmi3Error;
}

fmi3Status fmi3SetTime(fmi3Instance, fmi3Float64) {
  return fmi3Error;
}

fmi3Status fmi3SetContinuousStates(fmi3Instance, const fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance, fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance, fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance, fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance, fmi3Float64[], std::size_t) {
  return fmi3Error;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance, std::size_t*) {
  return fmi3Error;
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance, std::size_t*) {
  return fmi3Error;
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance, fmi3ValueReference, fmi3Float64) {
  return fmi3Error;
}
}
