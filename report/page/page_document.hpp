#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// What the page of `--report` says. The page draws it (report/page/web); the seam is
/// report/page/web/src/contract.ts, whose interfaces have the names and members of these structs.
///
/// Words and units are those of an engineer ("hub angle", "m/s^2"). Numbers that stand in a text
/// come formatted.
namespace flexarm::report::page {

/// Where a curve has a gap, and a number is not known.
inline constexpr double kGapNumber = std::numeric_limits<double>::quiet_NaN();

/// start + step * index.
struct EvenRange {
  double start = 0.0;
  double step = 1.0;
  std::size_t count = 0;

  bool operator==(const EvenRange&) const = default;
};

/// Numbers of a curve, NaN a gap: written as f64, as f32, or as the formula.
using Numbers = std::variant<std::vector<double>, std::vector<float>, EvenRange>;

std::size_t count_of(const Numbers& numbers);

enum class Status { good, partial, bad, neutral };

struct Verdict {
  Status status = Status::neutral;
  std::string word;
  std::string sentence;
};

struct Fact {
  std::string label;
  std::string value;

  bool operator==(const Fact&) const = default;
};

/// What stands over every block. Ids are of a-z, 0-9 and "-"; `unique_ids` makes them unique.
struct BlockHead {
  std::string id;
  std::string title;
  std::string caption = {};
};

struct TableColumn {
  std::string title;
  std::string unit = {};
  bool numeric = false;
};

struct TableBlock {
  BlockHead head;
  std::vector<TableColumn> columns;
  std::vector<std::vector<std::string>> rows;
};

enum class AxisScale { linear, logarithmic };

struct Axis {
  std::string label;
  std::string unit = {};
  AxisScale scale = AxisScale::linear;
  std::optional<std::array<double, 2>> range = {};  ///< empty: from the data in view
};

/// What a curve is; it decides colour and stroke.
enum class Role {
  measured,
  before,
  after,
  residual_before,
  residual_after,
  bound,
  noise,
  coherence,
  first,
  second,
  third,
  fourth,
  fifth,
  sixth
};

/// The roles without an order, again and again.
Role numbered_role(std::size_t index);

enum class Draw { line, stems, points };

/// x ascends; all have one length.
struct Samples {
  Numbers x;
  Numbers y;
  std::optional<Numbers> y_std = {};
};

/// Evenly sampled numbers. They go into the page whole where the page has room for that, else as an
/// envelope (report/page/envelope.hpp).
struct Record {
  EvenRange x;
  std::vector<float> y;
};

struct Series {
  std::string label;
  Role role = Role::measured;
  Draw draw = Draw::line;
  std::variant<Samples, Record> data;
};

struct Level {
  std::string label;
  Role role = Role::bound;
  double y = 0.0;
};

struct CurvesPanel {
  Axis y;
  double height = 1.0;  ///< relative to the other panels
  std::vector<Series> series;
  std::vector<Level> levels = {};
};

struct CurvesView {
  std::vector<std::string> labels;  ///< one for each of the block's `choices`
  std::vector<Fact> facts = {};
  std::vector<CurvesPanel> panels;
  std::optional<std::array<double, 2>> shown = {};  ///< part of x that is in view first
};

/// Curves over a common x axis, panels one above the other; one view is seen at a time.
struct CurvesBlock {
  BlockHead head;
  Axis x;
  std::vector<std::string> choices = {};
  std::vector<CurvesView> views;
};

struct ScatterSeries {
  std::string label;
  Role role = Role::measured;
  Draw draw = Draw::points;
  Numbers x;
  Numbers y;
};

struct ScatterPanel {
  Axis x;
  Axis y;
  bool equal_scales = false;
  std::vector<ScatterSeries> series;
};

struct ScatterView {
  std::vector<std::string> labels;
  std::vector<Fact> facts = {};
  std::vector<ScatterPanel> panels;
};

/// Points and lines without an order along x.
struct ScatterBlock {
  BlockHead head;
  std::vector<std::string> choices = {};
  std::vector<ScatterView> views;
};

enum class Mark { pole, zero };

struct MapPoint {
  Mark mark = Mark::pole;
  bool non_minimum_phase = false;
  std::string series;
  Role role = Role::measured;
  double real = 0.0;
  double imaginary = 0.0;
  std::optional<double> real_std = {};
  std::optional<double> imaginary_std = {};
  std::vector<Fact> details = {};
};

/// Poles and zeros in the s plane.
struct MapBlock {
  BlockHead head;
  Axis x;
  Axis y;
  std::vector<MapPoint> points;
};

struct RankingItem {
  std::string label;
  double share = 0.0;  ///< length of the bar, 0 to 1
  std::string value;
  bool chosen = false;
  std::vector<Fact> details = {};
};

struct RankingBlock {
  BlockHead head;
  std::vector<RankingItem> items;
  std::string chosen_word = "identified";  ///< beside those that are chosen
};

/// A pole or zero over the parameter, a number for each of its values; NaN where there is none.
struct SweepTrack {
  std::string label;
  Mark mark = Mark::pole;
  Role role = Role::first;
  std::vector<double> real;
  std::vector<double> imaginary;
  std::vector<double> frequency;
};

struct SweepNote {
  double value = 0.0;
  std::string text;
};

struct SweepBlock {
  BlockHead head;
  Axis parameter;
  std::vector<double> values;
  Axis x;
  Axis y;
  Axis frequency;
  std::vector<SweepTrack> tracks;
  std::vector<SweepNote> events = {};
};

using Block =
    std::variant<TableBlock, CurvesBlock, ScatterBlock, MapBlock, RankingBlock, SweepBlock>;

const BlockHead& head_of(const Block& block);
BlockHead& head_of(Block& block);

struct Section {
  std::string id;
  std::string title;
  std::vector<std::string> text = {};
  std::vector<Block> blocks = {};

  bool is_empty() const { return text.empty() && blocks.empty(); }

  /// A block of views or rows only where it has any.
  void add(Block block);
};

struct PageDocument {
  std::string program;  ///< "flexarm 0.1.0"
  std::string command;  ///< the command line that made the page
  std::string title;
  Verdict verdict;
  std::optional<Block> headline = {};
  std::vector<Fact> facts = {};  ///< of the first screen, as the two below
  std::vector<Section> sections = {};
  std::vector<Fact> results = {};  ///< what came out, each with its value
  std::string next_step = {};      ///< a sentence
  std::string date = {};           ///< "2026-11-29"

  /// Adds a section that says something; drops an empty one.
  void add(Section section);
};

/// Ids of sections and blocks as the contract asks for: characters that do not belong there are
/// "-", and what is there twice gets a number.
void make_ids_unique(PageDocument& document);

}  // namespace flexarm::report::page
