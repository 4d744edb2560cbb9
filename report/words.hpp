#pragma once

#include <string>
#include <string_view>

namespace flexarm::report {

/// `text` with each id of a file in words, as figures, tables and pages show them; CSV and JSON
/// keep the ids. "coulomb_friction" is "Coulomb friction", "payload.mass" "payload mass",
/// "effects.root_compliance.stiffness" "root compliance stiffness", "strain@0.05"
/// "strain at 0.05 m", "sensor_delay on hub_angle" "sensor delay on hub angle", "exact_tf" "exact
/// transfer function". What is no id stays as it is.
std::string in_words(std::string_view text);

/// The same of a single id.
std::string id_in_words(std::string_view id);

/// A unit with superscripts: "m/s²" for "m/s^2"; empty for "1".
std::string unit_text(std::string_view unit);

/// Digits and a sign as superscripts: "⁻³" for -3.
std::string superscript(int exponent);

}  // namespace flexarm::report
