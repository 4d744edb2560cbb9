#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace flexarm::testing_export {

/// An element as expat reads it.
struct XmlNode {
  std::string name;
  std::map<std::string, std::string> attributes = {};
  std::vector<XmlNode> children = {};

  bool has(const std::string& attribute) const { return attributes.contains(attribute); }
  /// Empty where it is not there.
  std::string get(const std::string& attribute) const;
  /// The children of that name.
  std::vector<const XmlNode*> all(std::string_view child) const;
  /// The first of them. Throws where there is none.
  const XmlNode& one(std::string_view child) const;
};

/// Throws std::runtime_error for a text that is not well-formed.
XmlNode parse_xml(const std::string& text);

}  // namespace flexarm::testing_export
