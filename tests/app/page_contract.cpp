#include "tests/app/page_contract.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <stdexcept>

namespace flexarm::testing_app {
namespace {

using Json = nlohmann::json;

std::string element(const std::string& html, const std::string& id) {
  const std::size_t at = html.find("id=\"" + id + "\">");
  if (at == std::string::npos) throw std::runtime_error("no element " + id);
  const std::size_t begin = html.find('>', at) + 1;
  return html.substr(begin, html.find("</script>", begin) - begin);
}

std::string from_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> value{};
  value.fill(-1);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    value[static_cast<unsigned char>(digits[i])] = static_cast<int>(i);
  }
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    const int digit = value[static_cast<unsigned char>(c)];
    if (digit < 0) throw std::runtime_error("no base64");
    bits = bits << 6U | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes += static_cast<char>(bits >> count & 0xffU);
    }
  }
  return bytes;
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t offset) {
  if (offset + sizeof(Number) > bytes.size()) throw std::out_of_range("array beyond the bytes");
  Number number;
  std::memcpy(&number, bytes.data() + offset, sizeof(Number));
  return number;
}

const std::set<std::string> kRoles = {
    "measured",  "before", "after",  "residual_before", "residual_after", "bound", "noise",
    "coherence", "first",  "second", "third",           "fourth",         "fifth", "sixth"};

/// Identifiers that a reader should see in words.
const std::regex kIdentifier(
    "(^|[^A-Za-z0-9_./])(hub_angle|hub_velocity|tip_acceleration|tip_deflection|tip_displacement|"
    "strain@|exact_tf|assumed_modes|coulomb_friction|time_delay|hub_inertia|payload_mass|"
    "root_compliance|partly_explained)($|[^A-Za-z0-9_/])");

class Checker {
 public:
  explicit Checker(const ReadPage& page) : page_(page) {}

  std::vector<std::string> faults() {
    const Json& d = page_.document;
    keys(d, "document",
         {"schema", "program", "command", "title", "date", "verdict", "results", "facts",
          "next_step", "sections"},
         {"headline"});
    if (!faults_.empty()) return faults_;
    require(d["schema"] == "flexarm.page/1", "schema");
    for (const char* key : {"program", "command", "title"}) text(d[key], key, false);
    keys(d["verdict"], "verdict", {"status", "word", "sentence"});
    one_of(d["verdict"]["status"], {"good", "partial", "bad", "neutral"}, "verdict.status");
    text(d["verdict"]["word"], "verdict.word");
    text(d["verdict"]["sentence"], "verdict.sentence");
    facts(d["results"], "results");
    facts(d["facts"], "facts");
    text(d["next_step"], "next_step");
    require(std::regex_match(d["date"].get<std::string>(), std::regex("\\d{4}-\\d\\d-\\d\\d")),
            "date");
    if (d.contains("headline")) block(d["headline"], "headline");
    for (const Json& section : d["sections"]) {
      keys(section, "section", {"id", "title", "text", "blocks"});
      const std::string place = section.value("id", "?");
      id(section["id"]);
      text(section["title"], place + ".title");
      for (const Json& paragraph : section["text"]) text(paragraph, place + ".text");
      for (const Json& one : section["blocks"]) block(one, place);
      require(!section["text"].empty() || !section["blocks"].empty(), place + " is empty");
    }
    return faults_;
  }

 private:
  void require(bool holds, const std::string& fault) {
    if (!holds) faults_.push_back(fault);
  }

  void keys(const Json& object, const std::string& place, const std::set<std::string>& needed,
            const std::set<std::string>& allowed = {}) {
    require(object.is_object(), place + " is no object");
    if (!object.is_object()) return;
    for (const auto& key : needed) require(object.contains(key), place + " has no " + key);
    for (const auto& [key, value] : object.items()) {
      require(needed.contains(key) || allowed.contains(key), place + " has " + key);
    }
  }

  void one_of(const Json& value, const std::set<std::string>& words, const std::string& place) {
    require(value.is_string() && words.contains(value.get<std::string>()),
            place + " is " + value.dump());
  }

