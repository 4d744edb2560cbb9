#include "measured/files/toml_node.hpp"

#include <gtest/gtest.h>

namespace flexarm::measured {
namespace {

TEST(NumberOf, RoundsWholeNumbersThatNoDoubleHas) {
  const auto table = toml::parse(
      "all_bits = 0x7fffffffffffffff\n"
      "least_without = 9007199254740993\n"
      "below = -9223372036854775807\n"
      "small = -3\n"
      "floating = 2.5\n");
  EXPECT_EQ(number_of(*table.get("all_bits")), 0x1p63);
  EXPECT_EQ(number_of(*table.get("least_without")), 0x1p53);
  EXPECT_EQ(number_of(*table.get("below")), -0x1p63);
  EXPECT_EQ(number_of(*table.get("small")), -3.0);
  EXPECT_EQ(number_of(*table.get("floating")), 2.5);
}

TEST(NumberOf, HasNoneForWhatIsNoNumber) {
  const auto table = toml::parse("text = \"1\"\nflag = true\nlist = [1]\n");
  for (const char* key : {"text", "flag", "list"}) {
    EXPECT_FALSE(number_of(*table.get(key))) << key;
  }
}

}  // namespace
}  // namespace flexarm::measured
