#pragma once

#include "report/figures/figure.hpp"

#include <complex>
#include <span>
#include <string>
#include <vector>

namespace flexarm::report {

/// Poles and zeros of one transfer function by one formulation: all that are to be seen, mirror
/// images included.
struct PoleZeroSet {
  std::string formulation;
  std::vector<std::complex<double>> poles_rad_per_s;
  std::vector<std::complex<double>> zeros_rad_per_s;
  bool is_measured = false;  ///< drawn on top, in the colour of measurements
};

struct PoleZeroPlot {
  std::string title;
  std::vector<PoleZeroSet> sets;
};

/// Each root with its images -s, conj(s), -conj(s), none twice: the whole set of an undamped arm
/// from one of each pair or quadruple.
std::vector<std::complex<double>> with_mirror_images(
    std::span<const std::complex<double>> roots_rad_per_s);

/// The map of an s-plane over decades, and beside it a row for each formulation.
///
/// On the left the s-plane, square, both axes on the one scale sign(v) log10(1 + |v|/v0) with v0 a
/// third of the smallest root: near the origin linear, far out logarithmic. Formulations that agree
/// are concentric. On the right |s| of the roots nearer the imaginary axis, and below it of those
/// nearer the real axis, where there are any. Roots at 0 and roots that are not finite are left
/// out. Throws std::invalid_argument when no root is left.
Figure pole_zero_figure(const PoleZeroPlot& plot);

}  // namespace flexarm::report
