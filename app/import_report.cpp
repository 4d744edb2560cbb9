#include "app/import_report.hpp"

#include "app/screen.hpp"
#include "arm/input_error.hpp"
#include "measured/files/controller_keys.hpp"
#include "report/json/json_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>
#include <variant>

namespace flexarm::app {

namespace {

report::Table column_table(const importing::ImportedFile& file) {
  report::Table table{"", {{"quantity"}, {"column"}, {"unit"}, {"scale"}}};
  const auto add = [&](const std::string& quantity, const measured::ColumnMapping& mapping) {
    table.add_row({quantity, mapping.expression.empty() ? mapping.name : "= " + mapping.expression,
                   mapping.unit, mapping.scale});
  };
  for (const auto& [quantity, mapping] : file.columns) add(quantity, mapping);
  if (file.reference) add(std::string(measured::kReferenceColumn), file.reference->mapping);
  return table;
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}", count, count == 1 ? what : what + "s");
}

/// "10000 samples, every 0.002 s, 4 sensors".
std::string size_of(const measured::RunData& data) {
  if (const auto* time = std::get_if<measured::TimeRecord>(&data)) {
    return fmt::format("{}, one every {:.6g} s, of {}", counted(time->time_s.size(), "sample"),
                       measured::sampling_period_s(*time),
                       counted(time->channels.size(), "sensor") + " and the torque");
  }
  if (const auto* frequency = std::get_if<measured::FrequencyRecord>(&data)) {
    std::vector<std::string> parts;
    for (const auto& channel : frequency->channels) {
      parts.push_back(fmt::format("{} at {} from {:g} to {:g} Hz", arm::to_string(channel.sensor),
                                  counted(channel.frequency_Hz.size(), "line"),
                                  channel.frequency_Hz.front(), channel.frequency_Hz.back()));
    }
    return fmt::format("{}", fmt::join(parts, "; "));
  }
  return counted(std::get<measured::ModalTable>(data).size(), "row");
}

std::string heading_of(const importing::ImportedFile& file) {
  return screen_paragraph(
      fmt::format("{}: {}, read as {}", arm::shown(file.file), file.format, to_string(file.kind)));
}

/// What is found below the heading of a file.
std::string import_text_of(const importing::ImportedFile& file) {
  std::string out;
  for (const auto& sentence : file.warnings) {
    out += toned(screen_paragraph("  warning: " + sentence, 4), "warning:", Tone::warning);
  }
  for (const auto& sentence : file.assumptions) out += screen_paragraph("  " + sentence, 4);
  if (!file.columns.empty()) {
    out += "\n" + screen_table(column_table(file));
  }
  if (!file.not_used.empty()) {
    out += screen_paragraph(
        arm::shown(fmt::format("not used: {}", fmt::join(file.not_used, ", ")), 2000), 4);
  }
  return out;
}

std::string import_text_of(const importing::ImportedRun& run) {
  std::string out = screen_paragraph(fmt::format("run {}: {}", run.run.id, size_of(run.data)), 4);
  if (run.run.controller) {
    const auto& reference = std::get<measured::TimeRecord>(run.data).reference;
    out += screen_paragraph(
        fmt::format("  closed loop: controller {}, reference in {}",
                    measured::format_controller(*run.run.controller), reference.unit),
        4);
  }
  for (const auto& note : run.notes) out += screen_paragraph("  " + note, 4);
  return out;
}

nlohmann::ordered_json text_or_null(std::string_view text) {
  return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

nlohmann::ordered_json import_json_of(const importing::ImportedFile& file) {
  nlohmann::ordered_json columns = nlohmann::ordered_json::array();
  const auto add = [&](std::string_view quantity, const measured::ColumnMapping& mapping) {
    columns.push_back({{"quantity", quantity},
                       {"name", text_or_null(mapping.name)},
                       {"expression", text_or_null(mapping.expression)},
                       {"unit", mapping.unit},
                       {"scale", mapping.scale}});
  };
  for (const auto& [quantity, mapping] : file.columns) add(quantity, mapping);
  if (file.reference) add(measured::kReferenceColumn, file.reference->mapping);
  return {{"file", file.file},
          {"format", file.format},
          {"kind", to_string(file.kind)},
          {"warnings", file.warnings},
          {"assumptions", file.assumptions},
          {"columns", columns},
          {"not_used", file.not_used}};
}

nlohmann::ordered_json import_json_of(const importing::ImportedRun& run) {
  const auto* record = std::get_if<measured::TimeRecord>(&run.data);
  nlohmann::ordered_json json = {
      {"id", run.run.id},
      {"source", run.source},
      {"kind", to_string(run.run.kind)},
      {"purpose", text_or_null(run.run.purpose ? to_string(*run.run.purpose) : "")},
      {"samples", nullptr},
      {"period_s", nullptr},
      {"from_s", nullptr},
      {"torque_hold", nullptr},
      {"initial", nullptr},
      {"controller", nullptr},
      {"reference_unit", nullptr},
      {"notes", run.notes}};
  if (record == nullptr) return json;
  json["samples"] = record->time_s.size();
  json["period_s"] = measured::sampling_period_s(*record);
  json["from_s"] = record->time_s.front();
  json["torque_hold"] = to_string(run.run.torque_hold);
  json["initial"] = to_string(run.run.initial);
  if (run.run.controller) json["controller"] = measured::format_controller(*run.run.controller);
  json["reference_unit"] = text_or_null(record->reference.unit);
  return json;
}

template <class Items>
nlohmann::ordered_json list_of(const Items& items) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& item : items) list.push_back(import_json_of(item));
  return list;
}

}  // namespace

std::string import_text(const std::vector<importing::ImportedFile>& files,
                        const std::vector<importing::ImportedRun>& runs) {
  std::string out;
  // Logs of one logger are read alike: what is said of the first is not said again.
  std::string said;
  for (const auto& file : files) {
    const std::string text = import_text_of(file);
    out += heading_of(file) + (text == said ? "  read as the file above\n" : text);
    said = text;
  }
  for (const auto& run : runs) out += import_text_of(run);
  return out;
}

std::string import_json(const std::vector<importing::ImportedFile>& files,
                        const std::vector<importing::ImportedRun>& runs) {
  return report::json_document("flexarm.import/2",
                               {{"files", list_of(files)}, {"runs", list_of(runs)}});
}

}  // namespace flexarm::app
