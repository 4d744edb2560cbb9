#pragma once

#include "diagnose/experiment.hpp"
#include "diagnose/search/selection.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace flexarm::diagnose {

/// A rigid axis with friction and a bias, which its arm file may lack, under a sampled PD
/// controller.
struct Axis {
  double inertia_kg_m2 = 2.0;
  double viscous_N_m_s_per_rad = 4.0;
  double coulomb_N_m = 0.5;
  double bias_N_m = 0.2;
  /// Standard deviation of a torque that acts and nobody recorded; the controller's is about
  /// 1.5 N m.
  double unrecorded_N_m = 0.1;
  double duration_s = 12.0;
  /// A law of no name; of angle [rad] and velocity [rad/s], in N m.
  std::function<double(double, double)> unknown_N_m = {};
};
/// Nothing but a law that no hypothesis is, and a hundredth of a N m that nobody recorded.
Axis axis_with(std::function<double(double, double)> law_N_m);
inline constexpr double kAxisPeriod_s = 0.002;
inline constexpr double kAxisEncoder_rad = 2e-5;

/// The axis in its loop, by explicit steps of 20 microseconds: the encoder's counts, and dry
/// friction that holds where the rest of the torque is below it. With the reference, moves of cubic
/// polynomials.
measured::TimeRecord axis_record(const Axis& axis, std::uint64_t seed);

/// What made its torque.
arm::Controller axis_controller();

/// Two runs, one for validation, and a file that has the inertia alone.
Experiment axis_experiment(const Axis& axis = {});
/// The same with the controller stated.
Experiment axis_experiment_with_controller(const Axis& axis = {});

/// Viscous and dry friction, bias and what else an axis may have.
std::vector<Hypothesis> hypotheses_of_an_axis(const Experiment& experiment);

/// Expects that what was named is what Axis() has, each within this part of it. Published figures of
/// such an axis are met within 5 % (docs/diagnosis.md).
void expect_friction_and_bias(const Selection& selection, double within = 0.05);

}  // namespace flexarm::diagnose
