// Writes what the scripts of benchmarks/comparison read into a folder.
#include "benchmarks/comparison/inputs.hpp"

#include <exception>
#include <iostream>

int main(int argc, char** argv) {
  using namespace flexarm::benchmarks;
  if (argc != 2) {
    std::cerr << "usage: comparison_inputs FOLDER\n";
    return 2;
  }
  try {
    for (const auto write : {write_roots, write_matrices, write_responses, write_simulations}) {
      write(argv[1]);
    }
  } catch (const std::exception& error) {
    std::cerr << "comparison_inputs: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
