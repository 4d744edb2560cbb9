#include "report/xml_text.hpp"

namespace flexarm::report {

std::string xml_escaped(std::string_view text) {
  std::string xml;
  for (const char c : text) {
    switch (c) {
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '&':
        xml += "&amp;";
        break;
      default:
        xml += c;
    }
  }
  return xml;
}

}  // namespace flexarm::report
