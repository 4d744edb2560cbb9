#include "report/json/paper_json.hpp"

#include "report/json/arm_json.hpp"
#include "report/json/json_document.hpp"

#include <nlohmann/json.hpp>

#include <optional>
#include <string_view>

namespace flexarm::report {

namespace {

using Json = nlohmann::ordered_json;
using namespace compare::paper;

Json comparison_json(const Comparison& row) {
  return {{"quantity", row.quantity},
          {"unit", row.unit},
          {"printed", number_json(row.printed)},
          {"corrected", row.corrected},
          {"exact_tf", number_json(row.formulations.exact_tf)},
          {"fem", number_json(row.formulations.fem)},
          {"assumed_modes", number_json(row.formulations.assumed_modes)},
          {"tolerance", row.tolerance},
          {"printed_agrees", row.printed ? Json(printed_agrees(row)) : Json(nullptr)},
          {"formulations_agree", formulations_agree(row)}};
}

/// The values of flexarm.paper/1.
std::string_view json_name(Verdict verdict) {
  switch (verdict) {
    case Verdict::slip_of_print:
      return "slip of print";
    case Verdict::slip_of_algebra:
      return "slip of algebra";
    case Verdict::does_not_follow:
      return "does not follow";
    default:
      return to_string(verdict);
  }
}

Json check_json(const Check& check) {
  Json comparisons = Json::array();
  for (const auto& row : check.comparisons) comparisons.push_back(comparison_json(row));
  return {{"part", check.label},
          {"statement", check.statement},
          {"verdict", json_name(check.verdict)},
          {"finding", check.finding},
          {"comparisons", std::move(comparisons)}};
}

}  // namespace

std::string paper_json(const Findings& findings) {
  Json topics = Json::array();
  for (const auto& topic : findings.topics) {
    Json checks = Json::array();
    for (const auto& check : topic.checks) checks.push_back(check_json(check));
    topics.push_back(
        {{"topic", topic.name}, {"title", topic.title}, {"checks", std::move(checks)}});
  }
  Json cells = Json::array();
  for (const auto& cell : findings.cells) {
    cells.push_back({{"table", cell.table},
                     {"cell", cell.cell},
                     {"unit", cell.unit},
                     {"printed", cell.printed.value},
                     {"recomputed", cell.recomputed},
                     {"follows", cell.follows}});
  }
  return json_document("flexarm.paper/1",
                       {{"topics", std::move(topics)}, {"cells", std::move(cells)}});
}

}  // namespace flexarm::report
