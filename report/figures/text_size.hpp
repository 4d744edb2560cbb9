#pragma once

#include "report/figures/figure.hpp"

#include <string>

namespace flexarm::report {

/// Lengths that follow from the size of a figure's font. Widths are estimates: the mean advance of
/// a broad sans-serif face.
struct TextSize {
  double font_px = kFontSize_px;

  double character_px() const { return 0.6 * font_px; }
  double line_px() const { return 1.3 * font_px; }
  /// From a point to the middle of a text above or below it, and to the end of one beside it.
  double above_px() const { return font_px; }
  double beside_px() const { return 0.85 * font_px; }
  double width_px(const std::string& text) const;  ///< of its longest line
  /// Of the title of the figure.
  TextSize of_title() const { return {1.23 * font_px}; }
  /// The text with a line feed for the blank before each word that would end beyond `width_px`.
  std::string wrapped(const std::string& text, double width_px) const;
};

/// Lines of a text, one at least.
int line_count(const std::string& text);

}  // namespace flexarm::report
