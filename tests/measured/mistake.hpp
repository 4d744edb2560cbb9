#pragma once

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <random>
#include <string>

namespace flexarm::measured {

/// A file that cannot be used, and the one line that says so.
struct Mistake {
  const char* name;
  std::string text;
  std::string error;  ///< after "FILE:"
};

inline void PrintTo(const Mistake& mistake, std::ostream* out) {
  *out << mistake.name;
}

/// For INSTANTIATE_TEST_SUITE_P.
inline constexpr auto name_of_mistake = [](const auto& info) {
  return std::string(info.param.name);
};

/// `parse(text, file)` refuses the mistake with its line.
template <class Parse>
void expect_line(const Mistake& mistake, const std::string& file, const Parse& parse) {
  try {
    parse(mistake.text, file);
    FAIL() << "accepted";
  } catch (const arm::InputError& error) {
    EXPECT_EQ(error.what(), file + ":" + mistake.error);
  }
}

/// `parse(text)` accepts or refuses with one line whatever a few bytes of `good` become.
template <class Parse>
void expect_result_or_one_line(const std::string& good, const Parse& parse) {
  std::mt19937_64 random(20261121);
  constexpr int kFiles = 20000;
  for (int i = 0; i < kFiles; ++i) {
    std::string text = good;
    for (auto changes = 1 + random() % 4; changes > 0; --changes) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    try {
      parse(text);
    } catch (const arm::InputError& error) {
      EXPECT_EQ(std::string(error.what()).find_first_of("\r\n"), std::string::npos);
    }
  }
}

}  // namespace flexarm::measured
