#pragma once

#include "tests/export/xml_node.hpp"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace flexarm::testing_export {

/// An FMU's files in a folder of its own, with a blank in its name, removed afterwards; and its
/// library, loaded as an importer loads it.
class UnpackedFmu {
 public:
  /// `archive` are the bytes of the file; `platform` the folder below binaries/.
  UnpackedFmu(const std::string& archive, const std::string& platform);
  ~UnpackedFmu();
  UnpackedFmu(const UnpackedFmu&) = delete;
  UnpackedFmu& operator=(const UnpackedFmu&) = delete;

  const XmlNode& description() const { return description_; }
  std::string text_of(const std::string& name) const;
  /// Names of the files in the archive, in its order.
  const std::vector<std::string>& names() const { return names_; }

  std::filesystem::path resources() const { return folder_ / "resources"; }
  /// file:///tmp/flexarm%20fmu...
  std::string resource_uri() const;
  std::filesystem::path library() const { return library_file_; }

  /// A function of the library, of that type.
  template <class Function>
  Function* function(const char* name) const {
    return reinterpret_cast<Function*>(symbol(name));
  }
  /// Whether the library has that function.
  bool has_symbol(const char* name) const;

  /// The value reference of a variable, by its name.
  unsigned reference(const std::string& variable) const { return references_.at(variable); }

 private:
  void* symbol(const char* name) const;

  std::filesystem::path folder_;
  std::filesystem::path library_file_;
  std::vector<std::string> names_;
  XmlNode description_;
  std::map<std::string, unsigned> references_;
  void* library_ = nullptr;
};

}  // namespace flexarm::testing_export
