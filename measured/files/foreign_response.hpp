#pragma once

#include <complex>
#include <cstddef>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A frequency response of a file that was not made for this program. Vectors are of one length.
struct ForeignResponse {
  std::string name;
  std::string unit;  ///< of the response, canonical; empty: not told
  std::string per;   ///< unit of what it is a response to; empty: not told
  std::vector<double> frequency_Hz;
  std::vector<std::complex<double>> response;
  std::vector<double> coherence;          ///< NaN where unknown
  std::vector<std::size_t> columns = {};  ///< of the table that it was made of; empty: of none
};

}  // namespace flexarm::measured
