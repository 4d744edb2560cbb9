#pragma once

#include <vector>

namespace flexarm::arm {

/// A continuous function that is straight between corners: what the torque's path may do to a
/// torque without memory (gain, dead zone, saturation). Default: y = x.
class PiecewiseLinear {
 public:
  struct Corner {
    double x = 0.0;
    double y = 0.0;

    bool operator==(const Corner&) const = default;
  };

  PiecewiseLinear() = default;
  /// y = slope x.
  explicit PiecewiseLinear(double slope) : slope_below_(slope), slope_above_(slope) {}
  /// Through `corners`, one or more that ascend in x, with these slopes outside of them.
  PiecewiseLinear(double slope_below, std::vector<Corner> corners, double slope_above);

  double operator()(double x) const;

  /// Where it bends, ascending.
  std::vector<double> bends() const;
  /// y = slope x for every x.
  bool is_proportional() const;
  /// dy/dx at x; at a corner the one above it.
  double slope(double x) const;

  bool operator==(const PiecewiseLinear&) const = default;

 private:
  double slope_below_ = 1.0;
  std::vector<Corner> corners_ = {Corner{}};
  double slope_above_ = 1.0;
};

}  // namespace flexarm::arm
