#pragma once

#include "measured/files/modal_table.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace flexarm::measured {

/// A data set 55 of a universal file, "data at nodes", as far as a modal table has it.
struct UniversalMode {
  std::optional<ModalEntry> pole;  ///< empty for any other analysis, and a rigid-body mode
  std::string left_out;            ///< what of the data set is not in the pole, a phrase
};

/// Reads the lines between the number of the data set and its end. Poles are those of normal modes
/// (analysis type 2: frequency in Hz, viscous damping ratio, half the hysteretic one where that is
/// 0) and of complex modes (3 and 7: eigenvalue in rad/s). A damping of 0 is not known.
///
/// Throws InputError for records that are missing, fields that are no numbers, and a damping ratio
/// above 1, as of per cent; not located.
UniversalMode read_universal_mode(std::span<const std::string_view> lines);

}  // namespace flexarm::measured
