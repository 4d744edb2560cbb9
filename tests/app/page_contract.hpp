#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace flexarm::testing_app {

/// A page of `--report` as its program reads it.
struct ReadPage {
  nlohmann::json document;
  std::string bytes;  ///< of all arrays

  /// The numbers of a reference or range; NaN for gaps. Throws std::out_of_range beyond the bytes.
  std::vector<double> numbers(const nlohmann::json& reference) const;
  /// The block of that id, of the headline or a section; null where there is none.
  nlohmann::json block(const std::string& id) const;
  /// The section of that id, likewise.
  nlohmann::json section(const std::string& id) const;
};

/// Takes the data out of the page's elements. Throws std::runtime_error where one is missing.
ReadPage read_page(const std::string& html);

/// Where the document is not one of report/page/web/src/contract.ts, a line a fault: types and
/// keys, ids, labels for choices, references within the bytes, lengths, ascending x. Beyond that:
/// no block without content, no identifier of a sensor, effect or formulation in a text.
std::vector<std::string> contract_faults(const ReadPage& page);

}  // namespace flexarm::testing_app
