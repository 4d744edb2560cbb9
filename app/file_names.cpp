#include "app/file_names.hpp"

#include "arm/ascii.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace flexarm::app {

namespace {

constexpr std::size_t kLongestName = 100;

/// A name without what a file's name may not have, or not well.
std::string file_name(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string made = name.substr(0, std::min(dot, kLongestName)) + name.substr(dot);
  for (char& c : made) {
    const bool plain = arm::is_letter(c) || arm::is_digit(c) ||
                       std::string_view("-_.+@").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return made;
}

/// The name, or with -2, -3, ... before its ending.
std::string unused(const std::string& name, const std::vector<measured::NamedContent>& files) {
  std::string made = name;
  for (int i = 2; std::ranges::find(files, made, &measured::NamedContent::name) != files.end();
       ++i) {
    const std::size_t dot = name.rfind('.');
    made = fmt::format("{}-{}{}", name.substr(0, dot), i, name.substr(dot));
  }
  return made;
}

}  // namespace

void add_file(const std::string& name, std::string content,
              std::vector<measured::NamedContent>& files) {
  files.push_back({unused(file_name(name), files), std::move(content)});
}

}  // namespace flexarm::app
