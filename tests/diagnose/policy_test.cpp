#include "diagnose/search/policy.hpp"

#include "arm/input_error.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <string_view>

namespace flexarm::diagnose {
namespace {

// At most twenty numbers decide what a search does.
TEST(Policy, HasTwentyNumbersOfDifferentNames) {
  std::set<std::string_view> names;
  for (const PolicyNumber& one : policy_numbers()) names.insert(one.name);
  EXPECT_EQ(names.size(), policy_numbers().size());
  EXPECT_LE(names.size(), 20U);
  // Each is 8 bytes: a member without a name would add 8.
  EXPECT_EQ(sizeof(Policy), 8 * names.size());
}

TEST(Policy, SetsEachNumberByItsName) {
  for (const PolicyNumber& one : policy_numbers()) {
    Policy policy;
    set_number(policy, std::string(one.name) + "=7");
    for (const PolicyNumber& other : policy_numbers()) {
      const double expected = other.name == one.name ? 7.0 : other.of(Policy{});
      EXPECT_EQ(other.of(policy), expected) << one.name << ' ' << other.name;
    }
  }
}

std::string refusal(const std::string& text) {
  Policy policy;
  try {
    set_number(policy, text);
  } catch (const arm::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Policy, RefusesWhatIsNoNumberOfIt) {
  EXPECT_EQ(refusal("baem=3"),
            "baem: unknown number of the search (did you mean beam?); docs/search-numbers.md lists "
            "them");
  EXPECT_EQ(refusal("beam"), "beam: must be NAME=NUMBER");
  EXPECT_EQ(refusal("beam=three"), "beam=three: must be NAME=NUMBER");
  EXPECT_EQ(refusal("beam=2.5"), "beam = 2.5: must be a whole number from 1 to 1e6");
  EXPECT_EQ(refusal("near=0"), "near = 0: must be a finite number above 0");
  EXPECT_EQ(refusal("near=nan"), "near = nan: must be a finite number above 0");
}

}  // namespace
}  // namespace flexarm::diagnose
