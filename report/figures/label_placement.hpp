#pragma once

#include "report/figures/figure.hpp"
#include "report/figures/figure_layout.hpp"

namespace flexarm::report {

/// Moves annotations that stand above or below their points until none of them covers another
/// annotation of its panel or leaves it: further above or below by whole lines, up to four of them,
/// and to either side. Of such places it is the one that covers least of the panel's lines and
/// markers, the nearest of equals. The first annotations of a panel choose first; one that
/// has no place is taken away. Annotations at the ends of curves are moved up or down until none
/// covers another. Others stay where they are, and are kept clear of.
///
/// Text is taken to be as wide as `TextSize` says. Throws as `lay_out` does.
void place_labels(Figure& figure);

/// Where the text of an annotation stands, in pixels from the lower left corner of the figure.
struct TextBox {
  double left_px = 0.0;
  double right_px = 0.0;
  double bottom_px = 0.0;
  double top_px = 0.0;

  bool overlaps(const TextBox& other) const;
};

/// The box of an annotation in a panel.
TextBox text_box(const Annotation& annotation, const PanelBox& box, const Axis& x, const Axis& y);

}  // namespace flexarm::report
