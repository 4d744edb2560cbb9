#include "report/page/sweep_blocks.hpp"

#include "compare/features.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/page/page_curves.hpp"
#include "report/page/page_words.hpp"
#include "report/tables/sweep_tables.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::report::page {

namespace {

using compare::SweepCurve;
using compare::SweepFamily;
using compare::SweepResult;

constexpr double kOneTurn = 2.0 * std::numbers::pi;

/// A line of the grid along the last parameter, in ascending order of its values.
class GridRow {
 public:
  GridRow(const SweepResult& result, std::size_t row) : result_(result), row_(row) {
    for (std::size_t k = 0; k < length(); ++k) values_.push_back(last_axis().values[column(k)]);
  }

  const std::vector<double>& values() const { return values_; }
  std::size_t length() const { return last_axis().values.size(); }
  std::size_t point(std::size_t k) const { return row_ * length() + column(k); }
  std::size_t row() const { return row_; }

  /// "0.2 kg" of the first of two parameters; empty for one.
  std::string label() const {
    if (result_.task.axes.size() < 2) return "";
    const auto& first = result_.task.axes.front();
    const std::string unit = unit_text(first.parameter.unit);
    return number_of(first.values[row_], 5) + (unit.empty() ? "" : " " + unit);
  }

 private:
  const compare::SweepAxis& last_axis() const { return result_.task.axes.back(); }
  std::size_t column(std::size_t k) const {
    const auto& values = last_axis().values;
    return values.front() <= values.back() ? k : values.size() - 1 - k;
  }

  const SweepResult& result_;
  std::size_t row_;
  std::vector<double> values_;
};

/// The rows that are shown, from the first to the last one.
std::vector<GridRow> shown_rows(const SweepResult& result) {
  const std::size_t count =
      result.task.axes.size() > 1 ? result.task.axes.front().values.size() : 1;
  const std::size_t shown = std::min(count, kMostRows);
  std::vector<GridRow> rows;
  for (std::size_t i = 0; i < shown; ++i) {
    rows.emplace_back(result, shown > 1 ? i * (count - 1) / (shown - 1) : 0);
  }
  return rows;
}

Axis parameter_axis(const SweepResult& result) {
  const auto& last = result.task.axes.back();
  return {in_words(last.parameter.name), unit_text(last.parameter.unit),
          last.logarithmic ? AxisScale::logarithmic : AxisScale::linear};
}

bool has_damped_poles(const SweepResult& result) {
  return std::ranges::any_of(result.curves,
                             [](const SweepCurve& curve) { return curve.family.damped; });
}

SweepTrack track_of(const SweepCurve& curve, const GridRow& row, std::size_t index) {
  SweepTrack track{fmt::format("{} {}", curve.family.zeros_of ? "zero" : "pole", curve.number),
                   curve.family.zeros_of ? Mark::zero : Mark::pole,
                   numbered_role(index),
                   {},
                   {},
                   {}};
  for (std::size_t k = 0; k < row.length(); ++k) {
    const auto& s = curve.s_rad_per_s.front()[row.point(k)];
    track.real.push_back(s ? s->real() : kGapNumber);
    track.imaginary.push_back(s ? s->imag() : kGapNumber);
    track.frequency.push_back(s ? std::abs(*s) / kOneTurn : kGapNumber);
  }
  return track;
}

/// "zero 2 coalesces with zero 3".
std::string event_text(const compare::SweepEvent& event) {
  const char* name = event.family.zeros_of ? "zero" : "pole";
  std::string text =
      event.track != compare::kNoTrack ? fmt::format("{} {} ", name, event.track) : "";
  text += word_for(event.kind);
  if (event.other != compare::kNoTrack) text += fmt::format(" {} {}", name, event.other);
  return text;
}

SweepBlock sweep_map(const SweepResult& result, const std::optional<arm::Sensor>& sensor,
                     const GridRow& row, bool damped) {
  const std::string name = sensor ? sensor_label(*sensor) : "";
  std::string title = sensor ? "Poles and zeros of torque to " + name : "Poles";
  if (!row.label().empty()) {
    title += fmt::format(", {} {}", in_words(result.task.axes.front().parameter.name), row.label());
  }
  SweepBlock block{{"sweep-map-" + name, title,
                    "Upper half plane. Roots have their conjugates; zeros, which are those of the "
                    "undamped arm, also their mirror images at the imaginary axis."},
                   parameter_axis(result),
                   row.values(),
                   {"real part", "1/s"},
                   {"imaginary part", "rad/s"},
                   {"frequency", "Hz"},
                   {}};
  std::size_t poles = 0;
  std::size_t zeros = 0;
  for (const SweepCurve& curve : result.curves) {
    const SweepFamily& family = curve.family;
    const bool is_shown_pole = !family.zeros_of && family.damped == damped;
    const bool is_shown_zero = family.zeros_of && family.zeros_of == sensor;
    if (!is_shown_pole && !is_shown_zero) continue;
    SweepTrack track = track_of(curve, row, is_shown_pole ? poles++ : zeros++);
    if (has_number(track.frequency)) block.tracks.push_back(std::move(track));
  }
  for (const auto& event : result.events) {
    if (event.row != row.row() || (event.family.zeros_of && event.family.zeros_of != sensor)) {
      continue;
    }
    if (!event.family.zeros_of && event.family.damped != damped) continue;
    block.events.push_back({0.5 * (event.from_value + event.to_value), event_text(event)});
  }
  std::ranges::stable_sort(block.events, {}, &SweepNote::value);
  return block;
}

std::string family_words(const SweepFamily& family) {
  if (family.zeros_of) return "zeros of the " + sensor_label(*family.zeros_of);
  return family.damped ? "poles with damping" : "poles, undamped";
}

/// The largest relative difference from the first model at each point of a row.
std::vector<double> largest_differences(const SweepResult& result, const SweepFamily& family,
                                        const GridRow& row, std::size_t model) {
  std::vector<double> largest(row.length(), kGapNumber);
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != family) continue;
    for (std::size_t k = 0; k < row.length(); ++k) {
      const auto& first = curve.s_rad_per_s.front()[row.point(k)];
      const auto& other = curve.s_rad_per_s[model][row.point(k)];
      if (!first || !other) continue;
      largest[k] = std::fmax(largest[k], compare::relative_distance(*other, *first));
    }
  }
  return largest;
}

