#include "python/module.hpp"

#include "python/signatures.hpp"

PYBIND11_MODULE(_flexarm, module) {
  using namespace flexarm::python;
  module.doc() = "The extension behind the package flexarm, which has all its names.";
  module.attr("__version__") = FLEXARM_VERSION;
  pybind11::options options;
  options.disable_function_signatures();  // add_signatures gives those of Python
  add_errors(module);
  add_arm(module);
  add_effects(module);
  add_roots(module);
  add_responses(module);
  add_formulations(module);
  add_controllers(module);
  add_simulated_runs(module);
  add_simulation(module);
  add_measurements(module);
  add_importing(module);
  add_identification(module);
  add_planning(module);
  add_diagnosis(module);
  add_signatures(module);
}
