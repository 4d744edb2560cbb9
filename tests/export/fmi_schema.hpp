#pragma once

#include "export/fmu/model_description.hpp"

#include <map>
#include <string>
#include <vector>

namespace flexarm::testing_export {

/// Of attributes: the schema's simple types, or "a|b" for an enumeration.
struct AttributeRule {
  std::string type;
  bool is_required = false;
};

struct ChildRule {
  std::string name;
  int least = 0;
  int most = 1;
};

/// Of an element: its attributes, and its children in this order.
struct ElementRule {
  std::map<std::string, AttributeRule> attributes;
  std::vector<ChildRule> children = {};
  bool holds_anything = false;
};

/// By the names of elements.
using Schema = std::map<std::string, ElementRule>;

/// Of modelDescription.xml, as far as a co-simulation FMU of real variables has it.
Schema schema_of(fmu::FmiVersion version);
/// Of buildDescription.xml.
Schema build_schema();

}  // namespace flexarm::testing_export
