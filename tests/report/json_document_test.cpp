#include "report/json/json_document.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <stdexcept>

namespace flexarm::report {
namespace {

using nlohmann::ordered_json;

TEST(JsonDocument, SchemaComesFirstAndMembersKeepTheirOrder) {
  EXPECT_EQ(json_document("flexarm.compare/1", {{"verdict", "agree"}, {"arm", "a"}}),
            "{\n  \"schema\": \"flexarm.compare/1\",\n  \"verdict\": \"agree\",\n"
            "  \"arm\": \"a\"\n}\n");
  EXPECT_EQ(json_document("s/1", ordered_json::object()), "{\n  \"schema\": \"s/1\"\n}\n");
}

TEST(JsonDocument, DoublesRoundTripAndWhatIsNotFiniteIsNull) {
  const double value = std::nextafter(11.8618, 12.0);
  const auto read = ordered_json::parse(
      json_document("s/1", {{"x", value}, {"nan", std::nan("")}, {"inf", HUGE_VAL}}));
  EXPECT_EQ(read.at("x").get<double>(), value);
  EXPECT_TRUE(read.at("nan").is_null());
  EXPECT_TRUE(read.at("inf").is_null());
}

TEST(JsonDocument, ContentThatIsNoObjectOrHasASchemaIsRefused) {
  EXPECT_THROW(json_document("s/1", ordered_json::array()), std::invalid_argument);
  EXPECT_THROW(json_document("s/1", {{"schema", "t/1"}}), std::invalid_argument);
}

}  // namespace
}  // namespace flexarm::report