  void text(const Json& value, const std::string& place, bool in_words = true) {
    require(value.is_string(), place + " is no text");
    if (!value.is_string() || !in_words) return;
    std::smatch found;
    const auto string = value.get<std::string>();
    if (std::regex_search(string, found, kIdentifier)) {
      faults_.push_back(place + " has the identifier " + found.str() + ": " + string);
    }
  }

  void number(const Json& value, const std::string& place) {
    require(value.is_number(), place + " is no finite number: " + value.dump());
  }

  void id(const Json& value) {
    static const std::regex kForm("[a-z0-9-]+");
    const auto name = value.get<std::string>();
    require(std::regex_match(name, kForm), "id " + name);
    require(ids_.insert(name).second, "id " + name + " is there twice");
  }

  void facts(const Json& all, const std::string& place) {
    for (const Json& fact : all) {
      keys(fact, place + " fact", {"label", "value"});
      text(fact["label"], place);
      text(fact["value"], place);
      require(!fact["value"].get<std::string>().empty(), place + " has a fact without a value");
    }
  }

  void axis(const Json& axis, const std::string& place) {
    keys(axis, place + " axis", {"label", "unit", "scale"}, {"range"});
    text(axis["label"], place);
    text(axis["unit"], place);
    require(axis["unit"] != "1", place + ": unit 1");
    require(axis["unit"].get<std::string>().find('^') == std::string::npos,
            place + ": unit " + axis["unit"].dump());
    one_of(axis["scale"], {"linear", "log"}, place + " axis.scale");
    if (axis.contains("range")) {
      require(axis["range"].size() == 2 && axis["range"][0] < axis["range"][1], place + " range");
    }
  }

  std::vector<double> numbers(const Json& reference, const std::string& place) {
    if (reference.contains("type")) {
      keys(reference, place, {"type", "byte_offset", "count"}, {"scale", "offset"});
      one_of(reference["type"], {"f64", "f32", "i16"}, place + ".type");
    } else {
      keys(reference, place, {"start", "step", "count"});
      number(reference["start"], place + ".start");
      number(reference["step"], place + ".step");
    }
    try {
      return page_.numbers(reference);
    } catch (const std::out_of_range& error) {
      faults_.push_back(place + ": " + error.what());
      return {};
    }
  }

  void ascending(const std::vector<double>& x, const std::string& place) {
    for (std::size_t i = 1; i < x.size(); ++i) {
      if (x[i] >= x[i - 1]) continue;
      faults_.push_back(place + ": x does not ascend");
      return;
    }
  }

  void samples(const Json& data, const std::string& place) {
    keys(data, place, {"kind", "x", "y"}, {"y_std"});
    const auto x = numbers(data["x"], place + ".x");
    const auto y = numbers(data["y"], place + ".y");
    require(x.size() == y.size(), place + ": x and y");
    require(!x.empty(), place + " has no point");
    require(has_number(y), place + " has no number");
    ascending(x, place);
    if (data.contains("y_std")) {
      require(numbers(data["y_std"], place + ".y_std").size() == x.size(), place + ": y_std");
    }
  }

  void envelope(const Json& data, const std::string& place) {
    keys(data, place, {"kind", "x", "levels"});
    const auto count = data["x"]["count"].get<std::size_t>();
    require(!data["levels"].empty(), place + " has no level");
    std::size_t before = 0;
    for (const Json& level : data["levels"]) {
      keys(level, place + " level", {"samples_per_bucket", "least", "greatest"});
      const auto bucket = level["samples_per_bucket"].get<std::size_t>();
      require(bucket > before, place + ": levels are not from fine to coarse");
      before = bucket;
      const auto least = numbers(level["least"], place);
      const auto greatest = numbers(level["greatest"], place);
      require(least.size() == (count + bucket - 1) / bucket, place + ": buckets");
      require(least.size() == greatest.size(), place + ": least and greatest");
    }
  }

  static bool has_number(const std::vector<double>& values) {
    for (const double value : values) {
      if (std::isfinite(value)) return true;
    }
    return false;
  }

