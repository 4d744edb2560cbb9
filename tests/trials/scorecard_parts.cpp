#include "tests/trials/scorecard_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

namespace flexarm::trials {

Results chosen(const Results& results, const Choice& choice) {
  Results some;
  std::ranges::copy_if(results, std::back_inserter(some), choice);
  return some;
}

int count(const Results& results, const Choice& choice) {
  return static_cast<int>(std::ranges::count_if(results, choice));
}

int count(const Results& results, Outcome outcome) {
  return count(results, [&](const TrialResult& one) { return one.outcome == outcome; });
}

bool is_found(const TrialResult& one) {
  return one.outcome == Outcome::exact || one.outcome == Outcome::in_class;
}

/// "12/14 (86 %)".
std::string part(int some, int all) {
  if (all == 0) return "-";
  return fmt::format("{}/{} ({:.0f} %)", some, all, 100.0 * some / all);
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::string row(const std::string& name, const std::vector<std::string>& cells) {
  return fmt::format("| {} | {} |\n", name, fmt::join(cells, " | "));
}

std::string header(const std::string& name, const std::vector<std::string>& cells) {
  std::string text = row(name, cells) + "| --- |";
  for (std::size_t i = 0; i < cells.size(); ++i) text += " ---: |";
  return text + "\n";
}

bool has_effects(const TrialResult& one, std::size_t effects) {
  return one.hidden.size() == effects && !one.outside;
}

}  // namespace flexarm::trials
