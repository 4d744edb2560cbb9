#include "tests/export/unpacked_fmu.hpp"

#include "measured/files/text_file.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <stdexcept>
#include <zip.h>

namespace flexarm::testing_export {

namespace fs = std::filesystem;

UnpackedFmu::UnpackedFmu(const std::string& bytes, const std::string& platform) {
  std::string name = (fs::temp_directory_path() / "flexarm fmu-XXXXXX").string();
  folder_ = ::mkdtemp(name.data());
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  zip_t* archive = zip_open_from_source(source, ZIP_RDONLY, &error);
  if (archive == nullptr) throw std::runtime_error(zip_error_strerror(&error));
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat);
    std::string content(stat.size, '\0');
    zip_file_t* file = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    zip_fread(file, content.data(), content.size());
    zip_fclose(file);
    const fs::path path = folder_ / stat.name;
    fs::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << content;
    names_.emplace_back(stat.name);
  }
  zip_close(archive);
  description_ = parse_xml(text_of("modelDescription.xml"));
  for (const XmlNode& variable : description_.one("ModelVariables").children) {
    references_[variable.get("name")] =
        static_cast<unsigned>(std::stoul(variable.get("valueReference")));
  }
  const std::string identifier = description_.one("CoSimulation").get("modelIdentifier");
  library_file_ = folder_ / "binaries" / platform / (identifier + ".so");
  library_ = ::dlopen(library_file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library_ == nullptr) throw std::runtime_error(::dlerror());
}

UnpackedFmu::~UnpackedFmu() {
  ::dlclose(library_);
  fs::remove_all(folder_);
}

std::string UnpackedFmu::text_of(const std::string& name) const {
  return measured::read_text_file(folder_ / name, 1 << 26);
}

std::string UnpackedFmu::resource_uri() const {
  std::string made = "file://";
  for (const char c : resources().string()) made += c == ' ' ? "%20" : std::string(1, c);
  return made;
}

bool UnpackedFmu::has_symbol(const char* name) const {
  return ::dlsym(library_, name) != nullptr;
}

void* UnpackedFmu::symbol(const char* name) const {
  void* const found = ::dlsym(library_, name);
  if (found == nullptr) throw std::runtime_error(::dlerror());
  return found;
}

}  // namespace flexarm::testing_export
