#include "measured/files/file_kind.hpp"

#include "measured/files/foreign_table.hpp"
#include "measured/files/json_table.hpp"
#include "measured/files/mat_file.hpp"
#include "measured/files/mat_levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace flexarm::measured {

namespace {

using std::string_view;

/// A format of other programs that no command reads, by its first bytes.
struct ForeignSignature {
  string_view bytes;
  string_view is;
  string_view way;
};

constexpr string_view kSaveAsText =
    "export it as CSV with a line of names and units, then  flexarm import FILE.csv";
constexpr std::array<ForeignSignature, 20> kSignatures = {{
    {"TDSm", "is a TDMS file (LabVIEW)",
     "save it as .lvm, CSV or MAT, or in Python: "
     "nptdms.TdmsFile.read('FILE.tdms').as_dataframe(time_index=True).to_csv('FILE.csv')"},
    {"TDSh", "is the index of a TDMS file (LabVIEW)",
     "save the .tdms file beside it as .lvm, CSV or MAT"},
    {"\xd0\xcf\x11\xe0", "is an Excel file (.xls)", "save the sheet as CSV"},
    {"\x93NUMPY", "is a NumPy array (.npy)",
     "write it with numpy.savetxt('FILE.csv', a, delimiter=',', header='time [s],...', "
     "comments='')"},
    {"PAR1", "is a Parquet file", "in Python: pandas.read_parquet('FILE').to_csv('FILE.csv')"},
    {"ARROW1", "is an Arrow or Feather file",
     "in Python: pandas.read_feather('FILE').to_csv('FILE.csv')"},
    {"MDF     ", "is an MDF file (ASAM)", "export it as CSV or MAT"},
    {"UnFinMF", "is an MDF file (ASAM) that was not finished", "finish it, and export it as CSV"},
    {"#ROSBAG", "is a ROS bag", "export its topics as CSV, with rostopic echo -b FILE -p TOPIC"},
    {"\x89MCAP0", "is an MCAP file (ROS)", "export its topics as CSV"},
    {"SQLite format 3", "is a SQLite database, such as a ROS 2 bag", kSaveAsText},
    {"\x1f\x8b", "is compressed with gzip", "expand it with gunzip"},
    {"BZh", "is compressed with bzip2", "expand it with bunzip2"},
    {"7z\xbc\xaf", "is a 7z archive", "expand it"},
    {"%PDF", "is a PDF document", "the numbers behind it are needed, as CSV"},
    {"\x89PNG", "is a picture (PNG)", "the numbers behind it are needed, as CSV"},
    {"\xff\xd8\xff", "is a picture (JPEG)", "the numbers behind it are needed, as CSV"},
    {"\x80\x04\x95", "is a Python pickle",
     "write the numbers as CSV, with to_csv or numpy.savetxt"},
    {"\x80\x05\x95", "is a Python pickle",
     "write the numbers as CSV, with to_csv or numpy.savetxt"},
    {"\x7f"
     "ELF",
     "is a program", "a file of numbers is due"},
}};

/// A ZIP archive by the names of the files in it.
RecognisedFile archive(string_view bytes) {
  const auto holds = [&](string_view name) { return bytes.find(name) != string_view::npos; };
  const auto other = [](string_view is, string_view way) {
    return RecognisedFile{FileKind::other, std::string(is), std::string(way)};
  };
  if (holds("modelDescription.xml")) {
    return other("is an FMU", "flexarm export writes it, a simulation program takes it");
  }
  if (holds("xl/workbook")) return other("is an Excel file (.xlsx)", "save the sheet as CSV");
  if (holds("opendocument.spreadsheet")) {
    return other("is a spreadsheet (.ods)", "save the sheet as CSV");
  }
  if (holds(".npy")) {
    return other("is a NumPy archive (.npz)",
                 "write its arrays as the columns of a CSV file, with numpy.savetxt");
  }
  if (holds("simulink/") || holds("metadata/coreProperties.xml")) {
    return other("is a Simulink model", "simulate it, and save its signals as MAT or CSV");
  }
  return other("is a ZIP archive", "expand it");
}

RecognisedFile as_log(string_view is) {
  return {FileKind::log, std::string(is),
          "flexarm import FILE --out FOLDER makes a measurement of it"};
}

/// The keys and headers of a TOML document, one that is not quite TOML, too.
std::set<std::string, std::less<>> toml_words(string_view text) {
  std::set<std::string, std::less<>> words;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n'), text.size());
    string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    if (line.starts_with('[')) {
      words.emplace(line.substr(0, line.find_first_of(" \t\r.]") == string_view::npos
                                       ? line.size()
                                       : line.find_first_of(" \t\r.]")));
    } else if (const auto equals = line.find('='); equals != string_view::npos && equals > 0) {
      const auto last = line.find_last_not_of(" \t", equals - 1);
      words.emplace(line.substr(0, std::min(last + 1, line.find('.'))));
    }
  }
  return words;
}

