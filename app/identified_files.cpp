#include "app/identified_files.hpp"

#include "arm/atomic_file.hpp"
#include "measured/frequency_record.hpp"
#include "report/csv.hpp"
#include "report/identification_plots.hpp"
#include "report/identification_tables.hpp"
#include "report/identified_root_tables.hpp"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <string>

namespace flexarm::app {

namespace {

namespace fs = std::filesystem;

/// Readings of one method from the same runs in one table, by its name.
std::map<std::string, measured::ModalTable> modal_tables(
    const measured::Identification& identification,
    const std::vector<compare::IdentifiedCondition>& conditions) {
  std::map<std::string, measured::ModalTable> tables;
  for (const auto& condition : conditions) {
    for (std::size_t i = 0; i < condition.readings.size(); ++i) {
      const auto& reading = identification.readings[condition.readings[i]];
      if (reading.method == measured::Method::table) continue;
      auto& table = tables[fmt::format("modal-{}-{}.csv", to_string(reading.method),
                                       report::joined(reading.runs))];
      std::ranges::copy(compare::in_analytical_order(condition.roots[i]),
                        std::back_inserter(table));
    }
  }
  return tables;
}

}  // namespace

void write_identified_files(const fs::path& folder, const measured::Identification& identification,
                            const std::vector<compare::IdentifiedCondition>& conditions) {
  for (const auto& [name, table] : modal_tables(identification, conditions)) {
    measured::write_modal_table(table, folder / name);
  }
  for (const auto& run : identification.runs) {
    if (!run.estimate) continue;
    arm::write_atomically(folder / fmt::format("frf-{}.csv", run.run.id),
                          measured::format_frequency_record(run.response));
  }
  for (const auto& [name, svg] : report::identification_plots(identification, conditions)) {
    arm::write_atomically(folder / name, svg);
  }
  const auto write = [&](const std::string& name, const report::Table& table) {
    if (!table.rows.empty()) arm::write_atomically(folder / name, report::to_csv(table));
  };
  for (const auto& condition : conditions) {
    for (const auto& runs : report::sources(identification, condition)) {
      const report::IdentifiedData data{identification, condition, runs};
      write(fmt::format("poles-{}.csv", runs), report::pole_table(data));
      write(fmt::format("zeros-{}.csv", runs), report::zero_table(data));
      write(fmt::format("damping-{}.csv", runs), report::damping_table(data));
      write(fmt::format("real-zeros-{}.csv", runs), report::real_zero_table(data));
    }
    for (const std::size_t f : condition.fits) {
      const auto& fit = identification.fits[f];
      write(fmt::format("gains-{}.csv", report::joined(report::ids_of(fit, identification))),
            report::gain_table(fit, condition.analytical));
    }
  }
}

}  // namespace flexarm::app
