#include "measured/csv.hpp"

#include "arm/input_error.hpp"

#include <algorithm>
#include <cstddef>

namespace flexarm::measured {

namespace {

constexpr std::string_view kBlank = " \t";

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(kBlank);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlank) - begin + 1);
}

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file_name)
      : text_(text), file_name_(file_name) {
    constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
    if (text_.starts_with(kByteOrderMark)) text_.remove_prefix(kByteOrderMark.size());
  }

  std::vector<CsvRow> rows() {
    std::vector<CsvRow> rows;
    while (at_ < text_.size()) {
      const std::string_view rest = trimmed(text_.substr(at_, end_of_line() - at_));
      if (rest.empty() || rest.starts_with('#')) {
        at_ = end_of_line();
        pass_line_end();
      } else {
        rows.push_back(row());
      }
    }
    return rows;
  }

 private:
  CsvRow row() {
    CsvRow row{line_, {}};
    while (true) {
      row.cells.push_back(cell());
      if (at_ < text_.size() && text_[at_] == ',') {
        ++at_;
      } else {
        pass_line_end();
        return row;
      }
    }
  }

  std::string cell() {
    at_ = std::min(text_.find_first_not_of(kBlank, at_), text_.size());
    if (at_ < text_.size() && text_[at_] == '"') return quoted();
    const auto end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
    const std::string_view content = trimmed(text_.substr(at_, end - at_));
    at_ = end;
    return std::string(content);
  }

  std::string quoted() {
    const int begin_line = line_;
    std::string content;
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '"') {
        ++at_;
        const bool is_doubled = at_ < text_.size() && text_[at_] == '"';
        if (!is_doubled) return end_of_quoted(content);
      } else if (text_[at_] == '\n') {
        ++line_;
      }
      content += text_[at_];
    }
    throw fault(begin_line, "a quote is not closed; end the cell with \"");
  }

  std::string end_of_quoted(const std::string& content) {
    at_ = std::min(text_.find_first_not_of(kBlank, at_), text_.size());
    if (at_ < text_.size() &&
        std::string_view(",\r\n").find(text_[at_]) == std::string_view::npos) {
      throw fault(line_, "text after a closing quote; write a quote within quotes twice, as \"\"");
    }
    return content;
  }

  std::size_t end_of_line() const {
    return std::min(text_.find_first_of("\r\n", at_), text_.size());
  }

  void pass_line_end() {
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  arm::InputError fault(int line, const std::string& what) const {
    return arm::located(arm::InputError(what), file_name_, line);
  }

  std::string_view text_;
  std::string file_name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace

std::vector<CsvRow> parse_csv(std::string_view text, const std::string& file_name) {
  return Scanner(text, file_name).rows();
}

}  // namespace flexarm::measured
