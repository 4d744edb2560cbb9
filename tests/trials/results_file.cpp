#include "tests/trials/results_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

namespace flexarm::trials {

namespace {

constexpr std::string_view kHeader =
    "id,kind,arm,noise,strength,hidden,outside,error,outcome,verdict,named,class_size,parameters,"
    "recovered,covered,before,after,validation_after,validation_floor,time [s],values,folder";
constexpr std::size_t kColumns = 22;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (!text.empty() && text.back() == separator) parts.emplace_back();
  return parts;
}

TrialResult parse_line(const std::string& line) {
  const std::vector<std::string> cells = parts_of(line, ',');
  if (cells.size() != kColumns) throw std::runtime_error("not a line of results: " + line);
  TrialResult result;
  std::size_t at = 0;
  const auto text = [&] { return cells[at++]; };
  const auto number = [&] { return std::stod(cells[at++]); };
  const auto whole = [&] { return std::stoi(cells[at++]); };
  result.id = text();
  result.kind = text();
  result.arm = text();
  result.noise = number();
  result.strength = text();
  result.hidden = parts_of(text(), '+');
  result.outside = whole() != 0;
  result.error = number();
  result.outcome = parse_outcome(text());
  result.verdict = text();
  result.named = parts_of(text(), '+');
  result.class_size = static_cast<std::size_t>(whole());
  result.parameters = whole();
  result.recovered = whole();
  result.covered = whole();
  result.before = number();
  result.after = number();
  result.validation_after = number();
  result.validation_floor = number();
  result.time_s = number();
  result.values = text();
  result.folder = text();
  return result;
}

}  // namespace

std::vector<TrialResult> read_results(const std::filesystem::path& file) {
  std::vector<TrialResult> results;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);  // the header
  while (std::getline(stream, line)) results.push_back(parse_line(line));
  return results;
}

void append_result(const TrialResult& result, const std::filesystem::path& file) {
  const bool is_new = !std::filesystem::exists(file);
  std::ofstream stream(file, std::ios::app);
  if (is_new) stream << kHeader << '\n';
  stream << fmt::format("{},{},{},{},{},{},{:d},{:.4g},{},{},{},", result.id, result.kind,
                        result.arm, result.noise, result.strength, fmt::join(result.hidden, "+"),
                        result.outside, result.error, to_string(result.outcome), result.verdict,
                        fmt::join(result.named, "+"))
         << fmt::format("{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.2f},{},{}\n", result.class_size,
                        result.parameters, result.recovered, result.covered, result.before,
                        result.after, result.validation_after, result.validation_floor,
                        result.time_s, result.values, result.folder);
  if (!stream.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace flexarm::trials
