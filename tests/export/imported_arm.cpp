#include "tests/export/imported_arm.hpp"

#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <stdexcept>

namespace flexarm::testing_export {

namespace {

constexpr double kNoStop_s = 1e9;

Result result_of(fmi2Status status) {
  return status == fmi2OK ? Result::ok : status == fmi2Error ? Result::error : Result::other;
}

Result result_of(fmi3Status status) {
  return status == fmi3OK ? Result::ok : status == fmi3Error ? Result::error : Result::other;
}

std::vector<unsigned> references_of(const UnpackedFmu& fmu, const std::vector<std::string>& names) {
  std::vector<unsigned> made;
  for (const std::string& name : names) made.push_back(fmu.reference(name));
  return made;
}

void log2(fmi2ComponentEnvironment environment, fmi2String, fmi2Status, fmi2String,
          fmi2String message, ...) {
  char line[1024];
  va_list arguments;
  va_start(arguments, message);
  std::vsnprintf(line, sizeof line, message, arguments);
  va_end(arguments);
  static_cast<ImportedArm*>(environment)->logged = line;
}

void log3(fmi3InstanceEnvironment environment, fmi3Status, fmi3String, fmi3String message) {
  static_cast<ImportedArm*>(environment)->logged = message;
}

#define CALL(Name) fmu_.function<decltype(Name)>(#Name)

class ImportedArm2 : public ImportedArm {
 public:
  ImportedArm2(const UnpackedFmu& fmu, const std::string& guid) : fmu_(fmu) {
    callbacks_.logger = log2;
    callbacks_.componentEnvironment = static_cast<ImportedArm*>(this);
    component_ =
        CALL(fmi2Instantiate)("arm", fmi2CoSimulation, guid.c_str(), fmu.resource_uri().c_str(),
                              &callbacks_, fmi2False, fmi2True);
  }
  ~ImportedArm2() override { CALL(fmi2FreeInstance)(component_); }

  bool is_there() const override { return component_ != nullptr; }
  Result set_up(double start_s, double stop_s) override {
    const Result result =
        result_of(CALL(fmi2SetupExperiment)(component_, fmi2False, 0.0, start_s, fmi2True, stop_s));
    return result == Result::ok ? result_of(CALL(fmi2EnterInitializationMode)(component_)) : result;
  }
  Result exit_initialisation() override {
    return result_of(CALL(fmi2ExitInitializationMode)(component_));
  }
  Result set(const std::vector<std::string>& names, const std::vector<double>& values) override {
    return result_of(CALL(fmi2SetReal)(component_, references_of(fmu_, names).data(), names.size(),
                                       values.data()));
  }
  Result get(const std::vector<std::string>& names, std::vector<double>& values) override {
    values.resize(names.size());
    return result_of(CALL(fmi2GetReal)(component_, references_of(fmu_, names).data(), names.size(),
                                       values.data()));
  }
  Result set_reference(unsigned reference, double value) override {
    return result_of(CALL(fmi2SetReal)(component_, &reference, 1, &value));
  }
  Result step(double at_s, double step_s) override {
    return result_of(CALL(fmi2DoStep)(component_, at_s, step_s, fmi2True));
  }
  Result terminate() override { return result_of(CALL(fmi2Terminate)(component_)); }
  Result reset() override { return result_of(CALL(fmi2Reset)(component_)); }
  Result save(void*& state) override {
    return result_of(CALL(fmi2GetFMUstate)(component_, &state));
  }
  Result put(void* state) override { return result_of(CALL(fmi2SetFMUstate)(component_, state)); }
  Result free_state(void*& state) override {
    return result_of(CALL(fmi2FreeFMUstate)(component_, &state));
  }
  Result serialise(void* state, std::vector<char>& bytes) override {
    std::size_t size = 0;
    const Result result = result_of(CALL(fmi2SerializedFMUstateSize)(component_, state, &size));
    if (result != Result::ok) return result;
    bytes.resize(size);
    return result_of(CALL(fmi2SerializeFMUstate)(component_, state, bytes.data(), size));
  }
  Result deserialise(const std::vector<char>& bytes, void*& state) override {
    return result_of(CALL(fmi2DeSerializeFMUstate)(component_, bytes.data(), bytes.size(), &state));
  }

