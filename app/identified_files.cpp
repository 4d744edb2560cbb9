#include "app/identified_files.hpp"

#include "arm/atomic_file.hpp"
#include "measured/frequency_record.hpp"
#include "report/csv.hpp"
#include "report/identification_plots.hpp"
#include "report/identification_tables.hpp"
#include "report/identified_root_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 100;

/// A name without what a file's name may not have, or not well.
std::string file_name(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  std::string made = name.substr(0, std::min(dot, kLongestName)) + name.substr(dot);
  for (char& c : made) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       std::string_view("-_.+@").find(c) != std::string_view::npos;
    if (!plain) c = '_';
  }
  return made;
}

/// The name, or with -2, -3, ... before its ending.
std::string unused(const std::string& name, const std::vector<arm::NamedContent>& files) {
  std::string made = name;
  for (int i = 2; std::ranges::find(files, made, &arm::NamedContent::name) != files.end(); ++i) {
    const std::size_t dot = name.rfind('.');
    made = fmt::format("{}-{}{}", name.substr(0, dot), i, name.substr(dot));
  }
  return made;
}

/// Readings of one method from the same runs and condition, each in a table with its name.
std::vector<std::pair<std::string, measured::ModalTable>> modal_tables(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::vector<std::pair<std::string, measured::ModalTable>> tables;
  for (const auto& condition : conditions) {
    std::map<std::string, measured::ModalTable> own;
    for (std::size_t i = 0; i < condition.readings.size(); ++i) {
      const auto& reading = identification.readings[condition.readings[i]];
      if (reading.method == measured::Method::table) continue;
      auto& table = own[fmt::format("modal-{}-{}.csv", to_string(reading.method),
                                    report::joined(reading.runs))];
      std::ranges::copy(compare::in_analytical_order(condition.roots[i]),
                        std::back_inserter(table));
    }
    std::ranges::move(own, std::back_inserter(tables));
  }
  return tables;
}

}  // namespace

FolderKind identified_folder_kind() {
  return {"an identification", kIdentifiedJson, {".csv", ".svg", ".json"}};
}

std::vector<arm::NamedContent> identified_files(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::vector<arm::NamedContent> files;
  const auto add = [&](const std::string& name, std::string content) {
    files.push_back({unused(file_name(name), files), std::move(content)});
  };
  for (const auto& [name, table] : modal_tables(identification, conditions)) {
    add(name, measured::format_modal_table(table));
  }
  for (const auto& run : identification.runs) {
    if (!run.estimate) continue;
    add(fmt::format("frf-{}.csv", run.run.id), measured::format_frequency_record(run.response));
  }
  for (auto& [name, svg] : report::identification_plots(identification, conditions)) {
    add(name, std::move(svg));
  }
  const auto add_table = [&](const std::string& name, const report::Table& table) {
    if (!table.rows.empty()) add(name, report::to_csv(table));
  };
  for (const auto& condition : conditions) {
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      add_table(fmt::format("poles-{}.csv", runs), report::pole_table(data));
      add_table(fmt::format("zeros-{}.csv", runs), report::zero_table(data));
      add_table(fmt::format("damping-{}.csv", runs), report::damping_table(data));
      add_table(fmt::format("real-zeros-{}.csv", runs), report::real_zero_table(data));
    }
    for (const std::size_t f : condition.fits) {
      const auto& fit = identification.fits[f];
      add_table(fmt::format("gains-{}.csv", report::joined(report::ids_of(fit, identification))),
                report::gain_table(fit, condition.analytical));
    }
  }
  return files;
}

}  // namespace flexarm::app
