#pragma once

#include <string>
#include <vector>

namespace flexarm::report {

struct MarkPlace {
  double x = 0.0;
  double y = 0.0;
};

/// A text of a drawing and where it stands: labels of axes and ticks, titles, the legend.
struct TextMark {
  std::string text;
  MarkPlace place;
};

/// A curve, an area or a set of markers by its name.
struct CurveMark {
  std::string name;
  std::string colour;
  int pieces = 0;  ///< paths and polygons between gaps
  int markers = 0;
  /// The points farthest to the left, to the right, up and down.
  std::vector<MarkPlace> extremes;
};

/// What a reader reads off a drawing: not its pixels, nor its bytes.
struct SvgMarks {
  MarkPlace size;
  std::vector<TextMark> texts;
  std::vector<CurveMark> curves;
};

/// Of an SVG document as gnuplot writes it. Throws where it is not well-formed.
SvgMarks marks_of(const std::string& svg);

/// A line for each mark of `reference` that `drawn` does not have, and each that it has beside: a
/// text, a curve or its colour, its pieces, its markers, and places more than `tolerance` pixels
/// away.
std::vector<std::string> differences(const SvgMarks& drawn, const SvgMarks& reference,
                                     double tolerance);

}  // namespace flexarm::report
