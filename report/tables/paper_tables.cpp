#include "report/tables/paper_tables.hpp"

#include "report/tables/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace flexarm::report {

namespace {

using namespace compare::paper;

struct CountedVerdict {
  Verdict verdict;
  const char* several;
};
constexpr std::array kVerdicts = {CountedVerdict{Verdict::holds, "hold"},
                                  CountedVerdict{Verdict::harmless_misprint, "harmless misprints"},
                                  CountedVerdict{Verdict::slip_of_print, "misprints"},
                                  CountedVerdict{Verdict::slip_of_algebra, "algebra errors"},
                                  CountedVerdict{Verdict::does_not_follow, "not reproducible"}};

Cell value_cell(const std::optional<double>& value, const Comparison& row) {
  if (!value) return {};
  const bool zero = std::abs(row.corrected) <= row.tolerance && std::abs(*value) <= row.tolerance;
  return zero ? 0.0 : *value;
}

std::string with_unit(const Comparison& row) {
  return row.unit == "1" ? row.quantity : fmt::format("{} [{}]", row.quantity, row.unit);
}

/// Numbers in a text, in order.
std::vector<int> numbers_in(const std::string& s) {
  std::vector<int> numbers;
  for (const char* p = s.data(); p < s.data() + s.size();) {
    int number = 0;
    const auto [rest, error] = std::from_chars(p, s.data() + s.size(), number);
    if (error == std::errc{} && std::isdigit(static_cast<unsigned char>(*p))) {
      numbers.push_back(number);
      p = rest;
    } else {
      ++p;
    }
  }
  return numbers;
}

std::string lower(std::string s) {
  std::transform(s.begin(), s.end(), s.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return s;
}

/// Words filled into lines of at most `width`, each behind `indent` blanks.
std::string filled(const std::string& words, std::size_t width, std::size_t indent) {
  const std::string margin(indent, ' ');
  std::string out, line;
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    const std::string word = words.substr(at, end - at);
    if (!line.empty() && margin.size() + line.size() + 1 + word.size() > width) {
      out += margin + line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
    at = end + 1;
  }
  return line.empty() ? out : out + margin + line + '\n';
}

std::string indented(const std::string& lines, std::size_t indent) {
  std::string out;
  bool at_start = true;
  for (const char c : lines) {
    if (at_start && c != '\n') out += std::string(indent, ' ');
    out += c;
    at_start = c == '\n';
  }
  return out;
}

constexpr std::size_t kWidth = 100;
constexpr std::size_t kIndent = 4;
constexpr std::size_t kValuesWidth = 110;  // the longest quantity beside five numbers

std::string check_text(const Check& check) {
  std::string out = filled(
      fmt::format("{} {}: {}.", check.label, check.statement, to_string(check.verdict)), kWidth, 0);
  out += filled(check.finding, kWidth, kIndent);
  if (!check.comparisons.empty()) {
    out += indented(to_text(paper_values(check), {.max_width = kValuesWidth}), kIndent);
  }
  return out + '\n';
}

}  // namespace

Table paper_values(const Check& check) {
  Table table{.caption = "",
              .columns = {{.name = "quantity"},
                          {.name = "printed"},
                          {.name = "corrected"},
                          {.name = "exact_tf"},
                          {.name = "fem"},
                          {.name = "assumed_modes"}}};
  for (const auto& row : check.comparisons) {
    const auto& from = row.formulations;
    table.add_row({with_unit(row), value_cell(row.printed, row), value_cell(row.corrected, row),
                   value_cell(from.exact_tf, row), value_cell(from.fem, row),
                   value_cell(from.assumed_modes, row)});
  }
  return table;
}

Table paper_overview(const Findings& findings) {
  Table table{.caption = "",
              .columns = {{.name = "part"}, {.name = "verdict"}, {.name = "statement"}}};
  for (const auto& topic : findings.topics) {
    for (const auto& check : topic.checks) {
      constexpr std::size_t kLongest = 55;
      std::string says = check.statement;
      if (says.size() > kLongest) says = says.substr(0, kLongest - 3) + "...";
      table.add_row({check.label, std::string(to_string(check.verdict)), says});
    }
  }
  return table;
}

Table paper_cells(const Findings& findings) {
  Table table{.caption = "",
              .columns = {{.name = "table"},
                          {.name = "cell"},
                          {.name = "unit"},
                          {.name = "printed"},
                          {.name = "recomputed"}}};
  for (const auto& cell : findings.cells) {
    if (cell.follows) continue;
    const int decimals = cell.printed.decimals;
    table.add_row({std::int64_t{cell.table}, cell.cell, cell.unit,
                   fmt::format("{:.{}f}", cell.printed.value, decimals),
                   fmt::format("{:.{}f}", cell.recomputed, decimals)});
  }
  return table;
}

Table paper_listing(const Findings& findings) {
  Table table{.caption = "",
              .columns = {{.name = "part"},
                          {.name = "verdict"},
                          {.name = "quantity"},
                          {.name = "unit"},
                          {.name = "printed"},
                          {.name = "corrected"},
                          {.name = "exact_tf"},
                          {.name = "fem"},
                          {.name = "assumed_modes"},
                          {.name = "tolerance"}}};
  const auto cell = [](const std::optional<double>& value) {
    return value ? Cell{*value} : Cell{};
  };
  for (const auto& topic : findings.topics) {
    for (const auto& check : topic.checks) {
      for (const auto& row : check.comparisons) {
        const auto& from = row.formulations;
        table.add_row({check.label, std::string(to_string(check.verdict)), row.quantity, row.unit,
                       cell(row.printed), row.corrected, cell(from.exact_tf), cell(from.fem),
                       cell(from.assumed_modes), row.tolerance});
      }
    }
  }
  return table;
}

std::string paper_cells_line(const Findings& findings) {
  const auto wrong = std::count_if(findings.cells.begin(), findings.cells.end(),
                                   [](const CellCheck& cell) { return !cell.follows; });
  return fmt::format(
      "{} of the {} errors and averages in Tables 2-5 are inconsistent with the cells they are "
      "computed from.",
      wrong, findings.cells.size());
}

std::string paper_verdict_line(const Findings& findings) {
  int checks = 0;
  std::string counts;
  for (const auto& [verdict, several] : kVerdicts) {
    int count = 0;
    for (const auto& topic : findings.topics) {
      for (const auto& check : topic.checks) count += check.verdict == verdict ? 1 : 0;
    }
    checks += count;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, several);
  }
  return fmt::format("{} checks: {}.", checks, counts);
}

