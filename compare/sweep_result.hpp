#pragma once

#include "compare/finding.hpp"
#include "compare/sweep.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// One pole or zero over the whole grid.
struct SweepCurve {
  std::optional<arm::Sensor> zeros_of;  ///< empty: a pole
  /// Poles and zeros of collocated sensors: their order, which nothing changes. Zeros of the other
  /// sensors: the number of their track, in the order of |s| where the grid begins, then in that in
  /// which they appear. From 1.
  int number = 1;
  /// [model][point], as in arm::ZeroSet, poles undamped; empty where there is none. Tracks are
  /// those of the first model; another's root is on a track where it is taken for the first one's
  /// (`match`).
  std::vector<std::vector<std::optional<std::complex<double>>>> s_rad_per_s;
};

/// [model][order][point], NaN where there is none.
using SweepTable = std::vector<std::vector<std::vector<double>>>;

/// What belongs to each pole beside it. Empty where it was not asked for.
struct SweepModes {
  SweepTable hub_slope;
  SweepTable tip_value_m;  ///< phi(l)
  /// Of the damped poles s1, s2: -(s1 + s2)/(2 sqrt(s1 s2)), more than 1 for two real ones. Empty
  /// for an arm without damping anywhere on the grid, as is `damped_poles`.
  SweepTable damping_ratio;
  std::vector<std::vector<std::vector<std::optional<arm::PolePair>>>> damped_poles;
};

/// Something that happens to a track of zeros, between two places of the last axis.
struct SweepEvent {
  enum class Kind {
    appears_beyond,  ///< comes from beyond the zeros asked for: from infinity, or from larger |s|
    leaves_beyond,   ///< goes there
    appears,         ///< begins among the others: the model has no root before
    vanishes,
    meet,       ///< two tracks meet on an axis and leave it as a quadruple
    part,       ///< a quadruple returns to an axis as two tracks
    ambiguous,  ///< which root follows which is not settled at the finest step
    seam,       ///< two rows whose tracks do not fit: a point around which tracks change places
  };
  Kind kind = Kind::appears;
  arm::Sensor sensor;
  int track = 0;            ///< 0: no single one
  int other = 0;            ///< `meet`, `part`
  std::size_t row = 0;      ///< index along the first of two axes; 0 for one
  double from_value = 0.0;  ///< of the last axis
  double to_value = 0.0;
};

/// How far a model is from the first one in one kind of number, over the whole grid.
struct SweepAgreement {
  std::string quantity;  ///< "poles", "hub_angle zeros", "hub slopes", "end-point values"
  std::string model;
  double worst = 0.0;  ///< relative; hub slopes and end-point values to the largest of the point
  std::size_t worst_point = 0;
  int worst_number = 0;  ///< of the pole, mode or track
  double tolerance = 0.0;
  std::size_t compared = 0;
  std::size_t missing = 0;  ///< roots of the first model that this one does not have
  std::size_t first_missing_point = 0;

  bool agrees() const { return worst <= tolerance && missing == 0; }
};

struct SweepResult {
  SweepTask task;
  std::vector<int> degrees_of_freedom;  ///< [model]
  std::vector<SweepCurve> curves;       ///< poles, then the zeros of each sensor
  SweepModes modes;
  std::vector<SweepEvent> events;
  std::vector<SweepAgreement> agreement;
  std::size_t further_evaluations = 0;  ///< of zeros between grid points, to follow tracks

  bool agrees() const;  ///< every model in every quantity
};

struct SweepTolerances {
  double roots = 1e-9;   ///< |ds|/|s| <= roots
  double shapes = 1e-7;  ///< of hub slopes, end-point values and damping ratios
};

/// Follows the zeros from point to point, along the rows of the last axis on all cores, and links
/// the rows by their first column; holds every model against the first. Throws SweepInterrupted
/// when `run.stop` is set.
SweepResult assemble(const SweepTask& task, SweepValues values, const SweepRun& run,
                     const SweepTolerances& tolerances);

}  // namespace flexarm::compare
