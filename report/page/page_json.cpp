#include "report/page/page_json.hpp"

#include "report/page/array_bytes.hpp"
#include "report/page/envelope.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

namespace flexarm::report::page {

namespace {

using Json = nlohmann::ordered_json;

/// Of the arrays' room, what records get where others want all of it.
constexpr std::size_t kLeastRecordShare = 8;

const char* name_of(Status status) {
  switch (status) {
    case Status::good:
      return "good";
    case Status::partial:
      return "partial";
    case Status::bad:
      return "bad";
    case Status::neutral:
      break;
  }
  return "neutral";
}

const char* name_of(Role role) {
  constexpr std::array kNames = {
      "measured",  "before", "after",  "residual_before", "residual_after", "bound", "noise",
      "coherence", "first",  "second", "third",           "fourth",         "fifth", "sixth"};
  return kNames[static_cast<std::size_t>(role)];
}

const char* name_of(Draw draw) {
  constexpr std::array kNames = {"line", "stems", "points"};
  return kNames[static_cast<std::size_t>(draw)];
}

const char* name_of(Mark mark) {
  return mark == Mark::pole ? "pole" : "zero";
}

Json facts_json(const std::vector<Fact>& facts) {
  Json json = Json::array();
  for (const auto& [label, value] : facts) json.push_back({{"label", label}, {"value", value}});
  return json;
}

Json axis_json(const Axis& axis) {
  Json json = {{"label", axis.label},
               {"unit", axis.unit},
               {"scale", axis.scale == AxisScale::linear ? "linear" : "log"}};
  if (axis.range) json["range"] = *axis.range;
  return json;
}

Json range_json(const EvenRange& range) {
  return {{"start", range.start}, {"step", range.step}, {"count", range.count}};
}

/// Blocks to JSON; arrays go into `bytes`.
class Writer {
 public:
  Writer(ArrayBytes& bytes, std::size_t record_cap) : bytes_(bytes), record_cap_(record_cap) {}

  Json block(const Block& any) {
    return std::visit(
        [this](const auto& block) {
          Json json = {
              {"id", block.head.id}, {"title", block.head.title}, {"caption", block.head.caption}};
          json.update(content(block));
          return json;
        },
        any);
  }

 private:
  Json numbers(const Numbers& any) {
    if (const auto* range = std::get_if<EvenRange>(&any)) return range_json(*range);
    if (const auto* singles = std::get_if<std::vector<float>>(&any)) {
      return bytes_.add(std::span<const float>(*singles));
    }
    return bytes_.add(std::span<const double>(std::get<std::vector<double>>(any)));
  }

  Json data(const Samples& samples) {
    const std::size_t count = count_of(samples.x);
    if (count_of(samples.y) != count || (samples.y_std && count_of(*samples.y_std) != count)) {
      throw std::invalid_argument("a curve of the page has vectors of unlike lengths");
    }
    Json json = {{"kind", "samples"}, {"x", numbers(samples.x)}, {"y", numbers(samples.y)}};
    if (samples.y_std) json["y_std"] = numbers(*samples.y_std);
    return json;
  }

  Json data(const Record& record) {
    if (record.x.count != record.y.size()) {
      throw std::invalid_argument("a record of the page has not one time a sample");
    }
    if (record.y.size() * kBytesPerSample <= record_cap_) return data(Samples{record.x, record.y});
    Json levels = Json::array();
    for (const auto& level : envelope(record.y, finest_bucket(record.y.size(), record_cap_))) {
      auto [least, greatest] = bytes_.add_envelope(level.least, level.greatest);
      levels.push_back({{"samples_per_bucket", level.samples_per_bucket},
                        {"least", std::move(least)},
                        {"greatest", std::move(greatest)}});
    }
    return {{"kind", "envelope"}, {"x", range_json(record.x)}, {"levels", std::move(levels)}};
  }

  static Json content(const TableBlock& table) {
    Json columns = Json::array();
    for (const TableColumn& column : table.columns) {
      columns.push_back(
          {{"title", column.title}, {"unit", column.unit}, {"numeric", column.numeric}});
    }
    return {{"kind", "table"}, {"columns", std::move(columns)}, {"rows", table.rows}};
  }

