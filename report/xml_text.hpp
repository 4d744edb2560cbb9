#pragma once

#include <string>
#include <string_view>

namespace flexarm::report {

/// The text as it may stand between tags of XML or HTML.
std::string xml_escaped(std::string_view text);

}  // namespace flexarm::report