std::optional<RecognisedFile> toml_file(string_view text) {
  const auto words = toml_words(text);
  const auto has = [&](std::initializer_list<string_view> any) {
    return std::ranges::any_of(any, [&](string_view word) { return words.contains(word); });
  };
  if (has({"[[run"})) {
    if (has({"file"}) || has({"arm"})) {
      return RecognisedFile{FileKind::measurement, "is a measurement",
                            "flexarm diagnose and flexarm identify take it"};
    }
    return RecognisedFile{FileKind::plan, "is a measurement plan",
                          "flexarm plan ARM PLAN takes it"};
  }
  if (has({"[beam", "[hub", "beam", "hub"})) {
    return RecognisedFile{FileKind::arm, "is an arm file",
                          "flexarm modes, compare, response and simulate take it"};
  }
  if (has({"kind"}) && has({"[sweep", "[diagnose", "[plan", "[bootstrap", "[trials"})) {
    return RecognisedFile{FileKind::campaign, "is a campaign", "flexarm-campaign takes it"};
  }
  if (has({"sensor", "sensors"}) && has({"kp", "kd", "ki", "A"})) {
    return RecognisedFile{FileKind::controller, "is a controller",
                          "the option --controller takes it"};
  }
  return std::nullopt;
}

/// Any JSON that is no log, one that is cut off or at odds with itself among them.
constexpr string_view kJsonWithoutLists = "is JSON without lists of numbers";

/// A result of a command, by its schema.
std::optional<RecognisedFile> json_file(string_view bytes) {
  constexpr string_view kSchema = "\"schema\"";
  const auto at = bytes.find(kSchema);
  const auto begin = at == string_view::npos ? at : bytes.find('"', at + kSchema.size());
  const auto end = begin == string_view::npos ? begin : bytes.find('"', begin + 1);
  if (end != string_view::npos) {
    const string_view schema = bytes.substr(begin + 1, end - begin - 1);
    if (schema.starts_with("flexarm.diagnosis/")) {
      return RecognisedFile{FileKind::result, "is the JSON of flexarm diagnose",
                            "flexarm export takes it; the other commands take the extended arm "
                            "beside it, or the measurement"};
    }
    if (schema.starts_with("flexarm.")) {
      return RecognisedFile{FileKind::result,
                            fmt::format("is JSON of flexarm ({})", arm::shown(schema)),
                            "no command reads it; give the file that the command was given"};
    }
  }
  try {
    parse_json_table(bytes, "");
    return as_log("is a log as JSON");
  } catch (const arm::InputError&) {
    return RecognisedFile{FileKind::other, std::string(kJsonWithoutLists),
                          "a log has a list of objects, one a sample"};
  }
}

std::optional<RecognisedFile> table_file(string_view bytes) {
  const string_view first_line = bytes.substr(0, bytes.find_first_of("\r\n"));
  const auto has = [&](string_view word) { return first_line.find(word) != string_view::npos; };
  if (has("sensor") && has("feature") && has("frequency")) {
    return RecognisedFile{FileKind::modal_table, "is a modal table",
                          "flexarm compare ARM --measured takes it, flexarm import makes a "
                          "measurement of it"};
  }
  if (has("sensor") && has("re") && has("im") && has("frequency")) {
    return RecognisedFile{FileKind::frequency_record, "is a frequency record",
                          "flexarm compare ARM --measured takes it, flexarm import makes a "
                          "measurement of it"};
  }
  try {
    if (parse_foreign_table(bytes, "").columns.empty()) return std::nullopt;
  } catch (const arm::InputError&) {
    return std::nullopt;
  }
  if (has("time [") && has("torque [")) {
    return RecognisedFile{FileKind::time_record, "is a time record",
                          "a run of a measurement.toml names it, and flexarm import FILE --out "
                          "FOLDER makes one of it"};
  }
  return as_log("is a table of numbers, as a log has");
}

}  // namespace

