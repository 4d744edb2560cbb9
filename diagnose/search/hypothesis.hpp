#pragma once

#include "arm/arm.hpp"
#include "diagnose/experiment.hpp"
#include "effects/registry/entry.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::diagnose {

using effects::Scales;
using effects::SearchedParameter;
using effects::Shows;

/// The scales of an experiment, for where effects are looked for.
Scales scales_of(const Experiment& experiment);

/// An effect as a possible cause: of the library, or a law that the arm file states.
struct Hypothesis {
  std::shared_ptr<const effects::Entry> entry = {};
  std::string effect = {};  ///< its name
  std::string sensor = {};  ///< the sensor it acts on, where it acts on one
  std::vector<SearchedParameter> parameters = {};
  std::map<std::string, double> known = {};  ///< of its other parameters
  /// Effects that are the same model, for which this one stands (`distinct`).
  std::vector<std::string> other_names = {};
  /// Whether the arm has an effect of its family for certain: a beam whose file states no
  /// dissipation has some.
  bool is_family_certain = false;

  /// "sensor_lag on tip_acceleration".
  std::string label() const;
  bool shows_in(measured::RunKind kind) const;
  /// At a limit of its parameters it becomes that effect: being more general is no rivalry.
  bool contains(const std::string& other_effect) const;
  /// Its parameters, each at the middle of its range.
  std::vector<double> middle() const;
  /// The parameter that gives the effect its size: the first with a value at which it does nothing.
  std::optional<std::size_t> size_parameter() const;
  /// Returns whether the size parameter of these values is at an end of its range at which the
  /// effect does something: data that ask for more than that ask for another effect.
  bool is_at_end_of_range(std::span<const double> values) const;
  /// The parameter that is a place along the beam: there is none where the effect does nothing.
  std::optional<std::size_t> place_parameter() const;
  /// Unit of a parameter; "1" for a plain number.
  std::string unit_of(const SearchedParameter& parameter) const;
};

/// Every cause that the experiment's arm may have and its data may show, in the order of
/// effects::entries(): not effects that the arm file already has, nor those that show in no kind of
/// its runs. Of an effect on one sensor, one for each sensor that is in such a run and that the
/// effect applies to. Behind them the arm's own hypotheses.
std::vector<Hypothesis> hypotheses(const Experiment& experiment);

/// `all` without those named in `excluded`: an effect by its name, with every sensor, or an effect
/// on one sensor by its label. A name of none of them changes nothing.
std::vector<Hypothesis> without(std::vector<Hypothesis> all,
                                const std::vector<std::string>& excluded);

/// `all` with one of those that are the same model (Entry::same_as), the others as its
/// `other_names`.
std::vector<Hypothesis> distinct(std::vector<Hypothesis> all);

/// The arm with the effect at these values, one a parameter; it is no hypothesis of that arm.
arm::Arm extended(const arm::Arm& arm, const Hypothesis& hypothesis,
                  std::span<const double> values);

}  // namespace flexarm::diagnose
