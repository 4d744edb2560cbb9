#include "measured/files/thousands_marks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace flexarm::measured {

namespace {

using std::string_view;

constexpr std::size_t kGroupDigits = 3;
constexpr string_view kDecimalDigits = "0123456789";

bool is_digits_alone(string_view digits) {
  return !digits.empty() && digits.find_first_not_of(kDecimalDigits) == string_view::npos;
}

string_view unsigned_cell(string_view cell) {
  constexpr string_view kMinusSign = "\xe2\x88\x92";
  if (cell.starts_with(kMinusSign)) return cell.substr(kMinusSign.size());
  return cell.starts_with('-') || cell.starts_with('+') ? cell.substr(1) : cell;
}

}  // namespace

void ThousandsMarks::add_row(std::span<const string_view> cells, int line) {
  if (has_decimals_) return;
  for (std::size_t i = 0; i < uses_.size() && i < cells.size(); ++i) {
    const string_view number = unsigned_cell(cells[i]);
    if (number.empty() || kDecimalDigits.find(number.front()) == string_view::npos) continue;
    Use& use = uses_[i];
    const auto mark = number.find(dialect_.decimal);
    if (mark == string_view::npos) {
      const bool is_short = is_digits_alone(number) && number.size() <= kGroupDigits;
      if (is_short) use.has_whole = true;
      if (!is_short && parse_cell(number, dialect_.decimal)) use.is_ungrouped = true;
      continue;
    }
    const string_view front = number.substr(0, mark);
    const string_view behind = number.substr(mark + 1);
    if (front.size() <= kGroupDigits && front.front() != '0' && is_digits_alone(front) &&
        behind.size() == kGroupDigits && is_digits_alone(behind)) {
      if (use.first.empty()) {
        use.first = cells[i];
        use.line = line;
      }
      use.ends_in_zero = use.ends_in_zero || behind.back() == '0';
    } else if (parse_cell(number, dialect_.decimal)) {
      has_decimals_ = true;
    }
  }
}

std::optional<DoubtfulMark> ThousandsMarks::doubtful() const {
  // Between commas no one writes points for thousands.
  if (has_decimals_ || dialect_ == Dialect{',', '.'}) return std::nullopt;
  const auto is_doubtful = [](const Use& use) { return !use.first.empty() && !use.is_ungrouped; };
  const auto is_sure = [&](const Use& use) {
    return is_doubtful(use) && use.has_whole && use.ends_in_zero;
  };
  auto found = std::ranges::find_if(uses_, is_sure);
  const bool is_certain = found != uses_.end();
  if (!is_certain) found = std::ranges::find_if(uses_, is_doubtful);
  if (found == uses_.end()) return std::nullopt;
  std::string thousands = found->first;
  std::erase(thousands, dialect_.decimal);
  return DoubtfulMark{
      static_cast<std::size_t>(found - uses_.begin()), found->line, found->first,
      is_certain ? "has thousands separators; write the number without them"
                 : fmt::format("may be {} with a thousands separator or a decimal; write {} or {}0 "
                               "(all such numbers of the column)",
                               thousands, thousands, found->first)};
}

}  // namespace flexarm::measured