  Json content(const CurvesBlock& block) {
    Json views = Json::array();
    for (const CurvesView& view : block.views) {
      require_labels(block.head, block.choices, view.labels);
      Json panels = Json::array();
      for (const CurvesPanel& panel : view.panels) {
        Json series = Json::array();
        for (const Series& one : panel.series) {
          series.push_back(
              {{"label", one.label},
               {"role", name_of(one.role)},
               {"draw", name_of(one.draw)},
               {"data", std::visit([this](const auto& some) { return data(some); }, one.data)}});
        }
        Json levels = Json::array();
        for (const Level& level : panel.levels) {
          levels.push_back({{"label", level.label}, {"role", name_of(level.role)}, {"y", level.y}});
        }
        panels.push_back({{"y", axis_json(panel.y)},
                          {"height", panel.height},
                          {"series", std::move(series)},
                          {"levels", std::move(levels)}});
      }
      views.push_back({{"labels", view.labels},
                       {"facts", facts_json(view.facts)},
                       {"panels", std::move(panels)}});
      if (view.shown) views.back()["shown"] = *view.shown;
    }
    return {{"kind", "curves"},
            {"x", axis_json(block.x)},
            {"choices", block.choices},
            {"views", std::move(views)}};
  }

  Json content(const ScatterBlock& block) {
    Json views = Json::array();
    for (const ScatterView& view : block.views) {
      require_labels(block.head, block.choices, view.labels);
      Json panels = Json::array();
      for (const ScatterPanel& panel : view.panels) {
        Json series = Json::array();
        for (const ScatterSeries& one : panel.series) {
          if (count_of(one.x) != count_of(one.y)) {
            throw std::invalid_argument("points of the page have vectors of unlike lengths");
          }
          series.push_back({{"label", one.label},
                            {"role", name_of(one.role)},
                            {"draw", name_of(one.draw)},
                            {"x", numbers(one.x)},
                            {"y", numbers(one.y)}});
        }
        panels.push_back({{"x", axis_json(panel.x)},
                          {"y", axis_json(panel.y)},
                          {"equal_scales", panel.equal_scales},
                          {"series", std::move(series)}});
      }
      views.push_back({{"labels", view.labels},
                       {"facts", facts_json(view.facts)},
                       {"panels", std::move(panels)}});
    }
    return {{"kind", "scatter"}, {"choices", block.choices}, {"views", std::move(views)}};
  }

  static Json content(const MapBlock& block) {
    Json points = Json::array();
    for (const MapPoint& point : block.points) {
      Json json = {{"mark", name_of(point.mark)}, {"non_minimum_phase", point.non_minimum_phase},
                   {"series", point.series},      {"role", name_of(point.role)},
                   {"real", point.real},          {"imaginary", point.imaginary}};
      if (point.real_std) json["real_std"] = *point.real_std;
      if (point.imaginary_std) json["imaginary_std"] = *point.imaginary_std;
      json["details"] = facts_json(point.details);
      points.push_back(std::move(json));
    }
    return {{"kind", "map"},
            {"x", axis_json(block.x)},
            {"y", axis_json(block.y)},
            {"points", std::move(points)}};
  }

  static Json content(const RankingBlock& block) {
    Json items = Json::array();
    for (const RankingItem& item : block.items) {
      items.push_back({{"label", item.label},
                       {"share", item.share},
                       {"value", item.value},
                       {"chosen", item.chosen},
                       {"details", facts_json(item.details)}});
    }
    return {{"kind", "ranking"}, {"chosen_word", block.chosen_word}, {"items", std::move(items)}};
  }

  Json content(const SweepBlock& block) {
    Json tracks = Json::array();
    for (const SweepTrack& track : block.tracks) {
      tracks.push_back({{"label", track.label},
                        {"mark", name_of(track.mark)},
                        {"role", name_of(track.role)},
                        {"real", numbers(track.real)},
                        {"imaginary", numbers(track.imaginary)},
                        {"frequency", numbers(track.frequency)}});
    }
    Json events = Json::array();
    for (const auto& [value, text] : block.events) {
      events.push_back({{"value", value}, {"text", text}});
    }
    return {{"kind", "sweep"},
            {"parameter", axis_json(block.parameter)},
            {"values", numbers(block.values)},
            {"x", axis_json(block.x)},
            {"y", axis_json(block.y)},
            {"frequency", axis_json(block.frequency)},
            {"tracks", std::move(tracks)},
            {"events", std::move(events)}};
  }

