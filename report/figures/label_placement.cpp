#include "report/figures/label_placement.hpp"

#include "report/figures/thinned_series.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace flexarm::report {
namespace {

constexpr double kRow = 1.15;  // text heights
/// Away from the point. Beside and beyond it, below 0, only where there is no other place.
constexpr std::array kRows{0, 1, 2, 3, 4, -1, -2};
constexpr double kAside_px = 6.0;
constexpr double kLineStep_px = 4.0;
constexpr double kMostLineSteps = 500.0;
constexpr double kSameEnd_px = 40.0;  // curves that end closer to each other, along the axis

struct Pixel {
  double x;
  double y;
};

/// From data to pixels of one panel, and back.
struct Map {
  const PanelBox& box;
  const Axis& x_axis;
  const Axis& y_axis;

  static double part(double value, const Range& range, const Axis& axis) {
    const double from = on_scale(range.from, axis);
    return (on_scale(value, axis) - from) / (on_scale(range.to, axis) - from);
  }
  static double value(double part, const Range& range, const Axis& axis) {
    const double from = on_scale(range.from, axis);
    return from_scale(from + part * (on_scale(range.to, axis) - from), axis);
  }
  double width_px() const { return box.right_px - box.left_px; }
  double height_px() const { return box.top_px - box.bottom_px; }
  double row_px() const { return kRow * box.text.font_px; }
  Pixel pixel(double x, double y) const {
    return {box.left_px + width_px() * part(x, box.x, x_axis),
            box.bottom_px + height_px() * part(y, box.y, y_axis)};
  }
  double x(double pixel) const { return value((pixel - box.left_px) / width_px(), box.x, x_axis); }
  double y(double pixel) const {
    return value((pixel - box.bottom_px) / height_px(), box.y, y_axis);
  }
};

/// Adds points along a straight line. One straight up, which stands for a frequency, is in nobody's
/// way.
void add_line(const Pixel& from, const Pixel& to, std::vector<Pixel>& points) {
  if (from.x == to.x) return;
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const int steps = static_cast<int>(std::min(length / kLineStep_px, kMostLineSteps));
  for (int k = 1; k <= steps; ++k) {
    const double part = k / (steps + 1.0);
    points.push_back({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)});
  }
}

/// Points along the panel's lines and at its markers.
std::vector<Pixel> obstacles(const Panel& panel, const Map& map) {
  std::vector<Pixel> points;
  for (const Series& series : panel.series) {
    if (series.style.filled) continue;
    const bool has_line = series.style.line != Line::none;
    const Series shown = thinned(series, map.x_axis, map.y_axis, map.box.x, map.width_px());
    bool joined = false;
    Pixel last{};
    for (std::size_t i = 0; i < shown.x.size(); ++i) {
      const bool drawn = is_drawable(shown, i, map.x_axis, map.y_axis);
      if (drawn) {
        const Pixel next = map.pixel(shown.x[i], shown.y[i]);
        if (joined && has_line) add_line(last, next, points);
        points.push_back(next);
        last = next;
      }
      joined = drawn;
    }
  }
  return points;
}

TextBox moved(TextBox box, double right_px, double up_px) {
  return {box.left_px + right_px, box.right_px + right_px, box.bottom_px + up_px,
          box.top_px + up_px};
}

/// How far to the right a text goes so that it stays within the panel.
double inwards_px(const TextBox& text, const PanelBox& box) {
  return std::max(0.0, box.left_px - text.left_px) + std::min(0.0, box.right_px - text.right_px);
}

/// The annotation at the best of its places, or none.
std::optional<Annotation> placed(const Annotation& label, const Map& map,
                                 const std::vector<TextBox>& taken,
                                 const std::vector<Pixel>& points) {
  const TextBox start = text_box(label, map.box, map.x_axis, map.y_axis);
  const double aside_px = 0.5 * (start.right_px - start.left_px) + kAside_px;
  const double direction = label.place == TextPlace::above ? 1.0 : -1.0;
  const Pixel at = map.pixel(label.x, label.y);
  std::optional<Annotation> best;
  std::ptrdiff_t fewest = 0;
  for (const int row : kRows) {
    const bool is_beside = row < 0;
    if (is_beside && best) break;
    for (const double side : {0.0, 1.0, -1.0}) {
      if (is_beside && side == 0.0) continue;
      const double up_px = direction * row * map.row_px();
      TextBox text = moved(start, side * aside_px, up_px);
      const double inwards = inwards_px(text, map.box);
      text = moved(text, inwards, 0.0);
      if (text.bottom_px < map.box.bottom_px || text.top_px > map.box.top_px + 0.5 * map.row_px() ||
          std::ranges::any_of(taken, [&](const TextBox& other) { return other.overlaps(text); })) {
        continue;
      }
      const auto covered = std::ranges::count_if(points, [&](const Pixel& point) {
        return TextBox{point.x, point.x, point.y, point.y}.overlaps(text);
      });
      if (best && covered >= fewest) continue;
      best = label;
      best->x = map.x(at.x + side * aside_px + inwards);
      best->y = map.y(at.y + up_px);
      fewest = covered;
    }
    if (best && fewest == 0) break;
  }
  return best;
}

