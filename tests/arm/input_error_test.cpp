#include "arm/input_error.hpp"

#include "arm/utf8.hpp"

#include <gtest/gtest.h>

#include <string>

namespace flexarm::arm {
namespace {

TEST(Shown, ControlCharactersAndStrayBytesAreEscaped) {
  EXPECT_EQ(shown("plain 1.5 \"m\""), "plain 1.5 \"m\"");
  EXPECT_EQ(shown("a\nb\tc\x7f"), "a\\x0ab\\x09c\\x7f");
  EXPECT_EQ(shown("\xc2\x9b"
                  "2J\xc2\xa0"),
            "\\xc2\\x9b"
            "2J\xc2\xa0");  // a terminal's CSI
  EXPECT_EQ(shown("μ 梁 \xe9"), "μ 梁 \\xe9");
  EXPECT_EQ(shown(std::string(100, 'x'), 5), "xxxxx...");
  EXPECT_EQ(shown("xxxxx", 5), "xxxxx");
}

TEST(Utf8, FormsThatTheStandardForbidsAreRefused) {
  EXPECT_TRUE(is_utf8("a \xc3\xa9 \xe6\xa2\x81 \xf0\x9f\xa6\xbe \xf4\x8f\xbf\xbf"));
  for (const char* bad :
       {"\x80", "\xc0\xaf", "\xc1\x81", "\xe0\x80\x80", "\xed\xa0\x80", "\xf0\x80\x80\x80",
        "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xe6\xa2", "\xc3(", "\xff"}) {
    EXPECT_FALSE(is_utf8(bad)) << shown(bad);
  }
}

TEST(InputErrorLocated, TheKeyGoesAlong) {
  const InputError error = out_of_range("beam.length", -1.0, "m", "a finite number above 0");
  const InputError there = located(error, "rig.toml", 3);
  EXPECT_STREQ(there.what(), "rig.toml:3: beam.length = -1 m: must be a finite number above 0");
  EXPECT_EQ(there.key(), "beam.length");
  EXPECT_STREQ(located(error, "rig.toml", 0).what(),
               "rig.toml: beam.length = -1 m: must be a finite number above 0");
}

}  // namespace
}  // namespace flexarm::arm
