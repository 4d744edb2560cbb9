#include "report/tables/csv.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <sstream>
#include <string>

namespace flexarm::report {
namespace {

TEST(Csv, HeaderCarriesUnitsAndMissingCellsAreEmpty) {
  Table table{"not written", {{"sensor"}, {"frequency", "Hz"}, {"order"}}};
  table.add_row({"hub_angle", 11.5, 1});
  table.add_row({"strain@0.05", std::numeric_limits<double>::quiet_NaN(), std::monostate{}});
  EXPECT_EQ(to_csv(table), "sensor,frequency [Hz],order\nhub_angle,11.5,1\nstrain@0.05,,\n");
}

TEST(Csv, CommasQuotesAndLineEndsAreQuoted) {
  Table table{"", {{"a, b"}, {"c"}}};
  table.add_row({"say \"hub\"", "two\nlines"});
  table.add_row({"plain ", "λ"});
  EXPECT_EQ(to_csv(table), "\"a, b\",c\n\"say \"\"hub\"\"\",\"two\nlines\"\nplain ,λ\n");
}

TEST(Csv, EveryDoubleReadsBackToTheSameBits) {
  std::mt19937_64 random(20240514);
  std::vector<double> values{0.0, -0.0, 0.1, 5e-324, std::numeric_limits<double>::max(), 1.0 / 3.0};
  while (values.size() < 2000) {
    const double value = std::bit_cast<double>(random());
    if (std::isfinite(value)) values.push_back(value);
  }
  Table table{"", {{"x"}}};
  for (const double value : values) table.add_row({value});

  std::istringstream csv(to_csv(table));
  std::string line;
  std::getline(csv, line);
  for (const double value : values) {
    ASSERT_TRUE(std::getline(csv, line));
    double read = 0.0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), read);
    ASSERT_EQ(error, std::errc{}) << line;
    ASSERT_EQ(end, line.data() + line.size()) << line;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << line;
  }
}

}  // namespace
}  // namespace flexarm::report
