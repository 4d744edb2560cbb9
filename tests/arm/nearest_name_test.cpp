#include "arm/nearest_name.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace flexarm::arm {
namespace {

const std::vector<std::string> kNames = {"length", "width", "thickness", "density"};

TEST(NearestName, OneSlipOfAKeyIsForgiven) {
  EXPECT_EQ(nearest_name("lenght", kNames), "length");       // two letters swapped
  EXPECT_EQ(nearest_name("widht", kNames), "width");         // two letters swapped
  EXPECT_EQ(nearest_name("thicknes", kNames), "thickness");  // one left out
  EXPECT_EQ(nearest_name("densitty", kNames), "density");    // one too many
  EXPECT_EQ(nearest_name("Width", kNames), "width");         // one other
  EXPECT_EQ(did_you_mean("lenght", kNames), " (did you mean length?)");
}

TEST(NearestName, OneWordOfANameIsEnoughWhereItIsTheOnly) {
  const std::vector<std::string> names = {"coulomb_friction", "stribeck_friction", "time_delay"};
  EXPECT_EQ(nearest_name("coulomb", names), "coulomb_friction");
  EXPECT_EQ(nearest_name("delay", names), "time_delay");
  EXPECT_EQ(nearest_name("friction", names), std::nullopt);  // of two
  EXPECT_EQ(nearest_name("coul", names), std::nullopt);
}

TEST(NearestName, AWordThatIsFarFromAllIsNotGuessed) {
  EXPECT_EQ(nearest_name("mass", kNames), std::nullopt);
  EXPECT_EQ(nearest_name("", kNames), std::nullopt);
  EXPECT_EQ(did_you_mean("mass", kNames), "");
}

TEST(NearestName, LongInputCostsNothing) {
  // A table of edit distances for this word would not fit into memory.
  constexpr std::size_t kLong = std::size_t{1} << 28;
  EXPECT_EQ(nearest_name(std::string(kLong, 'x'), kNames), std::nullopt);
}

TEST(NearestName, LongNamesOfAFileCostNothing) {
  const std::vector<std::string> names(100, std::string(100000, 'x'));
  EXPECT_EQ(nearest_name(std::string(100000, 'y'), names), std::nullopt);
}

TEST(NearestName, ANameOfAFileIsShownWithoutControlCharacters) {
  const std::vector<std::string> names = {"angle\n"};
  EXPECT_EQ(did_you_mean("angle", names), " (did you mean angle\\x0a?)");
}

}  // namespace
}  // namespace flexarm::arm
