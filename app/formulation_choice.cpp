#include "app/formulation_choice.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_formulation_choice(CLI::App& parser, FormulationChoice& choice) {
  parser.add_option("--formulation", choice.name, "exact_tf, fem or assumed_modes")
      ->capture_default_str();
  parser.add_option("--elements", choice.elements, "fem: number of elements");
  parser.add_option("--degree", choice.degree, "fem: degree of the shape functions");
  parser.add_option("--basis", choice.basis,
                    "assumed_modes: legendre, clamped_free, pinned_free, clamped_with_payload");
  parser.add_option("--functions", choice.functions, "assumed_modes: number of functions");
}

}  // namespace flexarm::app
