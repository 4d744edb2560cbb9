#pragma once

#include "report/json/comparison_json.hpp"
#include "report/page/page_document.hpp"

#include <string>
#include <vector>

namespace flexarm::report::page {

/// One arm of a report, with its name among the choices of the views; empty where it is the only
/// one.
struct NamedArm {
  const ComparedArm* arm = nullptr;
  std::string name;
};

/// What the views of a block are chosen by: the arm, where there are several, and `others`.
std::vector<std::string> choices_of(const std::vector<NamedArm>& arms,
                                    std::vector<std::string> others);

/// A view of one arm; `labels` are those of the other choices.
CurvesView view_of(const NamedArm& arm, std::vector<std::string> labels,
                   std::vector<CurvesPanel> panels);

/// Frequency responses of every formulation, and the relative difference from the first one below;
/// a view an arm and sensor.
CurvesBlock comparison_responses(const std::vector<NamedArm>& arms);

/// Mode shapes of every formulation; a view an arm and mode.
CurvesBlock comparison_shapes(const std::vector<NamedArm>& arms);

/// Relative error over degrees of freedom of a few roots; a view for each arm, family of roots and
/// refinement. No views without a convergence study.
CurvesBlock comparison_convergence(const std::vector<NamedArm>& arms);

/// Poles and zeros of each sensor, measured ones beside every formulation's; a block a sensor.
std::vector<MapBlock> comparison_maps(const NamedArm& arm);

}  // namespace flexarm::report::page
