#pragma once

#include "arm/sensor.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace flexarm::report::page {

/// A text with the words of an engineer in the place of identifiers: of effects
/// ("Coulomb friction"), sensors ("hub angle", "strain at 0.05 m"), formulations ("finite
/// elements") and other names with underscores ("static torque"). Unlike with `in_words`
/// (report/words.hpp), keys of the arm file, which have a dot ("beam.youngs_modulus"), and names of
/// files stay as they are.
std::string text_in_words(std::string_view text);

/// `text_in_words` with a capital at its beginning.
std::string sentence_of(std::string_view text);

/// The unit of torque to that sensor, "(m/s²)/(N m)"; with a sensor of the hub as input "m/rad".
std::string response_unit(const arm::Sensor& sensor, const std::optional<arm::Sensor>& input = {});

/// Numbers as they stand beside a label.
std::string percent_of(double part);              ///< "60.5 %" of 0.605
std::string number_of(double value, int digits);  ///< "12.3"; a dash where it is no number

/// "0.002154091 ± 5.4e-08 N m": the value to two digits of its standard error.
std::string estimate_of(double value, double std_error, const std::string& unit);

}  // namespace flexarm::report::page
