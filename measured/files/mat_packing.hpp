#pragma once

#include "measured/files/mat_file.hpp"

#include <string>
#include <string_view>

namespace flexarm::measured {

/// Contents as bytes for another process of this program, and back. Bytes are those of
/// `packed_contents`; pages are not among them.
std::string packed_contents(const MatContents& contents);
MatContents unpacked_contents(std::string_view bytes);

}  // namespace flexarm::measured