bool is_movable(const Annotation& annotation) {
  return annotation.place == TextPlace::above || annotation.place == TextPlace::below;
}

/// Moves the labels at the ends of curves apart, up and down, as little as that takes: groups of
/// labels that would cover each other stand around the mean of their places.
void spread_ends(Panel& panel, const Map& map) {
  std::vector<Annotation*> ends;
  for (Annotation& annotation : panel.annotations) {
    if (annotation.place == TextPlace::end) ends.push_back(&annotation);
  }
  std::ranges::stable_sort(ends, {}, [&](const Annotation* end) {
    const Pixel at = map.pixel(end->x, end->y);
    return std::pair(std::round(at.x / kSameEnd_px), at.y);
  });
  struct Group {
    double middle_px;
    std::vector<Annotation*> labels;
  };
  std::vector<Group> groups;
  double column = 0.0;
  const auto half_px = [&](const Group& group) {
    return 0.5 * map.row_px() * static_cast<double>(group.labels.size());
  };
  const auto settle = [&] {
    for (const Group& group : groups) {
      double y_px = group.middle_px - half_px(group) + 0.5 * map.row_px();
      for (Annotation* label : group.labels) {
        label->y = map.y(y_px);
        y_px += map.row_px();
      }
    }
    groups.clear();
  };
  for (Annotation* label : ends) {
    const Pixel at = map.pixel(label->x, label->y);
    if (const double own = std::round(at.x / kSameEnd_px); groups.empty() || own != column) {
      settle();
      column = own;
    }
    groups.push_back({at.y, {label}});
    while (groups.size() > 1) {
      Group& upper = groups.back();
      Group& lower = groups[groups.size() - 2];
      if (upper.middle_px - half_px(upper) >= lower.middle_px + half_px(lower)) break;
      const auto n = static_cast<double>(lower.labels.size());
      const auto m = static_cast<double>(upper.labels.size());
      lower.middle_px = (n * lower.middle_px + m * upper.middle_px) / (n + m);
      lower.labels.insert(lower.labels.end(), upper.labels.begin(), upper.labels.end());
      groups.pop_back();
    }
  }
  settle();
}

}  // namespace

bool TextBox::overlaps(const TextBox& other) const {
  return left_px <= other.right_px && other.left_px <= right_px && bottom_px <= other.top_px &&
         other.bottom_px <= top_px;
}

TextBox text_box(const Annotation& annotation, const PanelBox& box, const Axis& x, const Axis& y) {
  const Pixel at = Map{box, x, y}.pixel(annotation.x, annotation.y);
  const double width_px = box.text.width_px(annotation.text);
  const double half_px = 0.5 * box.text.font_px;
  const TextBox centred{at.x - 0.5 * width_px, at.x + 0.5 * width_px, at.y - half_px,
                        at.y + half_px};
  switch (annotation.place) {
    case TextPlace::upper_right:
      break;
    case TextPlace::above:
      return moved(centred, 0.0, box.text.above_px());
    case TextPlace::below:
      return moved(centred, 0.0, -box.text.above_px());
    case TextPlace::centre:
      return centred;
    case TextPlace::left:
      return moved(centred, -0.5 * width_px - box.text.beside_px(), 0.0);
    case TextPlace::right:
    case TextPlace::end:
      return moved(centred, 0.5 * width_px + box.text.beside_px(), 0.0);
  }
  return moved(centred, 0.5 * width_px + half_px, half_px);
}

void place_labels(Figure& figure) {
  const FigureLayout layout = lay_out(figure);
  for (std::size_t s = 0; s < figure.stacks.size(); ++s) {
    for (std::size_t p = 0; p < figure.stacks[s].panels.size(); ++p) {
      Panel& panel = figure.stacks[s].panels[p];
      const PanelBox& box = layout.boxes[s][p];
      const Axis& x_axis = panel.x ? *panel.x : figure.stacks[s].x;
      const Map map{box, x_axis, panel.y};
      spread_ends(panel, map);
      if (std::ranges::none_of(panel.annotations, is_movable)) continue;
      const auto points = obstacles(panel, map);
      std::vector<TextBox> taken;
      for (const Annotation& fixed : panel.annotations) {
        if (!is_movable(fixed)) taken.push_back(text_box(fixed, box, x_axis, panel.y));
      }
      std::vector<Annotation> kept;
      for (const Annotation& label : panel.annotations) {
        const auto found = is_movable(label) ? placed(label, map, taken, points) : label;
        if (!found) continue;
        if (is_movable(label)) taken.push_back(text_box(*found, box, x_axis, panel.y));
        kept.push_back(*found);
      }
      panel.annotations = std::move(kept);
    }
  }
}

}  // namespace flexarm::report
