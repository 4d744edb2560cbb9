#include "measured/files/column_expression.hpp"

#include "arm/ascii.hpp"
#include "arm/decimal_comma.hpp"
#include "arm/formula_syntax.hpp"
#include "arm/input_error.hpp"
#include "arm/nearest_name.hpp"
#include "measured/files/column_lookup.hpp"
#include "measured/files/delimited_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <muParser.h>
#include <numbers>
#include <string_view>
#include <utility>

namespace flexarm::measured {

namespace {

using arm::InputError;
using std::string_view;

constexpr string_view kRate = "ddt";

/// A column, or its rate, in an expression.
struct ColumnReference {
  std::string column;  ///< as typed
  bool is_rate = false;

  bool operator==(const ColumnReference&) const = default;
};

/// An expression with its columns replaced by names that muParser takes.
struct Rewritten {
  std::string text;
  std::vector<ColumnReference> columns;  ///< one for each variable
  std::vector<std::size_t> origin;  ///< of each character of `text`, its place in the expression
};

std::string variable_name(std::size_t k) {
  return fmt::format("column_{}_", k);
}

mu::Parser new_parser() {
  mu::Parser parser;
  parser.DefineConst("pi", std::numbers::pi);
  return parser;
}

/// Letters, underscores, and all that is no ASCII, such as Greek.
bool begins_name(char c) {
  return arm::is_letter(c) || c == '_' || arm::is_beyond_ascii(c);
}

[[noreturn]] void refuse_expression(const std::string& expression, const std::string& why) {
  throw InputError(fmt::format("expression = {}: {}", arm::shown(expression, 200), why));
}

/// Replaces the columns of an expression by variables.
class Rewriter {
 public:
  explicit Rewriter(const std::string& expression) : all_(expression), parser_(new_parser()) {}

  Rewritten rewrite() {
    while (at_ < all_.size()) {
      const char c = all_[at_];
      if (c == '[') {
        read_quoted();
      } else if (begins_name(c)) {
        read_name();
      } else if (arm::begins_number(all_, at_)) {
        copy(arm::number_end(all_, at_));
      } else if (c == '=' || c == '<' || c == '>' || c == '!') {
        read_comparison();
      } else if (c == '"' || c == '\'' || c == ';') {
        refuse(
            "character {} = {}: not allowed; a column that is no plain name stands in "
            "brackets, as in [Output Voltage (V)]",
            at_ + 1, c);
      } else {
        copy(at_ + 1);
      }
    }
    return std::move(out_);
  }

 private:
  template <class... Values>
  [[noreturn]] void refuse(fmt::format_string<Values...> format, Values&&... values) {
    refuse_expression(all_, fmt::format(format, std::forward<Values>(values)...));
  }

  void copy(std::size_t end) {
    for (; at_ < end; ++at_) {
      out_.text += all_[at_];
      out_.origin.push_back(at_);
    }
  }

  void add_column(const ColumnReference& reference, std::size_t end) {
    auto found = std::ranges::find(out_.columns, reference);
    if (found == out_.columns.end()) found = out_.columns.insert(found, reference);
    const auto k = static_cast<std::size_t>(found - out_.columns.begin());
    for (const char c : variable_name(k)) {
      out_.text += c;
      out_.origin.push_back(at_);
    }
    at_ = end;
  }

  /// The column in the brackets that open at `at`, and the place behind them. A name may have
  /// brackets of its own: [Hub angle [rad]].
  std::pair<std::string, std::size_t> quoted_at(std::size_t at) {
    int depth = 0;
    std::size_t end = at;
    for (; end < all_.size(); ++end) {
      if (all_[end] == '[') ++depth;
      if (all_[end] == ']' && --depth == 0) break;
    }
    if (depth > 0) refuse("bracket [ at character {} is not closed", at + 1);
    const string_view name = trimmed(string_view(all_).substr(at + 1, end - at - 1));
    if (name.empty()) refuse("brackets at character {} are empty; they hold a column", at + 1);
    return {std::string(name), end + 1};
  }

  std::size_t name_end(std::size_t at) const {
    const auto is_of_name = [](char c) { return begins_name(c) || arm::is_digit(c) || c == '.'; };
    while (at < all_.size() && is_of_name(all_[at])) ++at;
    return at;
  }

  std::size_t behind_blanks(std::size_t at) const {
    while (at < all_.size() && is_blank(all_[at])) ++at;
    return at;
  }

  void read_quoted() {
    auto [name, end] = quoted_at(at_);
    add_column({std::move(name)}, end);
  }

  void read_name() {
    const std::size_t end = name_end(at_);
    const std::string name = all_.substr(at_, end - at_);
    const std::size_t next = behind_blanks(end);
    const bool is_called = next < all_.size() && all_[next] == '(';
    if (is_called && name == kRate) {
      read_rate(next + 1);
    } else if (is_called) {
      require_function(name);
      copy(end);
    } else if (parser_.GetConst().contains(name)) {
      copy(end);
    } else {
      add_column({name}, end);
    }
  }

  /// What stands in the parentheses of a rate is a column.
  void read_rate(std::size_t at) {
    at = behind_blanks(at);
    std::pair<std::string, std::size_t> column;
    if (at < all_.size() && all_[at] == '[') {
      column = quoted_at(at);
    } else {
      column = {all_.substr(at, name_end(at) - at), name_end(at)};
    }
    const std::size_t close = behind_blanks(column.second);
    if (column.first.empty() || close >= all_.size() || all_[close] != ')') {
      refuse("{0} at character {1} takes one column, as in {0}(theta) or {0}([#3])", kRate,
             at_ + 1);
    }
    add_column({std::move(column.first), true}, close + 1);
  }

