#include "tests/report/svg_marks.hpp"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <sstream>

namespace flexarm::report {
namespace {

using boost::property_tree::ptree;

std::string attribute(const ptree& element, const std::string& name) {
  return element.get<std::string>("<xmlattr>." + name, "");
}

/// The numbers of a list such as "M1,2 L3,4" or "translate(1,2)".
std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  const char* at = text.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      numbers.push_back(number);
      at = end;
    }
  }
  return numbers;
}

/// A curve while its group is read.
struct Points {
  CurveMark mark;
  std::vector<MarkPlace> places;

  void add(const std::vector<double>& numbers) {
    for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) {
      places.push_back({numbers[i], numbers[i + 1]});
    }
  }
  void add_colour(const std::string& colour) {
    if (mark.colour.empty()) mark.colour = colour;
  }
};

/// Paths, polygons and markers of a curve's group.
void read_curve(const ptree& tree, Points& points) {
  for (const auto& [name, child] : tree) {
    if (name == "path") {
      const std::string path = attribute(child, "d");
      points.mark.pieces += static_cast<int>(std::ranges::count(path, 'M'));
      points.add(numbers_in(path));
      points.add_colour(attribute(child, "stroke"));
    } else if (name == "polygon") {
      ++points.mark.pieces;
      points.add(numbers_in(attribute(child, "points")));
      points.add_colour(attribute(child, "fill"));
    } else if (name == "use") {
      ++points.mark.markers;
      auto place = numbers_in(attribute(child, "transform"));
      place.resize(std::min<std::size_t>(place.size(), 2));
      points.add(place);
      points.add_colour(attribute(child, "color"));
    }
    read_curve(child, points);
  }
}

std::vector<MarkPlace> extremes_of(const std::vector<MarkPlace>& places) {
  if (places.empty()) return {};
  const auto [left, right] = std::ranges::minmax_element(places, {}, &MarkPlace::x);
  const auto [up, down] = std::ranges::minmax_element(places, {}, &MarkPlace::y);
  return {*left, *right, *up, *down};
}

bool is_near(const MarkPlace& a, const MarkPlace& b, double tolerance) {
  return std::abs(a.x - b.x) <= tolerance && std::abs(a.y - b.y) <= tolerance;
}

/// `origin` is that of the innermost group that moves its content.
void read_group(const ptree& tree, const MarkPlace& origin, SvgMarks& marks) {
  for (const auto& [name, child] : tree) {
    if (name == "text") {
      // A text on a ground is written twice; a short tick has an empty one.
      const bool is_again = !marks.texts.empty() && marks.texts.back().text == child.data() &&
                            is_near(marks.texts.back().place, origin, 0.0);
      if (!child.data().empty() && !is_again) marks.texts.push_back({child.data(), origin});
    } else if (name == "g") {
      if (const auto title = child.get_optional<std::string>("title")) {
        Points points;
        points.mark.name = *title;
        read_curve(child, points);
        points.mark.extremes = extremes_of(points.places);
        marks.curves.push_back(std::move(points.mark));
        continue;
      }
      const auto move = numbers_in(attribute(child, "transform"));
      read_group(child, move.size() >= 2 ? MarkPlace{move[0], move[1]} : origin, marks);
    }
  }
}

std::string place_text(const MarkPlace& place) {
  return fmt::format("({:.0f}, {:.0f})", place.x, place.y);
}

std::string curve_text(const CurveMark& curve) {
  return fmt::format("\"{}\" {}, {} pieces, {} markers", curve.name, curve.colour, curve.pieces,
                     curve.markers);
}

/// Of curves that differ in a place or a count; empty where they do not.
std::string curve_difference(const CurveMark& drawn, const CurveMark& reference, double tolerance) {
  if (curve_text(drawn) != curve_text(reference)) {
    return fmt::format("curve {} instead of {}", curve_text(drawn), curve_text(reference));
  }
  for (std::size_t i = 0; i < std::min(drawn.extremes.size(), reference.extremes.size()); ++i) {
    // Of several points that lie equally far out another may be found: only that side counts.
    const bool is_upright = i >= 2;
    const double distance = is_upright ? drawn.extremes[i].y - reference.extremes[i].y
                                       : drawn.extremes[i].x - reference.extremes[i].x;
    if (std::abs(distance) <= tolerance) continue;
    return fmt::format("curve \"{}\" reaches {} instead of {}", reference.name,
                       place_text(drawn.extremes[i]), place_text(reference.extremes[i]));
  }
  // The place of the highest point along the axis: a peak that moves keeps its height.
  if (drawn.extremes.size() > 2 && reference.extremes.size() > 2 && drawn.pieces == 1 &&
      std::abs(drawn.extremes[2].x - reference.extremes[2].x) > tolerance) {
    return fmt::format("curve \"{}\" is highest at {} instead of {}", reference.name,
                       place_text(drawn.extremes[2]), place_text(reference.extremes[2]));
  }
  return "";
}

}  // namespace

SvgMarks marks_of(const std::string& svg) {
  std::istringstream stream(svg);
  ptree tree;
  read_xml(stream, tree);
  const ptree& root = tree.get_child("svg");
  SvgMarks marks;
  marks.size = {root.get<double>("<xmlattr>.width"), root.get<double>("<xmlattr>.height")};
  read_group(root, {}, marks);
  return marks;
}

std::vector<std::string> differences(const SvgMarks& drawn, const SvgMarks& reference,
                                     double tolerance) {
  std::vector<std::string> lines;
  if (!is_near(drawn.size, reference.size, 0.0)) {
    lines.push_back(
        fmt::format("size {} instead of {}", place_text(drawn.size), place_text(reference.size)));
  }
  std::vector<bool> is_found(drawn.texts.size());
  for (const TextMark& text : reference.texts) {
    bool found = false;
    for (std::size_t i = 0; i < drawn.texts.size() && !found; ++i) {
      found = !is_found[i] && drawn.texts[i].text == text.text &&
              is_near(drawn.texts[i].place, text.place, tolerance);
      if (found) is_found[i] = true;
    }
    if (!found) lines.push_back(fmt::format("no \"{}\" at {}", text.text, place_text(text.place)));
  }
  for (std::size_t i = 0; i < drawn.texts.size(); ++i) {
    if (is_found[i]) continue;
    lines.push_back(
        fmt::format("\"{}\" at {} is new", drawn.texts[i].text, place_text(drawn.texts[i].place)));
  }
  if (drawn.curves.size() != reference.curves.size()) {
    lines.push_back(
        fmt::format("{} curves instead of {}", drawn.curves.size(), reference.curves.size()));
    return lines;
  }
  for (std::size_t i = 0; i < drawn.curves.size(); ++i) {
    const std::string difference =
        curve_difference(drawn.curves[i], reference.curves[i], tolerance);
    if (!difference.empty()) lines.push_back(difference);
  }
  return lines;
}

}  // namespace flexarm::report
