#pragma once

#include "diagnose/diagnosis.hpp"
#include "report/page/page_document.hpp"

#include <vector>

namespace flexarm::report::page {

/// A map of poles and zeros for each sensor and payload of an experiment: measured ones, where the
/// residual analysis has them, those of the arm file and those of the extended arm (exact_tf,
/// linear effects). The lowest `kMostMapPoles` poles, or as many as were measured. No map for an
/// arm that cannot be computed.
std::vector<MapBlock> diagnosed_maps(const diagnose::Experiment& experiment,
                                     const diagnose::Diagnosis& diagnosis);
inline constexpr std::size_t kMostMapPoles = 8;

}  // namespace flexarm::report::page