bool names_part(const std::string& label, const std::string& part) {
  const bool number = !part.empty() && std::all_of(part.begin(), part.end(), [](unsigned char c) {
    return std::isdigit(c) != 0;
  });
  if (!number) return lower(label).find(lower(part)) != std::string::npos;
  if (label.front() != '(') return false;
  const int wanted = numbers_in(part).front();
  const auto numbers = numbers_in(label);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (numbers[i] == wanted) return true;
    const bool range =
        i + 1 < numbers.size() &&
        label.find(fmt::format("({})-({})", numbers[i], numbers[i + 1])) != std::string::npos;
    if (range && numbers[i] < wanted && wanted < numbers[i + 1]) return true;
  }
  return false;
}

std::string paper_text(const Findings& findings, const std::string& part) {
  std::string out = filled(describe_arms(), kWidth, 0) + '\n';
  const std::size_t nothing = out.size();
  for (const auto& topic : findings.topics) {
    std::string checks;
    for (const auto& check : topic.checks) {
      if (names_part(check.label, part)) checks += check_text(check);
    }
    if (!checks.empty()) {
      out += fmt::format("{}\n{:=<{}}\n\n", topic.title, "", topic.title.size()) + checks;
    }
  }
  if (!part.empty()) return out.size() == nothing ? "" : out;
  out += filled(paper_cells_line(findings), kWidth, 0);
  out += to_text(paper_cells(findings), {.max_width = kWidth}) + '\n';
  return out + to_text(paper_overview(findings), {.max_width = kWidth}) +
         paper_verdict_line(findings) + '\n';
}

}  // namespace flexarm::report
