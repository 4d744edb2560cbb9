#include "report/figures/sweep_figures.hpp"

#include "report/figures/meaning.hpp"
#include "report/figures/overlay_style.hpp"
#include "report/figures/sensor_label.hpp"
#include "report/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

namespace flexarm::report {

namespace {

using compare::SweepCurve;
using compare::SweepResult;
using RootsOfPoints = std::vector<std::optional<std::complex<double>>>;

constexpr double kHz = 2.0 * std::numbers::pi;  // rad/s
constexpr double kLogarithmicFrom = 30.0;       // largest over smallest value
constexpr std::size_t kMostDrawnPoints = 400;   // of a curve: more is finer than a picture shows
constexpr std::size_t kMostFamilies = 5;        // values of the first of two parameters
constexpr std::size_t kMostPanels = 6;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// One row of numbers: what is drawn for one model along the last axis.
using Values = std::vector<double>;
/// The values of one curve: [model][point].
using CurveValues = std::vector<Values>;

std::string axis_unit(const compare::SweepAxis& axis) {
  return unit_text(axis.parameter.unit);
}

Axis x_axis(const compare::SweepAxis& axis) {
  return {.label = in_words(axis.parameter.name),
          .unit = axis_unit(axis),
          .scale = axis.logarithmic ? Scale::logarithmic : Scale::linear};
}

/// x and y of the points from `begin` on, `count` of them, thinned out.
Series series_of(const std::string& name, const compare::SweepAxis& axis, const Values& values,
                 std::size_t begin, const Style& style) {
  Series series{name, {}, {}, style};
  const std::size_t count = axis.values.size();
  const std::size_t stride = (count + kMostDrawnPoints - 1) / kMostDrawnPoints;
  for (std::size_t j = 0; j < count; ++j) {
    const auto missing = [&](std::size_t i) { return std::isnan(values[begin + i]); };
    const bool at_gap =
        (j > 0 && missing(j - 1) != missing(j)) || (j + 1 < count && missing(j + 1) != missing(j));
    if (j % stride != 0 && j + 1 != count && !at_gap) continue;
    series.x.push_back(axis.values[j]);
    series.y.push_back(values[begin + j]);
  }
  return series;
}

bool has_a_value(const Values& values) {
  return std::ranges::any_of(values, [](double value) { return !std::isnan(value); });
}

/// Positive values that differ widely are drawn over decades.
Scale scale_for(const std::vector<CurveValues>& curves) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const auto& curve : curves) {
    for (const auto& values : curve) {
      for (const double value : values) {
        if (std::isnan(value)) continue;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
  }
  return low > 0.0 && high > kLogarithmicFrom * low ? Scale::logarithmic : Scale::linear;
}

CurveValues values_of(const SweepCurve& curve,
                      const std::function<double(std::complex<double>)>& value) {
  CurveValues values;
  for (const RootsOfPoints& roots : curve.s_rad_per_s) {
    values.emplace_back();
    for (const auto& s : roots) values.back().push_back(s ? value(*s) : kNothing);
  }
  return values;
}

/// The same kind of number of several roots, with what is written at their curves.
struct Group {
  std::string title;
  std::string label;
  std::string unit;
  std::vector<CurveValues> curves;
  std::vector<std::string> names;  ///< [curve]: "1"

  void add(CurveValues values, int number) {
    if (!has_a_value(values.front())) return;
    curves.push_back(std::move(values));
    names.push_back(std::to_string(number));
  }
};

Panel panel_of(const SweepResult& result, const Group& group) {
  const auto& axis = result.task.axes.back();
  Panel panel;
  panel.title = group.title;
  panel.y = {.label = group.label, .unit = group.unit, .scale = scale_for(group.curves)};
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    for (const CurveValues& curve : group.curves) {
      if (!has_a_value(curve[m])) continue;
      panel.series.push_back(
          series_of(in_words(result.task.models[m].name), axis, curve[m], 0, overlay_style(m)));
    }
  }
  for (std::size_t k = 0; k < group.curves.size(); ++k) {
    const Values& values = group.curves[k].front();
    for (std::size_t j = values.size(); j-- > 0;) {
      if (std::isnan(values[j])) continue;
      panel.annotations.push_back({axis.values[j], values[j], group.names[k], TextPlace::end});
      break;
    }
  }
  return panel;
}

Figure over_one(const SweepResult& result, const std::string& title,
                const std::vector<Group>& groups) {
  Figure figure;
  figure.title = title;
  PanelStack stack{.x = x_axis(result.task.axes.back())};
  for (const Group& group : groups) {
    if (!group.curves.empty()) stack.panels.push_back(panel_of(result, group));
  }
  if (stack.panels.size() > 2) figure.height_px = 900;
  figure.stacks.push_back(std::move(stack));
  return figure;
}

/// Some indices from 0 to count - 1, both ends among them.
std::vector<std::size_t> spread(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t n = std::min(count, most);
  for (std::size_t i = 0; i < n; ++i) {
    chosen.push_back(n == 1 ? 0 : i * (count - 1) / (n - 1));
  }
  return chosen;
}

/// A panel a curve; in it a colour a value of the first axis.
Figure over_two(const SweepResult& result, const std::string& title, const Group& group) {
  const auto& first = result.task.axes.front();
  const auto& last = result.task.axes.back();
  const std::size_t columns = last.values.size();
  const auto rows = spread(first.values.size(), kMostFamilies);
  Figure figure;
  const std::size_t panels = std::min(group.curves.size(), kMostPanels);
  figure.title = panels < group.curves.size()
                     ? fmt::format("{} ({} of {})", title, panels, group.curves.size())
                     : title;
  figure.width_px = 1100;
  if (panels > 4) figure.height_px = 900;
  std::vector<bool> row_is_drawn(rows.size());
  std::vector<bool> model_is_drawn(result.task.models.size());
  const std::size_t in_a_stack = panels > 2 ? (panels + 1) / 2 : panels;
  for (std::size_t k = 0; k < panels; ++k) {
    Panel panel;
    panel.title = fmt::format("{} {}", group.title, group.names[k]);
    panel.y = {.label = group.label, .unit = group.unit, .scale = scale_for({group.curves[k]})};
    for (std::size_t m = 0; m < result.task.models.size(); ++m) {
      for (std::size_t i = 0; i < rows.size(); ++i) {
        Style style = overlay_style(m);
        style.colour = formulation_colour(i);
        panel.series.push_back(series_of(in_words(result.task.models[m].name), last,
                                         group.curves[k][m], rows[i] * columns, style));
        if (!has_a_value(panel.series.back().y)) {
          panel.series.pop_back();
          continue;
        }
        row_is_drawn[i] = true;
        model_is_drawn[m] = true;
      }
    }
    if (k % in_a_stack == 0) {
      figure.stacks.push_back({.x = x_axis(last)});
    }
    figure.stacks.back().panels.push_back(std::move(panel));
  }
  if (!figure.stacks.empty()) {
    figure.stacks.back().blank_panels =
        static_cast<int>(in_a_stack * figure.stacks.size() - panels);
  }
  const std::string unit = axis_unit(first);
  figure.legend.push_back(
      {in_words(first.parameter.name) + (unit.empty() ? "" : fmt::format(" [{}]", unit)), {}});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!row_is_drawn[i]) continue;
    Style style;
    style.colour = formulation_colour(i);
    style.line_width_px = 3.0;
    figure.legend.push_back({fmt::format("{:.4g}", first.values[rows[i]]), style});
  }
  figure.legend.push_back({" ", {}});
  for (std::size_t m = 0; m < result.task.models.size(); ++m) {
    if (!model_is_drawn[m]) continue;
    figure.legend.push_back({in_words(result.task.models[m].name), overlay_style(m)});
    figure.legend.back().style->colour = grey;
  }
  return figure;
}

