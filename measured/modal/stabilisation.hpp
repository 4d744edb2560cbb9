#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace flexarm::measured {

/// A pole is stable at an order when the order before has one that differs by no more than these.
struct StabilisationTolerances {
  double frequency = 0.01;        ///< |f - f'| <= frequency f'
  double damping_ratio = 0.1;     ///< |zeta - zeta'| <= damping_ratio |zeta'| + undamped
  double undamped = 5e-4;         ///< zeta >= -undamped: poles without damping count
  double modal_assurance = 0.95;  ///< MAC of the residues over the sensors >= this
};

/// One pole of one order of a stabilisation chart.
struct ChartPole {
  int order = 0;  ///< degree of the denominator
  double frequency_Hz = 0.0;
  double damping_ratio = 0.0;
  bool frequency_stable = false;
  bool damping_stable = false;
  bool vector_stable = false;

  bool stable() const { return frequency_stable && damping_stable && vector_stable; }
  bool operator==(const ChartPole&) const = default;
};

/// Poles of the common denominator over its order: the arm's own stay where they are, those of
/// noise wander. Complex poles that are not unstable, within the band; one of each pair.
struct StabilisationChart {
  StabilisationTolerances tolerances;
  double from_Hz = 0.0;
  double to_Hz = 0.0;
  std::vector<int> orders;
  std::vector<ChartPole> poles;  ///< order by order, ascending in frequency

  bool operator==(const StabilisationChart&) const = default;
};

/// What one order has to offer.
struct OrderPoles {
  int order = 0;
  std::vector<std::complex<double>> s_rad_per_s;  ///< Im > 0
  Eigen::MatrixXcd residues;                      ///< sensors x poles, each column to any scale
};

StabilisationChart stabilisation_chart(const std::vector<OrderPoles>& orders, double from_Hz,
                                       double to_Hz, const StabilisationTolerances& tolerances);

/// A column of the chart: a pole that stays through several orders.
struct StablePole {
  double frequency_Hz = 0.0;  ///< as the highest of its orders has it
  double damping_ratio = 0.0;
  int orders = 0;  ///< at which it is stable
};

/// Those stable at `least_orders` orders or more, the most stable first.
std::vector<StablePole> stable_poles(const StabilisationChart& chart, int least_orders);

}  // namespace flexarm::measured
