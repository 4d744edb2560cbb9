#pragma once

#include "compare/sweeps/sweep.hpp"

#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// What a curve is of.
struct SweepFamily {
  std::optional<arm::Sensor> zeros_of;  ///< empty: poles
  bool damped = false;                  ///< of poles: those of the damped arm

  /// Nothing changes the order of these roots.
  bool is_ordered() const;
  bool operator==(const SweepFamily&) const = default;
};

/// "poles", "damped poles", "hub_angle zeros".
std::string label(const SweepFamily& family);

/// One pole or zero over the whole grid.
struct SweepCurve {
  SweepFamily family;
  /// Undamped poles and zeros of collocated sensors: their order, which nothing changes, from 1.
  /// Damped poles: that of the undamped pole whose |s| is nearest where the grid begins; 0 the
  /// lowest one of a hub that is held or braked; then in the order in which they appear. Other
  /// zeros: from 1 in the order of |s| where the grid begins, then in that in which they appear.
  int number = 1;
  /// [model][point]: zeros as in arm::ZeroSet, of conjugate poles the upper; empty where there is
  /// none. Tracks are those of the first model; of another model the root nearest to the first
  /// one's is on its track (`match_nearest`).
  std::vector<std::vector<std::optional<std::complex<double>>>> s_rad_per_s;
};

/// -Re s/|s|: 1 for a real pole.
double damping_ratio(std::complex<double> s_rad_per_s);

/// [model][order][point], NaN where there is none.
using SweepTable = std::vector<std::vector<std::vector<double>>>;

/// What belongs to each undamped pole beside it. Empty where it was not asked for.
struct SweepModes {
  SweepTable hub_slope;
  SweepTable tip_value_m;  ///< phi(l)
};

/// In place of the number of a track.
inline constexpr int kNoTrack = -1;

/// Something that happens to a track, between two places of the last axis.
struct SweepEvent {
  enum class Kind {
    appears_beyond,  ///< comes from beyond the zeros asked for: from infinity, or from larger |s|
    leaves_beyond,   ///< goes there
    appears,         ///< begins among the others: the model has no root before
    vanishes,
    meet,       ///< two tracks meet on an axis and leave it: as a quadruple, as conjugate poles
    part,       ///< these return to an axis as two tracks
    ambiguous,  ///< which root follows which is not settled at the finest step
    seam,       ///< two rows whose tracks do not fit: a point around which tracks change places
  };
  Kind kind = Kind::appears;
  SweepFamily family;
  int track = kNoTrack;     ///< number of its curve; kNoTrack: no single one
  int other = kNoTrack;     ///< `meet`, `part`
  std::size_t row = 0;      ///< index along the first of two axes; 0 for one
  double from_value = 0.0;  ///< of the last axis
  double to_value = 0.0;
};

/// How far a model is from the first one in one kind of number, over the whole grid.
struct SweepAgreement {
  std::string quantity;  ///< "poles", "damped poles", "hub_angle zeros", "hub slopes"
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
  /// Poles, then those with damping where any point has some, then the zeros of each sensor.
  std::vector<SweepCurve> curves;
  SweepModes modes;
  std::vector<SweepEvent> events;
  std::vector<SweepAgreement> agreement;
  std::size_t further_evaluations = 0;  ///< between grid points, to follow tracks

  bool agrees() const;  ///< every model in every quantity
};

struct SweepTolerances {
  double roots = 1e-9;   ///< |ds|/|s| <= roots
  double shapes = 1e-7;  ///< of hub slopes and end-point values
};

/// Follows the roots from point to point, along the rows of the last axis on all cores, and links
/// the rows by their first column; holds every model against the first. Throws SweepInterrupted
/// when `run.stop` is set.
SweepResult assemble(const SweepTask& task, SweepValues values, const SweepRun& run,
                     const SweepTolerances& tolerances);

}  // namespace flexarm::compare
