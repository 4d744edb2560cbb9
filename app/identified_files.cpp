#include "app/identified_files.hpp"

#include "app/file_names.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/frequency_record.hpp"
#include "report/figures/identification_plots.hpp"
#include "report/tables/csv.hpp"
#include "report/tables/identification_tables.hpp"
#include "report/tables/identified_root_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace flexarm::app {

namespace {

/// Readings of one method from the same runs and condition, each in a table with its name.
std::vector<std::pair<std::string, measured::ModalTable>> modal_tables(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::vector<std::pair<std::string, measured::ModalTable>> tables;
  for (const auto& condition : conditions) {
    std::map<std::string, measured::ModalTable> own;
    for (std::size_t i = 0; i < condition.readings.size(); ++i) {
      const auto& reading = identification.readings[condition.readings[i]];
      // Of several sensors' peaks a zero of the hub angle would stand in the table several times.
      const bool is_repeated = reading.hub_held && reading.method != measured::Method::rational_fit;
      if (reading.method == measured::Method::table || is_repeated) continue;
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
  return {
      "an identification", {kIdentifiedJson}, {".csv", ".svg", ".pdf", ".png", ".json", ".html"}};
}

std::vector<measured::NamedContent> identified_files(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions,
    const report::FigureOptions& options) {
  std::vector<measured::NamedContent> files;
  const auto add = [&](const std::string& name, std::string content) {
    add_file(name, std::move(content), files);
  };
  for (const auto& [name, table] : modal_tables(identification, conditions)) {
    add(name, measured::format_modal_table(table));
  }
  for (const auto& run : identification.runs) {
    if (!run.estimate) continue;
    add(fmt::format("frf-{}.csv", run.run.id), measured::format_frequency_record(run.response));
  }
  const auto figures = report::identification_plots(identification, conditions);
  for (auto& [name, content] : report::figure_files(figures, options)) {
    add(name, std::move(content));
  }
  const auto add_table = [&](const std::string& name, const report::Table& table) {
    if (!table.rows.empty()) add(name, report::to_csv(table));
  };
  for (const auto& condition : conditions) {
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      add_table(fmt::format("poles-{}.csv", runs), report::pole_table(data));
      add_table(fmt::format("zeros-{}.csv", runs), report::zero_table(data));
      add_table(fmt::format("held-poles-{}.csv", runs), report::held_pole_table(data));
      add_table(fmt::format("damping-{}.csv", runs), report::damping_table(data));
      add_table(fmt::format("real-zeros-{}.csv", runs), report::real_zero_table(data));
    }
    for (const std::size_t f : condition.fits) {
      const auto& fit = identification.fits[f];
      add_table(fmt::format("gains-{}.csv", report::joined(report::ids_of(fit, identification))),
                report::gain_table(fit, condition));
    }
  }
  return files;
}

}  // namespace flexarm::app
