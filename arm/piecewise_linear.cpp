#include "arm/piecewise_linear.hpp"

#include <algorithm>
#include <utility>

namespace flexarm::arm {

PiecewiseLinear::PiecewiseLinear(double slope_below, std::vector<Corner> corners,
                                 double slope_above)
    : slope_below_(slope_below), corners_(std::move(corners)), slope_above_(slope_above) {}

double PiecewiseLinear::operator()(double x) const {
  const auto next = std::ranges::upper_bound(corners_, x, {}, &Corner::x);
  const Corner& anchor = next == corners_.begin() ? corners_.front() : *(next - 1);
  return anchor.y + slope(x) * (x - anchor.x);
}

double PiecewiseLinear::slope(double x) const {
  const auto next = std::ranges::upper_bound(corners_, x, {}, &Corner::x);
  if (next == corners_.begin()) return slope_below_;
  if (next == corners_.end()) return slope_above_;
  return (next->y - (next - 1)->y) / (next->x - (next - 1)->x);
}

std::vector<double> PiecewiseLinear::bends() const {
  std::vector<double> found;
  double below = slope_below_;
  for (const Corner& corner : corners_) {
    const double above = slope(corner.x);
    if (above != below) found.push_back(corner.x);
    below = above;
  }
  return found;
}

bool PiecewiseLinear::is_proportional() const {
  return bends().empty() && (*this)(0.0) == 0.0;
}

}  // namespace flexarm::arm
