#pragma once

#include "compare/paper/paper_tables.hpp"

#include <string>
#include <vector>

namespace flexarm::compare::paper {

/// One cell of Tables 2-5 that follows from others.
struct CellCheck {
  int table = 0;
  std::string cell;  ///< "autopower spectrum, location-1, pole 2: error"
  std::string unit;
  PrintedNumber printed;
  double recomputed = 0.0;
  bool follows = false;  ///< the recomputed value rounds to the printed one
};

/// Every error, average and error of an average in Tables 2-5, recomputed from the cells it is made
/// of: an error is |measured - analytical|/analytical, an average the mean over the locations.
std::vector<CellCheck> check_cells();

/// How many of the random-excitation frequencies of Tables 2 and 3 (averages left out) are printed
/// as a multiple of `spacing_Hz`, to the digits printed.
struct GridCount {
  int on_grid = 0;
  int cells = 0;
  std::vector<std::string> off_grid;  ///< the cells that are not, by name
};
GridCount count_on_grid(double spacing_Hz);

}  // namespace flexarm::compare::paper