  void views(const Json& block, const std::string& place,
             const std::function<void(const Json&, const std::string&)>& panel) {
    for (const Json& choice : block["choices"]) text(choice, place + " choice");
    std::set<std::string> seen;
    require(!block["views"].empty(), place + " has no view");
    for (const Json& view : block["views"]) {
      keys(view, place + " view", {"labels", "facts", "panels"}, {"shown"});
      require(view["labels"].size() == block["choices"].size(), place + ": labels for choices");
      require(seen.insert(view["labels"].dump()).second,
              place + ": two views " + view["labels"].dump());
      for (const Json& label : view["labels"]) {
        text(label, place + " label");
        require(label != "", place + ": an empty label");
      }
      facts(view["facts"], place);
      require(!view["panels"].empty(), place + " has a view without a panel");
      for (const Json& one : view["panels"]) {
        require(!one["series"].empty(), place + " has a panel without a series");
        panel(one, place);
      }
    }
  }

  void curves(const Json& block, const std::string& place) {
    axis(block["x"], place);
    views(block, place, [this](const Json& panel, const std::string& at) {
      keys(panel, at + " panel", {"y", "height", "series", "levels"});
      axis(panel["y"], at);
      require(panel["height"] > 0.0, at + " panel.height");
      for (const Json& series : panel["series"]) {
        keys(series, at + " series", {"label", "role", "draw", "data"});
        text(series["label"], at);
        one_of(series["role"], kRoles, at + " role");
        one_of(series["draw"], {"line", "stems", "points"}, at + " draw");
        const bool is_whole = series["data"]["kind"] == "samples";
        is_whole ? samples(series["data"], at) : envelope(series["data"], at);
      }
      for (const Json& level : panel["levels"]) {
        keys(level, at + " level", {"label", "role", "y"});
        text(level["label"], at);
        one_of(level["role"], kRoles, at + " role");
        number(level["y"], at + " level");
      }
    });
  }

  void scatter(const Json& block, const std::string& place) {
    views(block, place, [this](const Json& panel, const std::string& at) {
      keys(panel, at + " panel", {"x", "y", "equal_scales", "series"});
      axis(panel["x"], at);
      axis(panel["y"], at);
      require(panel["equal_scales"].is_boolean(), at + " equal_scales");
      for (const Json& series : panel["series"]) {
        keys(series, at + " series", {"label", "role", "draw", "x", "y"});
        text(series["label"], at);
        one_of(series["role"], kRoles, at + " role");
        one_of(series["draw"], {"line", "points"}, at + " draw");
        const auto x = numbers(series["x"], at);
        require(x.size() == numbers(series["y"], at).size(), at + ": x and y");
        require(has_number(x), at + " has no number");
      }
    });
  }

  void map(const Json& block, const std::string& place) {
    axis(block["x"], place);
    axis(block["y"], place);
    require(!block["points"].empty(), place + " has no point");
    for (const Json& point : block["points"]) {
      keys(point, place + " point",
           {"mark", "non_minimum_phase", "series", "role", "real", "imaginary", "details"},
           {"real_std", "imaginary_std"});
      one_of(point["mark"], {"pole", "zero"}, place + " mark");
      one_of(point["role"], kRoles, place + " role");
      text(point["series"], place);
      for (const auto& [key, value] : point.items()) {
        if (key.starts_with("real") || key.starts_with("imaginary")) number(value, place + key);
      }
      require(!point["non_minimum_phase"].get<bool>() || point["real"] > 0.0,
              place + ": a non-minimum-phase zero in the left half plane");
      facts(point["details"], place);
    }
  }

  void sweep(const Json& block, const std::string& place) {
    for (const char* key : {"parameter", "x", "y", "frequency"}) axis(block[key], place);
    const auto values = numbers(block["values"], place);
    require(values.size() >= 2, place + " has no values");
    ascending(values, place);
    require(!block["tracks"].empty(), place + " has no track");
    for (const Json& track : block["tracks"]) {
      keys(track, place + " track", {"label", "mark", "role", "real", "imaginary", "frequency"});
      text(track["label"], place);
      one_of(track["mark"], {"pole", "zero"}, place + " mark");
      one_of(track["role"], kRoles, place + " role");
      for (const char* key : {"real", "imaginary", "frequency"}) {
        require(numbers(track[key], place).size() == values.size(), place + " track." + key);
      }
    }
    for (const Json& event : block["events"]) {
      keys(event, place + " event", {"value", "text"});
      number(event["value"], place + " event");
      text(event["text"], place);
    }
  }

