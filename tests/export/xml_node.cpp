#include "tests/export/xml_node.hpp"

#include <expat.h>
#include <memory>
#include <stdexcept>

namespace flexarm::testing_export {

std::string XmlNode::get(const std::string& attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? "" : found->second;
}

std::vector<const XmlNode*> XmlNode::all(std::string_view child) const {
  std::vector<const XmlNode*> made;
  for (const XmlNode& node : children) {
    if (node.name == child) made.push_back(&node);
  }
  return made;
}

const XmlNode& XmlNode::one(std::string_view child) const {
  const auto found = all(child);
  if (found.empty()) throw std::runtime_error(name + " has no " + std::string(child));
  return *found.front();
}

XmlNode parse_xml(const std::string& text) {
  XmlNode document;
  std::vector<XmlNode*> open = {&document};
  const std::unique_ptr<XML_ParserStruct, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                       XML_ParserFree);
  XML_SetUserData(parser.get(), &open);
  XML_SetElementHandler(
      parser.get(),
      [](void* data, const XML_Char* name, const XML_Char** attributes) {
        auto& nodes = *static_cast<std::vector<XmlNode*>*>(data);
        XmlNode& made = nodes.back()->children.emplace_back(XmlNode{name});
        for (; *attributes != nullptr; attributes += 2) {
          made.attributes[attributes[0]] = attributes[1];
        }
        nodes.push_back(&made);
      },
      [](void* data, const XML_Char*) { static_cast<std::vector<XmlNode*>*>(data)->pop_back(); });
  if (XML_Parse(parser.get(), text.data(), static_cast<int>(text.size()), XML_TRUE) !=
      XML_STATUS_OK) {
    throw std::runtime_error(XML_ErrorString(XML_GetErrorCode(parser.get())));
  }
  return document.children.at(0);
}

}  // namespace flexarm::testing_export