  static void require_labels(const BlockHead& head, const std::vector<std::string>& choices,
                             const std::vector<std::string>& labels) {
    if (labels.size() == choices.size()) return;
    throw std::invalid_argument(fmt::format("block {} of the page: {} labels for {} choices",
                                            head.id, labels.size(), choices.size()));
  }

  ArrayBytes& bytes_;
  std::size_t record_cap_;
};

/// Room that arrays take which are not records, and the lengths of those that are.
struct Wanted {
  std::size_t other_bytes = 0;
  std::vector<std::size_t> records = {};

  void add(const Block& block) {
    if (const auto* curves = std::get_if<CurvesBlock>(&block)) {
      for (const CurvesView& view : curves->views) {
        for (const CurvesPanel& panel : view.panels) {
          for (const Series& series : panel.series) add(series);
        }
      }
    } else if (const auto* scatter = std::get_if<ScatterBlock>(&block)) {
      for (const ScatterView& view : scatter->views) {
        for (const ScatterPanel& panel : view.panels) {
          for (const ScatterSeries& series : panel.series) {
            other_bytes += bytes_of(series.x) + bytes_of(series.y);
          }
        }
      }
    } else if (const auto* sweep = std::get_if<SweepBlock>(&block)) {
      other_bytes += sizeof(double) * sweep->values.size() * (1 + 3 * sweep->tracks.size());
    }
  }

  void add(const Series& series) {
    if (const auto* record = std::get_if<Record>(&series.data)) {
      records.push_back(record->y.size());
      return;
    }
    const auto& samples = std::get<Samples>(series.data);
    other_bytes += bytes_of(samples.x) + bytes_of(samples.y);
    if (samples.y_std) other_bytes += bytes_of(*samples.y_std);
  }

  static std::size_t bytes_of(const Numbers& numbers) {
    if (std::holds_alternative<EvenRange>(numbers)) return 0;
    const bool is_single = std::holds_alternative<std::vector<float>>(numbers);
    return count_of(numbers) * (is_single ? sizeof(float) : sizeof(double));
  }
};

std::size_t record_cap(const PageDocument& document, std::size_t most_array_bytes) {
  Wanted wanted;
  if (document.headline) wanted.add(*document.headline);
  for (const Section& section : document.sections) {
    for (const Block& block : section.blocks) wanted.add(block);
  }
  const std::size_t least = most_array_bytes / kLeastRecordShare;
  const std::size_t left =
      most_array_bytes - std::min(most_array_bytes - least, wanted.other_bytes);
  return record_cap_bytes(wanted.records, left);
}

/// Text that ends no script element, opens no comment in one and is valid JSON.
std::string escaped(const Json& json) {
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string made;
  made.reserve(text.size());
  for (const char c : text) {
    if (c == '<') {
      made += "\\u003c";
    } else {
      made += c;
    }
  }
  return made;
}

}  // namespace

PageTexts page_texts(const PageDocument& document, std::size_t most_array_bytes) {
  ArrayBytes bytes;
  Writer writer(bytes, record_cap(document, most_array_bytes));
  Json json = {{"schema", "flexarm.page/1"},
               {"program", document.program},
               {"command", document.command},
               {"title", document.title},
               {"date", document.date},
               {"verdict",
                {{"status", name_of(document.verdict.status)},
                 {"word", document.verdict.word},
                 {"sentence", document.verdict.sentence}}}};
  if (document.headline) json["headline"] = writer.block(*document.headline);
  json["results"] = facts_json(document.results);
  json["facts"] = facts_json(document.facts);
  json["next_step"] = document.next_step;
  json["sections"] = Json::array();
  for (const Section& section : document.sections) {
    Json blocks = Json::array();
    for (const Block& block : section.blocks) blocks.push_back(writer.block(block));
    json["sections"].push_back({{"id", section.id},
                                {"title", section.title},
                                {"text", section.text},
                                {"blocks", std::move(blocks)}});
  }
  return {escaped(json), bytes.base64()};
}

}  // namespace flexarm::report::page