void draw(const SweepResult& result, const std::string& file, const std::string& title,
          const std::vector<Group>& groups, std::vector<NamedFigure>& plots) {
  if (result.task.axes.size() == 1) {
    if (std::ranges::any_of(groups, [](const Group& group) { return !group.curves.empty(); })) {
      plots.push_back({file, over_one(result, title, groups)});
    }
    return;
  }
  int drawn = 0;
  for (const Group& group : groups) {
    if (group.curves.empty()) continue;
    ++drawn;
    plots.push_back(
        {drawn == 1 ? file : fmt::format("{}-{}", file, drawn), over_two(result, title, group)});
  }
}

Group poles_group(const SweepResult& result) {
  Group group{"", "frequency", "Hz", {}, {}};
  for (const SweepCurve& curve : result.curves) {
    if (curve.family != compare::SweepFamily{}) continue;
    group.add(values_of(curve, [](auto s) { return std::abs(s) / kHz; }), curve.number);
  }
  return group;
}

/// Modulus and damping ratio of the poles with damping.
std::vector<Group> damped_groups(const SweepResult& result) {
  Group modulus{"", "|s|/2π", "Hz", {}, {}};
  Group damping{"", "damping ratio", "", {}, {}};
  for (const SweepCurve& curve : result.curves) {
    if (!curve.family.damped) continue;
    modulus.add(values_of(curve, [](auto s) { return std::abs(s) / kHz; }), curve.number);
    damping.add(values_of(curve, compare::damping_ratio), curve.number);
  }
  return {modulus, damping};
}