std::optional<RecognisedFile> recognise_file(string_view bytes) {
  for (const auto& signature : kSignatures) {
    if (bytes.starts_with(signature.bytes)) {
      return RecognisedFile{FileKind::other, std::string(signature.is), std::string(signature.way)};
    }
  }
  if (bytes.starts_with("PK\x03\x04")) return archive(bytes);
  if (is_mat_file(bytes)) return as_log("is a MATLAB file");
  if (is_hdf5(bytes)) {
    return RecognisedFile{
        FileKind::other, "is an HDF5 file, but not MATLAB's",
        "write its data sets as the columns of a CSV file, or with MATLAB's save -v7.3"};
  }
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == string_view::npos) return std::nullopt;
  const string_view text = bytes.substr(first);
  if (text.substr(0, text.find_first_of("\r\n")) == "-1") return as_log("is a universal file");
  if (text.starts_with("<svg") || text.starts_with("<?xml")) {
    return RecognisedFile{FileKind::other, "is XML, such as a picture (SVG)",
                          "the numbers behind it are needed, as CSV"};
  }
  if (text.starts_with("<!DOCTYPE html") || text.starts_with("<!doctype html") ||
      text.starts_with("<html")) {
    return RecognisedFile{FileKind::other, "is a page (HTML), such as a report",
                          "open it in a browser"};
  }
  if (is_json(text)) return json_file(text);
  if (auto toml = toml_file(text)) return toml;
  return table_file(bytes);
}

std::string requirement(FileKind due) {
  switch (due) {
    case FileKind::arm:
      return "must be an arm file (flexarm new rig.toml writes one)";
    case FileKind::measurement:
      return "must be a measurement (measurement.toml)";
    case FileKind::plan:
      return "must be a measurement plan (measurement-plan.toml)";
    case FileKind::controller:
      return "must be a controller (TOML with sensor, kp, kd, ki)";
    case FileKind::time_record:
      return "must be a time record (CSV with time [s] and torque [N m])";
    case FileKind::frequency_record:
      return "must be a frequency record (CSV)";
    case FileKind::modal_table:
      return "must be a modal table (CSV with sensor, feature and frequency [Hz])";
    default:
      return "must be a log: delimited text, a universal file, MATLAB or JSON";
  }
}

arm::InputError wrong_file(string_view bytes, const std::string& file_name, FileKind due,
                           const arm::InputError& error, const std::string& required) {
  const auto file = recognise_file(bytes);
  const string_view first_line = bytes.substr(0, bytes.find_first_of("\r\n"));
  const bool is_of_frequencies =
      (due == FileKind::frequency_record || due == FileKind::modal_table) &&
      (first_line.find("sensor") != string_view::npos ||
       first_line.find("freq") != string_view::npos);
  const bool is_due = !file || file->kind == due ||
                      // A table that may have been meant as one: the reader's own words say more.
                      (file->kind == FileKind::log && file->is.starts_with("is a table") &&
                       (due == FileKind::time_record || is_of_frequencies)) ||
                      (due == FileKind::log && file->is == kJsonWithoutLists) ||
                      (due == FileKind::log && (file->kind == FileKind::time_record ||
                                                file->kind == FileKind::frequency_record ||
                                                file->kind == FileKind::modal_table));
  if (is_due) return error;
  std::string way = file->way;
  constexpr string_view kFile = " FILE ";
  if (const auto at = way.find(kFile); at != std::string::npos) {
    way.replace(at + 1, kFile.size() - 2, file_name);
  }
  return arm::InputError(fmt::format("{}: {}; {}; {}", file_name, file->is,
                                     required.empty() ? requirement(due) : required, way));
}

}  // namespace flexarm::measured