  void require_function(const std::string& name) {
    std::vector<std::string> functions;
    for (const auto& entry : parser_.GetFunDef()) functions.push_back(entry.first);
    functions.emplace_back(kRate);
    if (std::ranges::count(functions, name) > 0) return;
    refuse(
        "{}: no function{}; functions are {}; a column that is no plain name stands in "
        "brackets, as in [{}(:,1)]",
        arm::shown(name), arm::did_you_mean(name, functions), fmt::join(functions, ", "),
        arm::shown(name));
  }

  /// == <= >= != < >; a single = would assign.
  void read_comparison() {
    const bool is_pair = at_ + 1 < all_.size() && all_[at_ + 1] == '=';
    if (all_[at_] == '=' && !is_pair) {
      refuse("= at character {}: an expression assigns nothing; equality is ==", at_ + 1);
    }
    copy(at_ + (is_pair ? 2 : 1));
  }

  const std::string& all_;
  mu::Parser parser_;
  std::size_t at_ = 0;
  Rewritten out_;
};

std::string reason_of(const mu::ParserError& error, const Rewritten& rewritten,
                      const std::string& expression) {
  // Errors of a token come with the place behind it or in front of it.
  const auto place = static_cast<std::size_t>(std::max(0, error.GetPos()));
  const auto begin = place < rewritten.origin.size() ? rewritten.origin[place] : expression.size();
  return arm::syntax_fault(error, "a column", expression, begin);
}

/// Compiles the expression over variables at `cells` and hands the parser to `use`.
template <class Use>
void with_parser(const std::string& expression, const Rewritten& rewritten,
                 std::vector<double>& cells, const Use& use) {
  try {
    mu::Parser parser = new_parser();
    for (std::size_t k = 0; k < cells.size(); ++k) parser.DefineVar(variable_name(k), &cells[k]);
    parser.SetExpr(rewritten.text);
    int results = 0;
    parser.Eval(results);
    if (results != 1) {
      refuse_expression(expression,
                        "has several values between commas" + arm::decimal_comma_hint(expression));
    }
    use(parser);
  } catch (const mu::ParserError& error) {
    refuse_expression(expression, reason_of(error, rewritten, expression));
  }
}

Rewritten read_expression(const std::string& expression) {
  Rewritten rewritten = Rewriter(expression).rewrite();
  std::vector<double> cells(rewritten.columns.size(), 1.0);
  with_parser(expression, rewritten, cells, [](const mu::Parser&) {});
  return rewritten;
}

/// The place of each of its variables.
std::vector<std::size_t> places_of(const std::string& expression, const Rewritten& rewritten,
                                   const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const auto& [typed, is_rate] : rewritten.columns) {
    const auto place = column_place(names, typed);
    if (!place) {
      refuse_expression(expression, unknown_column(names, typed).what());
    }
    const auto alike = std::ranges::count(names, typed);
    if (alike > 1) {
      refuse_expression(expression,
                        fmt::format("column {}: {} columns of the file have this name; take one by "
                                    "its number, as in [#{}]",
                                    arm::shown(typed), alike, *place + 1));
    }
    places.push_back(*place);
  }
  return places;
}

std::vector<double> rate_of(const std::vector<double>& values, std::span<const double> times_s) {
  std::vector<double> rate(values.size(), 0.0);
  if (values.size() < 2) return rate;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t before = k == 0 ? 0 : k - 1;
    const std::size_t after = std::min(k + 1, values.size() - 1);
    rate[k] = (values[after] - values[before]) / (times_s[after] - times_s[before]);
  }
  return rate;
}

}  // namespace

void require_expression(const std::string& expression) {
  read_expression(expression);
}

std::vector<std::size_t> columns_in(const std::string& expression,
                                    const std::vector<std::string>& names) {
  auto places = places_of(expression, read_expression(expression), names);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

std::vector<double> evaluate_expression(const std::string& expression, const ForeignTable& table,
                                        std::span<const double> times_s) {
  const std::vector<std::string> names = column_names(table.columns);
  const Rewritten rewritten = read_expression(expression);
  const auto places = places_of(expression, rewritten, names);
  std::vector<std::vector<double>> columns;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const ForeignColumn& column = table.columns[places[k]];
    if (column.is_text()) {
      refuse_expression(expression,
                        fmt::format("column {} = {}: not a number", arm::shown(column.name),
                                    arm::shown(column.texts.front())));
    }
    const bool is_rate = rewritten.columns[k].is_rate;
    if (is_rate && times_s.empty()) {
      refuse_expression(expression, fmt::format("{} needs times", kRate));
    }
    if ((is_rate && column.values.size() != times_s.size()) ||
        (!columns.empty() && columns.front().size() != column.values.size())) {
      refuse_expression(expression, "columns of different length");
    }
    columns.push_back(is_rate ? rate_of(column.values, times_s) : column.values);
  }
  std::size_t rows = times_s.size();
  if (rows == 0 && !table.columns.empty()) rows = table.columns.front().values.size();
  if (!columns.empty()) rows = columns.front().size();
  std::vector<double> cells(columns.size(), 1.0);
  std::vector<double> values;
  values.reserve(rows);
  with_parser(expression, rewritten, cells, [&](const mu::Parser& parser) {
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = columns[k][row];
      values.push_back(parser.Eval());
    }
  });
  return values;
}

}  // namespace flexarm::measured
