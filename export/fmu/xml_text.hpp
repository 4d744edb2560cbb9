#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace flexarm::fmu {

/// Text as an attribute's value in XML 1.0; control characters, which XML cannot hold, become
/// blanks.
std::string xml_escaped(std::string_view text);

/// An element of an XML document.
struct XmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::vector<XmlElement> children = {};

  XmlElement& add(XmlElement child) { return children.emplace_back(std::move(child)); }
};

/// A number so that it reads back to the same double.
std::string xml_number(double value);

/// The document with that root, in UTF-8, an element a line.
std::string xml_document(const XmlElement& root);

}  // namespace flexarm::fmu
