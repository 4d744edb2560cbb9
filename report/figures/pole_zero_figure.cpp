#include "report/figures/pole_zero_figure.hpp"

#include "report/figures/logarithmic_ticks.hpp"
#include "report/figures/meaning.hpp"
#include "report/figures/overlay_style.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>

namespace flexarm::report {
namespace {

using Root = std::complex<double>;

constexpr int kPoleZeroWidth_px = 1100;
constexpr double kLinearPart = 1.0 / 3.0;  // v0 over the smallest root
constexpr double kFirstTick = 0.45;        // closer to the origin its label would touch "0"
constexpr double kPlaneMargin = 1.08;      // of the s-plane's half side
constexpr double kLargestPlain = 1e5;      // rad/s: ticks read 1000 rather than 10³ below it
constexpr double kLargestMarker = 1.4;     // relative to gnuplot's standard
constexpr double kMarkerStep = 0.45;       // by which each further formulation's is smaller
constexpr double kSmallestMarker = 0.5;
constexpr double kMeasuredMarker = 1.1;
constexpr double kDecadeRoom = 0.04;  // of the decades of |s|, so that no marker is cut
constexpr double kLeastRoom = 1.1;
constexpr double kOffRow = 0.12;  // poles above their row's line, zeros below: none hides another

bool is_root_shown(const Root& s) {
  return std::isfinite(std::abs(s)) && s != 0.0;
}

bool is_nearer_imaginary_axis(const Root& s) {
  return std::abs(s.imag()) >= std::abs(s.real());
}

int colour_of(const PoleZeroPlot& plot, std::size_t set) {
  return plot.sets[set].is_measured ? kMeasuredColour : formulation_colour(set);
}

/// Crosses for poles, circles for zeros.
Style root_style(bool pole, int colour, double size) {
  Style style;
  style.colour = colour;
  style.line = Line::none;
  style.marker = pole ? Marker::cross : Marker::circle;
  style.marker_size = size;
  style.line_width_px = 1.6;
  return style;
}

std::string series_name(const PoleZeroSet& set, bool pole) {
  return set.formulation + (pole ? ", poles" : ", zeros");
}

/// Calls visit(set index, is pole, roots) for each list of roots.
template <class Visit>
void for_each_list(const PoleZeroPlot& plot, Visit visit) {
  for (std::size_t i = 0; i < plot.sets.size(); ++i) {
    visit(i, true, plot.sets[i].poles_rad_per_s);
    visit(i, false, plot.sets[i].zeros_rad_per_s);
  }
}

/// The scale of both axes of the s-plane.
struct PlaneScale {
  double v0 = 1.0;

  double operator()(double v) const { return std::copysign(std::log10(1.0 + std::abs(v) / v0), v); }