 private:
  const UnpackedFmu& fmu_;
  fmi2CallbackFunctions callbacks_ = {};
  fmi2Component component_ = nullptr;
};

class ImportedArm3 : public ImportedArm {
 public:
  ImportedArm3(const UnpackedFmu& fmu, const std::string& token) : fmu_(fmu) {
    instance_ = CALL(fmi3InstantiateCoSimulation)("arm", token.c_str(), fmu.resources().c_str(),
                                                  false, true, false, false, nullptr, 0,
                                                  static_cast<ImportedArm*>(this), log3, nullptr);
  }
  ~ImportedArm3() override { CALL(fmi3FreeInstance)(instance_); }

  bool is_there() const override { return instance_ != nullptr; }
  Result set_up(double start_s, double stop_s) override {
    return result_of(
        CALL(fmi3EnterInitializationMode)(instance_, false, 0.0, start_s, true, stop_s));
  }
  Result exit_initialisation() override {
    return result_of(CALL(fmi3ExitInitializationMode)(instance_));
  }
  Result set(const std::vector<std::string>& names, const std::vector<double>& values) override {
    return result_of(CALL(fmi3SetFloat64)(instance_, references_of(fmu_, names).data(),
                                          names.size(), values.data(), values.size()));
  }
  Result get(const std::vector<std::string>& names, std::vector<double>& values) override {
    values.resize(names.size());
    return result_of(CALL(fmi3GetFloat64)(instance_, references_of(fmu_, names).data(),
                                          names.size(), values.data(), values.size()));
  }
  Result set_reference(unsigned reference, double value) override {
    return result_of(CALL(fmi3SetFloat64)(instance_, &reference, 1, &value, 1));
  }
  Result step(double at_s, double step_s) override {
    bool event = true;
    bool ends = true;
    bool early = true;
    double last_s = 0.0;
    const fmi3Status status =
        CALL(fmi3DoStep)(instance_, at_s, step_s, true, &event, &ends, &early, &last_s);
    if (status == fmi3OK && (event || ends || early)) return Result::other;
    return result_of(status);
  }
  Result terminate() override { return result_of(CALL(fmi3Terminate)(instance_)); }
  Result reset() override { return result_of(CALL(fmi3Reset)(instance_)); }
  Result save(void*& state) override { return result_of(CALL(fmi3GetFMUState)(instance_, &state)); }
  Result put(void* state) override { return result_of(CALL(fmi3SetFMUState)(instance_, state)); }
  Result free_state(void*& state) override {
    return result_of(CALL(fmi3FreeFMUState)(instance_, &state));
  }
  Result serialise(void* state, std::vector<char>& bytes) override {
    std::size_t size = 0;
    const Result result = result_of(CALL(fmi3SerializedFMUStateSize)(instance_, state, &size));
    if (result != Result::ok) return result;
    bytes.resize(size);
    return result_of(CALL(fmi3SerializeFMUState)(instance_, state,
                                                 reinterpret_cast<fmi3Byte*>(bytes.data()), size));
  }
  Result deserialise(const std::vector<char>& bytes, void*& state) override {
    return result_of(CALL(fmi3DeserializeFMUState)(
        instance_, reinterpret_cast<const fmi3Byte*>(bytes.data()), bytes.size(), &state));
  }

 private:
  const UnpackedFmu& fmu_;
  fmi3Instance instance_ = nullptr;
};

#undef CALL

}  // namespace

double ImportedArm::value(const std::string& name) {
  std::vector<double> values;
  if (get({name}, values) != Result::ok) throw std::runtime_error(name + ": " + logged);
  return values[0];
}

Result ImportedArm::start(const std::map<std::string, double>& parameters) {
  for (const auto& [name, value] : parameters) {
    if (const Result result = set({name}, {value}); result != Result::ok) return result;
  }
  const Result result = set_up(0.0, kNoStop_s);
  return result == Result::ok ? exit_initialisation() : result;
}

std::unique_ptr<ImportedArm> instantiate2(const UnpackedFmu& fmu, const std::string& guid) {
  return std::make_unique<ImportedArm2>(fmu, guid.empty() ? fmu.description().get("guid") : guid);
}

std::unique_ptr<ImportedArm> instantiate3(const UnpackedFmu& fmu, const std::string& token) {
  return std::make_unique<ImportedArm3>(
      fmu, token.empty() ? fmu.description().get("instantiationToken") : token);
}

}  // namespace flexarm::testing_export
