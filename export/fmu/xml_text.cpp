#include "export/fmu/xml_text.hpp"

#include <fmt/format.h>

namespace flexarm::fmu {

namespace {

void write(const XmlElement& element, int depth, std::string& to) {
  const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
  to += fmt::format("{}<{}", indent, element.name);
  for (const auto& [name, value] : element.attributes) {
    to += fmt::format(" {}=\"{}\"", name, xml_escaped(value));
  }
  if (element.children.empty()) {
    to += "/>\n";
    return;
  }
  to += ">\n";
  for (const XmlElement& child : element.children) write(child, depth + 1, to);
  to += fmt::format("{}</{}>\n", indent, element.name);
}

}  // namespace

std::string xml_escaped(std::string_view text) {
  std::string made;
  for (const char c : text) {
    switch (c) {
      case '&':
        made += "&amp;";
        break;
      case '<':
        made += "&lt;";
        break;
      case '>':
        made += "&gt;";
        break;
      case '"':
        made += "&quot;";
        break;
      default:
        made += static_cast<unsigned char>(c) < 0x20U || c == 0x7F ? ' ' : c;
    }
  }
  return made;
}

std::string xml_number(double value) {
  return fmt::format("{}", value);
}

std::string xml_document(const XmlElement& root) {
  std::string made = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  write(root, 0, made);
  return made;
}

}  // namespace flexarm::fmu
