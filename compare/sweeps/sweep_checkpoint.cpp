#include "compare/sweeps/sweep_checkpoint.hpp"

#include "arm/input_error.hpp"
#include "measured/files/arm_file.hpp"
#include "measured/files/atomic_file.hpp"
#include "measured/files/text_file.hpp"
#include "response/settings.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

namespace flexarm::compare {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSchema = "flexarm.sweep-checkpoint/1";
constexpr std::size_t kLargestFile_bytes = std::size_t{1} << 32;

/// FNV-1a, 64 bits: against damage, not against malice.
std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3U;
  }
  return hash;
}

/// Numbers one after the other.
class Writer {
 public:
  void put(double value) {
    std::array<char, sizeof(double)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(double));
    bytes_.append(bytes.data(), bytes.size());
  }
  void put(std::complex<double> value) {
    put(value.real());
    put(value.imag());
  }
  void put_count(std::size_t count) { put(static_cast<double>(count)); }
  template <class T>
  void put(const std::vector<T>& values) {
    put_count(values.size());
    for (const auto& value : values) put(value);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

struct Damaged : std::exception {};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  void get(double& value) {
    if (bytes_.size() < sizeof(double)) throw Damaged();
    std::memcpy(&value, bytes_.data(), sizeof(double));
    bytes_.remove_prefix(sizeof(double));
  }
  void get(std::complex<double>& value) {
    double re = 0.0;
    double im = 0.0;
    get(re);
    get(im);
    value = {re, im};
  }
  std::size_t get_count() {
    double count = 0.0;
    get(count);
    // Nothing that is counted here takes less than one number.
    if (!(count >= 0.0 && count <= kMostGridPoints)) throw Damaged();
    return static_cast<std::size_t>(count);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(get_count());
    for (auto& value : values) get(value);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  std::string_view bytes_;
};

/// The members of a point in the order of the file, for reading and for writing.
template <class Point, class Visit>
void for_each_member(Point& point, Visit visit) {
  visit(point.omega_rad_per_s);
  visit(point.hub_slope);
  visit(point.tip_value_m);
  visit(point.damped_poles_rad_per_s);
  visit(point.zeros_rad_per_s);
}

std::vector<StoredPoint> parse_points(std::string_view bytes) {
  Reader reader(bytes);
  std::vector<StoredPoint> stored;
  while (!reader.at_end()) {
    StoredPoint& entry = stored.emplace_back();
    entry.model = reader.get_count();
    entry.point = reader.get_count();
    for_each_member(entry.values, [&reader](auto& member) { reader.get(member); });
  }
  return stored;
}

/// The first lines in which two texts differ.
std::pair<std::string, std::string> first_difference(std::string_view a, std::string_view b) {
  while (true) {
    const auto line_a = a.substr(0, a.find('\n'));
    const auto line_b = b.substr(0, b.find('\n'));
    const bool ends = line_a.size() == a.size() || line_b.size() == b.size();
    if (line_a != line_b || ends) return {std::string(line_a), std::string(line_b)};
    a.remove_prefix(line_a.size() + 1);
    b.remove_prefix(line_b.size() + 1);
  }
}

void require_same(const std::string& file, const Json& header,
                  const std::vector<FingerprintLine>& fingerprint) {
  const Json& there = header.at("fingerprint");
  for (const auto& [name, value] : fingerprint) {
    const auto other = there.value(name, std::string());
    if (other == value) continue;
    const auto [line_there, line_here] = first_difference(other, value);
    throw arm::InputError(fmt::format("{}: checkpoint of another sweep: {} is \"{}\", not \"{}\"",
                                      file, name, arm::shown(line_there, 120),
                                      arm::shown(line_here, 120)));
  }
}

}  // namespace

std::vector<FingerprintLine> fingerprint(const SweepTask& task, const std::string& version) {
  std::string grid;
  for (const SweepAxis& axis : task.axes) {
    grid += (grid.empty() ? "" : " ") + axis.typed;
  }
  std::string models;
  for (const Model& model : task.models) {
    models +=
        (models.empty() ? "" : "; ") + response::formulation_label(model.name, model.settings);
  }
  std::string questions = fmt::format("{} poles, {} zeros{}", task.questions.poles,
                                      task.questions.zeros, task.questions.modes ? ", modes" : "");
  for (const auto& sensor : task.questions.sensors) questions += ", " + arm::to_string(sensor);
  return {{"grid", grid},
          {"models", models},
          {"questions", questions},
          {"arm", measured::format_arm(task.arm)},
          {"version", version}};
}

void write_checkpoint(const std::filesystem::path& path,
                      const std::vector<FingerprintLine>& fingerprint,
                      const std::vector<CheckpointEntry>& entries) {
  Writer writer;
  for (const auto& [model, point, values] : entries) {
    writer.put_count(model);
    writer.put_count(point);
    for_each_member(*values, [&writer](const auto& member) { writer.put(member); });
  }
  Json header = {{"schema", kSchema}, {"fingerprint", Json::object()}};
  for (const auto& [name, value] : fingerprint) header["fingerprint"][name] = value;
  header["checksum"] = checksum(writer.bytes());
  measured::write_atomically(path, header.dump() + "\n" + writer.bytes());
}

std::vector<StoredPoint> read_checkpoint(const std::filesystem::path& path,
                                         const std::vector<FingerprintLine>& fingerprint) {
  const std::string file = arm::shown(path.string());
  if (!std::filesystem::exists(path)) {
    throw arm::InputError(fmt::format("{}: no checkpoint found; start without --resume", file));
  }
  const std::string content = measured::read_text_file(path, kLargestFile_bytes);
  try {
    const auto line_end = content.find('\n');
    if (line_end == std::string::npos) throw Damaged();
    const Json header = Json::parse(content.substr(0, line_end));
    if (header.at("schema") != kSchema) throw Damaged();
    require_same(file, header, fingerprint);
    const auto bytes = std::string_view(content).substr(line_end + 1);
    if (header.at("checksum") != checksum(bytes)) throw Damaged();
    return parse_points(bytes);
  } catch (const Json::exception&) {
  } catch (const Damaged&) {
  }
  throw arm::InputError(
      fmt::format("{}: not a valid sweep checkpoint; delete it and start without --resume", file));
}

}  // namespace flexarm::compare