CurvesView family_view(const SweepResult& result, const SweepFamily& family, const GridRow& row) {
  const bool as_modulus = family.zeros_of && !family.is_ordered();
  CurvesPanel panel{as_modulus ? Axis{"|s|", "rad/s"} : Axis{"frequency", "Hz"}, 1.8, {}};
  std::size_t index = 0;
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != family) continue;
    SweepTrack track = track_of(curve, row, index++);
    if (as_modulus) {
      for (double& value : track.frequency) value *= kOneTurn;
    }
    panel.series.push_back(page::curve(track.label, track.role, row.values(), track.frequency));
  }
  CurvesView view{{family_words(family)}, {}, {std::move(panel)}};
  CurvesPanel apart{{"relative difference", "", AxisScale::logarithmic}, 0.8, {}};
  for (std::size_t m = 1; m < result.task.models.size(); ++m) {
    auto differences = largest_differences(result, family, row, m);
    // Where all digits agree there is nothing to draw on a logarithmic axis.
    for (double& value : differences) value = value > 0.0 ? value : kGapNumber;
    if (!has_number(differences)) continue;
    apart.series.push_back(page::curve(text_in_words(result.task.models[m].name), numbered_role(m),
                                       row.values(), std::move(differences)));
  }
  if (!apart.series.empty()) view.panels.push_back(std::move(apart));
  return view;
}

CurvesView mode_view(const std::string& label, const Axis& axis, const compare::SweepTable& values,
                     const GridRow& row) {
  CurvesPanel panel{axis, 1.0, {}};
  for (std::size_t order = 0; order < values.front().size(); ++order) {
    std::vector<double> own;
    for (std::size_t k = 0; k < row.length(); ++k) {
      own.push_back(values.front()[order][row.point(k)]);
    }
    panel.series.push_back(page::curve(fmt::format("mode {}", order + 1), numbered_role(order),
                                       row.values(), std::move(own)));
  }
  return {{label}, {}, {std::move(panel)}};
}

}  // namespace

std::vector<SweepBlock> sweep_maps(const SweepResult& result) {
  const bool damped = has_damped_poles(result);
  std::vector<std::optional<arm::Sensor>> sensors;
  for (const arm::Sensor& sensor : result.task.questions.sensors) sensors.emplace_back(sensor);
  if (sensors.empty()) sensors.emplace_back(std::nullopt);
  std::vector<SweepBlock> blocks;
  for (const auto& sensor : sensors) {
    for (const GridRow& row : shown_rows(result)) {
      SweepBlock block = sweep_map(result, sensor, row, damped);
      if (!block.tracks.empty()) blocks.push_back(std::move(block));
    }
  }
  return blocks;
}

CurvesBlock sweep_curves(const SweepResult& result) {
  const bool has_rows = result.task.axes.size() > 1;
  CurvesBlock block{{"sweep-curves", "Over " + parameter_axis(result).label, ""},
                    parameter_axis(result),
                    {"numbers"},
                    {}};
  if (has_rows) {
    block.choices.push_back(in_words(result.task.axes.front().parameter.name));
  }
  if (result.task.models.size() > 1) {
    block.head.caption = "Curves are of the " + text_in_words(result.task.models.front().name) +
                         "; below them the largest difference of the other formulations from it.";
  }
  std::vector<SweepFamily> families;
  for (const SweepCurve& curve : result.curves) {
    if (std::ranges::find(families, curve.family) == families.end()) {
      families.push_back(curve.family);
    }
  }
  const auto add = [&](CurvesView view, const GridRow& row) {
    if (has_rows) view.labels.push_back(row.label());
    block.views.push_back(std::move(view));
  };
  const auto rows = shown_rows(result);
  for (const SweepFamily& family : families) {
    for (const GridRow& row : rows) add(family_view(result, family, row), row);
  }
  for (const GridRow& row : rows) {
    if (result.modes.hub_slope.empty()) break;
    add(mode_view("hub slopes", {"hub slope", ""}, result.modes.hub_slope, row), row);
  }
  for (const GridRow& row : rows) {
    if (result.modes.tip_value_m.empty()) break;
    add(mode_view("end-point values", {"end-point value", "m"}, result.modes.tip_value_m, row),
        row);
  }
  return block;
}

}  // namespace flexarm::report::page
