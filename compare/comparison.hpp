#pragma once

#include "arm/arm.hpp"
#include "arm/deadline.hpp"
#include "arm/sensor.hpp"
#include "compare/features.hpp"
#include "compare/finding.hpp"
#include "compare/refinement.hpp"
#include "compare/responses.hpp"
#include "compare/shapes.hpp"
#include "response/any_formulation.hpp"

#include <complex>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace flexarm::compare {

/// One model in a comparison. The first subject is the reference.
struct Subject {
  std::string name;      ///< "exact_tf"
  std::string settings;  ///< "4 elements of degree 11"; empty where there are none
  response::AnyFormulation formulation;
};

struct Options {
  int poles = 10;  ///< poles, collocated zeros and modes compared, 1 or more
  /// Zeros of each non-collocated sensor compared, 1 or more.
  int non_collocated_zeros = 6;
  /// Sensors whose zeros and responses are compared.
  std::vector<arm::Sensor> sensors = {{arm::SensorKind::hub_angle, 0.0},
                                      {arm::SensorKind::hub_velocity, 0.0},
                                      {arm::SensorKind::tip_acceleration, 0.0}};
  double root_tolerance = 1e-9;      ///< roots agree when |ds|/|s| <= root_tolerance
  double shape_tolerance = 1e-7;     ///< shapes agree when max |dphi|/max |phi| <= shape_tolerance
  double response_tolerance = 1e-7;  ///< responses agree when |dG|/|G| <= response_tolerance
  double wanted_accuracy = 1e-9;     ///< the cheapest setting reaches error <= wanted_accuracy
  bool refinements = true;           ///< run the refinement series
  arm::Deadline deadline = {};       ///< no further refinement is begun after it
  int response_points = 800;         ///< frequencies of each response, 2 or more
  /// Called after each step with the steps done and the steps there are.
  std::function<void(int done, int total)> progress;
};

/// One root: the reference's value, and what each subject has for it.
struct RootRow {
  FeatureFamily family;
  int order = 1;                                                 ///< from 1
  std::vector<std::optional<std::complex<double>>> s_rad_per_s;  ///< [subject]
  std::vector<double> distance;  ///< [subject], relative to the first; NaN where there is no root
  /// [subject], what the root and its conjugate or mirror image become with the arm's damping;
  /// empty where there is no root, or none was found. Without entries of an arm without damping.
  std::vector<std::optional<arm::PolePair>> damped = {};
};

/// What a subject says of one family beside its roots.
struct FamilyNote {
  std::string subject;
  FeatureFamily family;
  int found = 0;
  std::vector<arm::RejectedZero> rejected;
  int infinite = 0;
  arm::RootCount count;
};

/// Roots of the arm with its damping, both of each pair [rad/s].
struct DampedRoots {
  std::vector<std::complex<double>> poles_rad_per_s;
  std::vector<std::vector<std::complex<double>>> zeros_rad_per_s;  ///< [sensor of the responses]
};

struct Comparison {
  arm::Arm arm;
  std::vector<std::string> subjects;
  std::vector<std::string> settings;    ///< [subject]
  std::vector<int> degrees_of_freedom;  ///< [subject]
  std::vector<RootRow> roots;           ///< family by family, ascending
  std::vector<FamilyNote> notes;
  std::vector<DampedRoots> damped;  ///< [subject]; none of an arm without damping
  std::vector<double> stations_m;
  std::vector<std::vector<arm::Mode>> modes;  ///< [subject][order], displacements at stations_m
  std::vector<ShapeAgreement> shapes;         ///< of every subject but the first
  std::vector<ResponseComparison> responses;  ///< one a sensor
  double wanted_accuracy = 0.0;               ///< as in Options
  std::vector<RefinementCurve> refinements;
  bool are_refinements_complete = true;  ///< else the deadline ended the series
  std::vector<std::string> basis_notes;  ///< why a basis of assumed_modes is slow on this arm
  std::vector<Finding> findings;  ///< every pair of subjects in every root, shape and response
  Verdict verdict;
};

/// exact_tf, fem and assumed_modes of the arm with its linear effects, at settings fine enough for
/// `roots` roots.
std::vector<Subject> standard_subjects(const arm::Arm& arm, int roots);

/// Compares the standard subjects of an arm; its nonlinear, actuator and sensor effects are left
/// out, and `Comparison::arm` is the arm without them. Of an arm without a beam, of which all are
/// the same, there are no subjects, and nothing is compared. Throws InputError for an unusable arm,
/// sensor or option, and for more roots than response::kMostRoots.
Comparison compare(const arm::Arm& whole, const Options& options);

/// Compares any two or more models with each other (no refinement series). The arm of the first is
/// the comparison's.
Comparison compare(const std::vector<Subject>& subjects, const Options& options);

/// The families an option set asks for: poles, then the zeros of each sensor.
std::vector<FeatureFamily> families(const Options& options);

}  // namespace flexarm::compare
