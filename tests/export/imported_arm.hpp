#pragma once

#include "export/fmu_wrapper/fmi2_interface.hpp"
#include "export/fmu_wrapper/fmi3_interface.hpp"
#include "tests/export/unpacked_fmu.hpp"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace flexarm::testing_export {

/// What both versions of the interface call success, and failure.
enum class Result { ok, error, other };

/// An instance of an FMU, through the C interface of its version: a small importer.
class ImportedArm {
 public:
  virtual ~ImportedArm() = default;

  virtual bool is_there() const = 0;                         ///< instantiation succeeded
  virtual Result set_up(double start_s, double stop_s) = 0;  ///< and enters initialization mode
  virtual Result exit_initialisation() = 0;
  virtual Result set(const std::vector<std::string>& names, const std::vector<double>& values) = 0;
  virtual Result get(const std::vector<std::string>& names, std::vector<double>& values) = 0;
  virtual Result set_reference(unsigned reference, double value) = 0;
  virtual Result step(double at_s, double step_s) = 0;
  virtual Result terminate() = 0;
  virtual Result reset() = 0;
  virtual Result save(void*& state) = 0;
  virtual Result put(void* state) = 0;
  virtual Result free_state(void*& state) = 0;
  virtual Result serialise(void* state, std::vector<char>& bytes) = 0;
  virtual Result deserialise(const std::vector<char>& bytes, void*& state) = 0;

  /// What the FMU logged last.
  std::string logged;

  double value(const std::string& name);
  /// Instantiated, set up and initialised with these parameters, from time 0.
  Result start(const std::map<std::string, double>& parameters = {});
};

/// Of FMI 2.0; `guid` empty: that of the description.
std::unique_ptr<ImportedArm> instantiate2(const UnpackedFmu& fmu, const std::string& guid = "");
/// Of FMI 3.0.
std::unique_ptr<ImportedArm> instantiate3(const UnpackedFmu& fmu, const std::string& token = "");

}  // namespace flexarm::testing_export