  std::vector<Tick> ticks(double largest) const {
    const bool plain = v0 >= 1.0 && largest < kLargestPlain;
    std::vector<Tick> ticks{{0.0, "0"}};
    for (int exponent = static_cast<int>(std::floor(std::log10(v0)));
         std::pow(10.0, exponent) <= largest; ++exponent) {
      const double position = (*this)(std::pow(10.0, exponent));
      if (position < kFirstTick) continue;
      ticks.push_back({position, decade_label(exponent, plain)});
      ticks.insert(ticks.begin(), {-position, "−" + decade_label(exponent, plain)});
    }
    return ticks;
  }
};

PanelStack plane(const PoleZeroPlot& plot, double smallest, double largest) {
  const PlaneScale scale{smallest * kLinearPart};
  const double half_side = kPlaneMargin * scale(largest);
  const auto axis = [&](const char* label) {
    return Axis{.label = label,
                .unit = "rad/s",
                .minimum = -half_side,
                .maximum = half_side,
                .ticks = scale.ticks(largest * 1.2)};
  };
  Style axis_line;
  axis_line.colour = grey;
  axis_line.line_width_px = 0.8;
  Panel panel;
  panel.title = "s-plane";
  panel.y = axis("Im s");
  panel.series.push_back({"", {-half_side, half_side}, {0.0, 0.0}, axis_line});
  panel.series.push_back({"", {0.0, 0.0}, {-half_side, half_side}, axis_line});
  for_each_list(plot, [&](std::size_t set, bool pole, const std::vector<Root>& roots) {
    // Smaller for each further formulation.
    const double size =
        plot.sets[set].is_measured
            ? kMeasuredMarker
            : std::max(kSmallestMarker, kLargestMarker - kMarkerStep * static_cast<double>(set));
    Series series{
        series_name(plot.sets[set], pole), {}, {}, root_style(pole, colour_of(plot, set), size)};
    for (const Root& s : roots) {
      if (!is_root_shown(s)) continue;
      series.x.push_back(scale(s.real()));
      series.y.push_back(scale(s.imag()));
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  });
  return {.x = axis("Re s"), .panels = {panel}, .width = 1.5, .square = true};
}

/// |s| of the roots near one axis, a row for each formulation.
Panel rows(const PoleZeroPlot& plot, bool imaginary) {
  Panel panel;
  panel.title = imaginary ? "near the imaginary axis" : "near the real axis";
  panel.y.minimum = 0.4 - static_cast<double>(plot.sets.size());
  panel.y.maximum = 0.6;
  for_each_list(plot, [&](std::size_t set, bool pole, const std::vector<Root>& roots) {
    const double row = -static_cast<double>(set);
    if (pole) panel.y.ticks.push_back({row, plot.sets[set].formulation});
    Series series{
        series_name(plot.sets[set], pole), {}, {}, root_style(pole, colour_of(plot, set), 0.8)};
    for (const Root& s : roots) {
      if (!is_root_shown(s) || is_nearer_imaginary_axis(s) != imaginary) continue;
      series.x.push_back(std::abs(s));
      series.y.push_back(row + (pole ? kOffRow : -kOffRow));
    }
    if (!series.x.empty()) panel.series.push_back(std::move(series));
  });
  return panel;
}

}  // namespace

std::vector<Root> with_mirror_images(std::span<const Root> roots_rad_per_s) {
  std::vector<Root> all;
  for (const Root& s : roots_rad_per_s) {
    for (const Root& image : {s, -s, std::conj(s), -std::conj(s)}) {
      if (std::ranges::find(all, image) == all.end()) all.push_back(image);
    }
  }
  return all;
}

Figure pole_zero_figure(const PoleZeroPlot& plot) {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for_each_list(plot, [&](std::size_t, bool, const std::vector<Root>& roots) {
    for (const Root& s : roots) {
      if (!is_root_shown(s)) continue;
      smallest = std::min(smallest, std::abs(s));
      largest = std::max(largest, std::abs(s));
    }
  });
  if (largest == 0.0) {
    throw std::invalid_argument(fmt::format("\"{}\": no pole and no zero to draw", plot.title));
  }

  Figure figure;
  figure.title = plot.title;
  figure.width_px = kPoleZeroWidth_px;
  figure.stacks.push_back(plane(plot, smallest, largest));
  PanelStack strips;
  const double room = std::max(kLeastRoom, std::pow(largest / smallest, kDecadeRoom));
  strips.x = {.label = "|s|",
              .unit = "rad/s",
              .scale = Scale::logarithmic,
              .minimum = smallest / room,
              .maximum = largest * room};
  for (const bool imaginary : {true, false}) {
    Panel panel = rows(plot, imaginary);
    if (!panel.series.empty()) strips.panels.push_back(std::move(panel));
  }
  figure.stacks.push_back(std::move(strips));
  for (const bool pole : {true, false}) {
    const bool is_there = std::ranges::any_of(plot.sets, [&](const PoleZeroSet& set) {
      return std::ranges::any_of(pole ? set.poles_rad_per_s : set.zeros_rad_per_s, is_root_shown);
    });
    if (is_there) figure.legend.push_back({pole ? "pole" : "zero", root_style(pole, grey, 1.0)});
  }
  for (std::size_t i = 0; i < plot.sets.size(); ++i) {
    Style style;
    style.colour = colour_of(plot, i);
    style.line_width_px = 3.0;
    figure.legend.push_back({plot.sets[i].formulation, style});
  }
  return figure;
}

}  // namespace flexarm::report
