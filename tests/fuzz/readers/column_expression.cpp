#include "measured/files/column_expression.hpp"

#include "tests/fuzz/contract.hpp"
#include "tests/fuzz/reader.hpp"

#include <limits>
#include <string>
#include <vector>

namespace flexarm::fuzz {

namespace {

const measured::ForeignTable& log_table() {
  constexpr double kEmpty = std::numeric_limits<double>::quiet_NaN();
  static const measured::ForeignTable table{{{"time [s]", "s", {0.0, 0.1, 0.2, 0.3}},
                                             {"V", "V", {1.0, -2.0, kEmpty, 1e300}},
                                             {"Output Voltage (V)", "V", {0.0, 0.5, 1.0, 1.5}},
                                             {"comment", "", {}, {"a", "b", "c", "d"}}},
                                            {2, 3, 4, 5},
                                            {}};
  return table;
}

void read_column_expression(std::string_view bytes) {
  const std::string text(bytes);
  returns_or_refuses([&] { measured::require_expression(text); });
  returns_or_refuses([&] {
    const auto& table = log_table();
    const auto values = measured::evaluate_expression(text, table, table.columns[0].values);
    require(values.size() == table.line_of_row.size(), "not a value a row");
  });
}

}  // namespace

Reader column_expression() {
  return {"column_expression", read_column_expression};
}

}  // namespace flexarm::fuzz