/// Zeros on the imaginary axis, and the others.
std::vector<Group> zeros_groups(const SweepResult& result, const arm::Sensor& sensor) {
  Group on{"", "frequency", "Hz", {}, {}};
  Group off{"off the imaginary axis", "|s|", "rad/s", {}, {}};
  for (const SweepCurve& curve : result.curves) {
    if (curve.family.zeros_of != sensor) continue;
    on.add(values_of(curve, [](auto s) { return s.real() == 0.0 ? s.imag() / kHz : kNothing; }),
           curve.number);
    off.add(values_of(curve, [](auto s) { return s.real() == 0.0 ? kNothing : std::abs(s); }),
            curve.number);
  }
  if (!off.curves.empty() && !on.curves.empty()) on.title = "on the imaginary axis";
  return {on, off};
}

Group modes_group(const compare::SweepTable& table, const char* label, const char* unit) {
  Group group{"", label, unit, {}, {}};
  if (table.empty()) return group;
  for (std::size_t k = 0; k < table.front().size(); ++k) {
    CurveValues values;
    for (const auto& of_model : table) values.push_back(of_model[k]);
    group.add(std::move(values), static_cast<int>(k) + 1);
  }
  return group;
}

/// In a family of curves each panel holds one mode: its title says which kind of number.
std::vector<Group> modes_groups(const SweepResult& result) {
  return {modes_group(result.modes.hub_slope, "hub slope", ""),
          modes_group(result.modes.tip_value_m, "end-point value", "m")};
}

}  // namespace

std::vector<NamedFigure> sweep_plots(const SweepResult& result) {
  const bool two = result.task.axes.size() > 1;
  std::vector<NamedFigure> plots;
  auto poles = poles_group(result);
  if (two) poles.title = "pole";
  draw(result, "poles", "Poles", {poles}, plots);
  auto damped = damped_groups(result);
  for (auto& group : damped) {
    if (two) group.title = "pole";
  }
  draw(result, "damped-poles", "Poles with damping", damped, plots);
  for (const auto& sensor : result.task.questions.sensors) {
    auto groups = zeros_groups(result, sensor);
    if (two) groups[0].title = "zero";
    if (two) groups[1].title = "off the imaginary axis: zero";
    draw(result, "zeros-" + arm::to_string(sensor), "Zeros of torque to " + sensor_label(sensor),
         groups, plots);
  }
  auto groups = modes_groups(result);
  for (auto& group : groups) {
    if (two) group.title = "mode";
  }
  draw(result, "modes", "Modes, modal mass I_T", groups, plots);
  return plots;
}

Figure paper_sweep_figure(const compare::PaperSweep& sweep, const SweepResult& result) {
  const auto& axis = result.task.axes.back();
  const Group group = sweep.zeros
                          ? zeros_groups(result, result.task.questions.sensors.front()).front()
                          : poles_group(result);
  Figure figure = over_one(result, sweep.title, {group});
  Panel& panel = figure.stacks.front().panels.front();
  panel.y.minimum = 0.0;
  Style limit_style;
  limit_style.colour = grey;
  limit_style.line = Line::dash_dotted;
  for (const auto& limit : sweep.limits) {
    panel.series.push_back(
        {limit.name, {axis.values.front(), axis.values.back()}, {limit.y, limit.y}, limit_style});
  }
  Style measured_style;
  measured_style.colour = kMeasuredColour;
  measured_style.line = Line::none;
  measured_style.marker = Marker::filled_diamond;
  for (const auto& mark : sweep.measured) {
    panel.series.push_back({mark.name, {mark.x}, {mark.y}, measured_style});
  }
  return figure;
}

}  // namespace flexarm::report
