#include "measured/files/toml_depth.hpp"

#include "arm/input_error.hpp"
#include "measured/files/toml_document.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace flexarm::measured {
namespace {

std::string repeated(const std::string& text, std::size_t times) {
  std::string out;
  for (std::size_t i = 0; i < times; ++i) out += text;
  return out;
}

std::string refusal(const std::string& toml) {
  try {
    parse_toml(toml, "f.toml");
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

constexpr const char* kTooDeep =
    "f.toml:2: keys within keys of more than 256 levels; at most 256 are read";

TEST(TomlDepth, AKeyOfManyLevelsIsRefusedWithItsLine) {
  // As many overflowed the stack when the document was freed.
  constexpr std::size_t kLevels = 40000;
  EXPECT_EQ(refusal("# head\n" + repeated("a.", kLevels) + "a = 1\n"), kTooDeep);
  EXPECT_EQ(refusal("# head\n[" + repeated("a.", kLevels) + "a]\n"), kTooDeep);
  EXPECT_EQ(refusal("# head\n[[" + repeated("a . ", kLevels) + "a]]\n"), kTooDeep);
  EXPECT_EQ(refusal("# head\nx = " + repeated("[", kLevels)), kTooDeep);
  EXPECT_EQ(refusal("# head\n" + repeated("a = { 'b' . \"c\" = ", kLevels)), kTooDeep);
}

TEST(TomlDepth, LevelsOfHeadersKeysAndTablesAdd) {
  const std::string header = "[" + repeated("a.", 99) + "a]\n";
  const std::string key = repeated("b.", 99) + "b = ";
  EXPECT_EQ(refusal(header + key + "{ " + repeated("c.", 40) + "c = 1 }\n"), "");
  EXPECT_EQ(refusal(header + key + "{ " + repeated("c.", 80) + "c = 1 }\n"), kTooDeep);
}

TEST(TomlDepth, WhatStandsBesideOrInTextsAndCommentsIsNotCounted) {
  EXPECT_EQ(refusal("x = [\n" + repeated("  1.5, # a.b.c.d\n", 1000) + "]\n"), "");
  EXPECT_EQ(refusal("x = [" + repeated("{ a.b.c = [1.0] }, ", 1000) + "]\n"), "");
  const std::string points(1000, '.');
  for (const char* quote : {"\"", "'", "\"\"\"", "'''"}) {
    EXPECT_EQ(refusal(fmt::format("x = {0}{1}{0}\n", quote, points)), "") << quote;
  }
  EXPECT_EQ(refusal("x = \"\\\"" + points + "\"\n"), "");
  EXPECT_EQ(refusal("x = \"\"\"\n" + points + "\\\n\n[[[[ \" \"\"\"\n"), "");
  EXPECT_EQ(refusal("# " + points + "\n"), "");
  std::string headers;
  for (int i = 0; i < 1000; ++i) headers += fmt::format("[a{0}.b]\nc.d = 1\n", i);
  EXPECT_EQ(refusal(headers), "");
  // A bracket that is left open is an error of another kind.
  EXPECT_TRUE(refusal("x = [\n" + repeated("y = 1.5\n", 1000)).starts_with("f.toml:2: not TOML"));
}

TEST(TomlDepth, TheLineIsThatOfTheFileAlsoBehindLongTexts) {
  EXPECT_EQ(line_too_deep("x = '''\n\n'''\n# c\n" + repeated("a.", 300) + "a = 1"), 5);
  EXPECT_EQ(line_too_deep("x = \"\"\"\\\n \\\\\n\"\"\"\n" + repeated("a.", 300) + "a = 1"), 4);
  EXPECT_EQ(line_too_deep("x = \"not closed\n" + repeated("a.", 300) + "a = 1"), 2);
}

}  // namespace
}  // namespace flexarm::measured
