#pragma once

#include "report/figures/figure.hpp"

#include <complex>
#include <string>
#include <vector>

namespace flexarm::report {

/// Marks that the whole locus shows besides the response.
struct NyquistMarks {
  bool minus_one = false;             ///< the point -1, in the unit of the response
  bool negative_frequencies = false;  ///< the response at -f, the conjugate of that at f
};

/// A response around one damped pole, and three points of its circle.
struct NyquistCircle {
  std::string label;  ///< above the panel: "pole 1: 11.86 Hz, ζ = 0.012"
  std::vector<std::complex<double>> values;
  std::complex<double> at_pole;
  std::complex<double> below;  ///< half a width of the peak below the pole's frequency
  std::complex<double> above;
};

struct NyquistPlot {
  std::string title;
  std::string unit;                            ///< of the response: "rad/(N m)"
  std::vector<std::complex<double>> response;  ///< over frequency, ascending
  std::vector<NyquistCircle> circles;          ///< the first four are drawn
  NyquistMarks marks = {};                     ///< of the whole locus
};

/// On the left the whole locus with its modulus on a scale that is linear near the origin and
/// logarithmic far out, so that angles are true and loops of any size show; dashed circles mark
/// decades of |G|. On the right a panel a pole, to scale, that holds its values, with the pole's
/// frequency and both half-power points marked. Throws std::invalid_argument when no
/// value is finite and not 0, or there is no circle.
Figure nyquist_figure(const NyquistPlot& plot);

}  // namespace flexarm::report