  void table(const Json& block, const std::string& place) {
    for (const Json& column : block["columns"]) {
      keys(column, place + " column", {"title", "unit", "numeric"});
      text(column["title"], place);
    }
    require(!block["rows"].empty(), place + " has no row");
    for (const Json& row : block["rows"]) {
      require(row.size() == block["columns"].size(), place + ": cells for columns");
      for (const Json& cell : row) text(cell, place);
    }
  }

  void ranking(const Json& block, const std::string& place) {
    require(!block["items"].empty(), place + " has no item");
    for (const Json& item : block["items"]) {
      keys(item, place + " item", {"label", "share", "value", "chosen", "details"});
      text(item["label"], place);
      text(item["value"], place);
      require(item["share"] >= 0.0 && item["share"] <= 1.0, place + " share");
      facts(item["details"], place);
    }
  }

  void block(const Json& block, const std::string& section) {
    const std::string place = section + "/" + block.value("id", "?");
    id(block["id"]);
    text(block["title"], place);
    text(block["caption"], place);
    require(block["title"] != "", place + " has no title");
    const std::set<std::string> head = {"id", "title", "caption", "kind"};
    using Check = void (Checker::*)(const Json&, const std::string&);
    const std::map<std::string, std::pair<std::set<std::string>, Check>> kinds = {
        {"table", {{"columns", "rows"}, &Checker::table}},
        {"curves", {{"x", "choices", "views"}, &Checker::curves}},
        {"scatter", {{"choices", "views"}, &Checker::scatter}},
        {"map", {{"x", "y", "points"}, &Checker::map}},
        {"ranking", {{"chosen_word", "items"}, &Checker::ranking}},
        {"sweep",
         {{"parameter", "values", "x", "y", "frequency", "tracks", "events"}, &Checker::sweep}}};
    const auto kind = kinds.find(block.value("kind", ""));
    if (kind == kinds.end()) {
      faults_.push_back(place + ": kind");
      return;
    }
    std::set<std::string> needed = head;
    needed.insert(kind->second.first.begin(), kind->second.first.end());
    keys(block, place, needed);
    (this->*kind->second.second)(block, place);
  }

  const ReadPage& page_;
  std::vector<std::string> faults_;
  std::set<std::string> ids_;
};

}  // namespace

std::vector<double> ReadPage::numbers(const Json& reference) const {
  const auto count = reference.at("count").get<std::size_t>();
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k) {
    if (!reference.contains("type")) {
      values.push_back(reference["start"].get<double>() +
                       static_cast<double>(k) * reference["step"].get<double>());
      continue;
    }
    const auto offset = reference["byte_offset"].get<std::size_t>();
    if (reference["type"] == "f64") {
      values.push_back(number_at<double>(bytes, offset + 8 * k));
    } else if (reference["type"] == "f32") {
      values.push_back(static_cast<double>(number_at<float>(bytes, offset + 4 * k)));
    } else {
      const auto integer = number_at<std::int16_t>(bytes, offset + 2 * k);
      values.push_back(integer == -32768 ? std::numeric_limits<double>::quiet_NaN()
                                         : reference["offset"].get<double>() +
                                               reference["scale"].get<double>() * integer);
    }
  }
  return values;
}

Json ReadPage::block(const std::string& id) const {
  if (document.contains("headline") && document["headline"]["id"] == id) {
    return document["headline"];
  }
  for (const Json& section : document["sections"]) {
    for (const Json& one : section["blocks"]) {
      if (one["id"] == id) return one;
    }
  }
  return nullptr;
}

Json ReadPage::section(const std::string& id) const {
  for (const Json& one : document["sections"]) {
    if (one["id"] == id) return one;
  }
  return nullptr;
}

ReadPage read_page(const std::string& html) {
  return {Json::parse(element(html, "document")), from_base64(element(html, "arrays"))};
}

std::vector<std::string> contract_faults(const ReadPage& page) {
  return Checker(page).faults();
}

}  // namespace flexarm::testing_app
