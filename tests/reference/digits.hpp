#pragma once

#include <nlohmann/json.hpp>

#include <complex>
#include <string>

namespace flexarm::reference {

/// The double nearest to a decimal string.
inline double number(const nlohmann::json& text) {
  return std::stod(text.get<std::string>());
}

/// [real part, imaginary part].
inline std::complex<double> complex_number(const nlohmann::json& pair) {
  return {number(pair.at(0)), number(pair.at(1))};
}

}  // namespace flexarm::reference
