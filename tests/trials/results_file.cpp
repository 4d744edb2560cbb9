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
    "version,id,kind,arm,noise,strength,hidden,outside,error,outcome,verdict,named,claimed,right,"
    "class_size,parameters,recovered,covered,before,after,validation_after,validation_floor,time "
    "[s],processor "
    "[s],dirt,dirt_answer,port,ports,leading_named,wrong_names,error_over_floor,values,folder";
constexpr std::size_t kColumns = 33;

std::vector<std::string> parts_of(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  if (!text.empty() && text.back() == separator) parts.emplace_back();
  return parts;
}

std::vector<Claim> parse_claims(const std::string& claimed, const std::string& right) {
  const std::vector<std::string> probabilities = parts_of(claimed, '+');
  const std::vector<std::string> answers = parts_of(right, '+');
  if (answers.size() != probabilities.size()) throw std::runtime_error("claims do not match");
  std::vector<Claim> claims;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    claims.push_back({std::stod(probabilities[i]), answers[i] == "1"});
  }
  return claims;
}

/// Cells of another trial than a rig's.
constexpr std::string_view kNoRig = "-";

std::string cells_of_rig(const std::optional<RigScore>& rig) {
  if (!rig) return fmt::format("{0},{0},{0}", kNoRig);
  return fmt::format("{},{},{:.4g}", rig->leading_named, rig->wrong_names, rig->error_over_floor);
}

std::optional<RigScore> parse_rig(const std::string& leading_named, const std::string& wrong_names,
                                  const std::string& error_over_floor) {
  if (leading_named == kNoRig) return std::nullopt;
  return RigScore{std::stoi(leading_named), std::stoi(wrong_names), std::stod(error_over_floor)};
}

TrialResult parse_line(const std::string& line) {
  const std::vector<std::string> cells = parts_of(line, ',');
  if (cells.size() != kColumns) throw std::runtime_error("not a line of results: " + line);
  TrialResult result;
  std::size_t at = 0;
  const auto text = [&] { return cells[at++]; };
  const auto number = [&] { return std::stod(cells[at++]); };
  const auto whole = [&] { return std::stoi(cells[at++]); };
  result.version = text();
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
  const std::string claimed = text();
  result.claims = parse_claims(claimed, text());
  result.class_size = static_cast<std::size_t>(whole());
  result.parameters = whole();
  result.recovered = whole();
  result.covered = whole();
  result.before = number();
  result.after = number();
  result.validation_after = number();
  result.validation_floor = number();
  result.time_s = number();
  result.processor_s = number();
  result.dirt = text();
  result.dirt_answer = parse_dirt_answer(text());
  result.port_answer = parse_port_answer(text());
  result.ports = parts_of(text(), ';');
  const std::string leading_named = text();
  const std::string wrong_names = text();
  result.rig = parse_rig(leading_named, wrong_names, text());
  result.values = text();
  result.folder = text();
  return result;
}

}  // namespace

std::vector<TrialResult> read_results(const std::filesystem::path& file) {
  std::vector<TrialResult> results;
  std::ifstream stream(file);
  std::string line;
  if (std::getline(stream, line) && line != kHeader) {
    throw std::runtime_error(file.string() + ": results of another version of the trials");
  }
  while (std::getline(stream, line)) results.push_back(parse_line(line));
  return results;
}

void append_result(const TrialResult& result, const std::filesystem::path& file) {
  const bool is_new = !std::filesystem::exists(file);
  std::ofstream stream(file, std::ios::app);
  if (is_new) stream << kHeader << '\n';
  std::vector<std::string> claimed;
  std::vector<int> right;
  for (const Claim& claim : result.claims) {
    claimed.push_back(fmt::format("{:.4g}", claim.probability));
    right.push_back(claim.right ? 1 : 0);
  }
  stream << fmt::format("{},{},{},{},{},{},{},{:d},", result.version, result.id, result.kind,
                        result.arm, result.noise, result.strength, fmt::join(result.hidden, "+"),
                        result.outside)
         << fmt::format("{:.4g},{},{},{},{},{},", result.error, to_string(result.outcome),
                        result.verdict, fmt::join(result.named, "+"), fmt::join(claimed, "+"),
                        fmt::join(right, "+"))
         << fmt::format(
                "{},{},{},{},{:.4g},{:.4g},{:.4g},{:.4g},{:.2f},{:.2f},{},{},{},{},{},{},{}\n",
                result.class_size, result.parameters, result.recovered, result.covered,
                result.before, result.after, result.validation_after, result.validation_floor,
                result.time_s, result.processor_s, result.dirt, to_string(result.dirt_answer),
                to_string(result.port_answer), fmt::join(result.ports, ";"),
                cells_of_rig(result.rig), result.values, result.folder);
  if (!stream.flush()) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace flexarm::trials
