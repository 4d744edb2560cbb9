#pragma once

#include "measured/modal/nyquist_circle.hpp"
#include "report/figures/figure.hpp"

#include <span>
#include <string>

namespace flexarm::report {

/// The measured points of each resonance in velocity form, (i omega)^(1 - derivatives) G, and the
/// circle through them, to scale, a panel a resonance and three panels a row. Marked with their
/// frequencies [Hz] are the points of the circle at the natural frequency and at half power,
/// f_n (sqrt(1 + zeta^2) -+ zeta). Of more than 500 points of a resonance every second, third, ...
/// is drawn.
///
/// Throws std::invalid_argument without a circle, or for one whose radius is not above 0.
Figure nyquist_circle_figure(const arm::Sensor& sensor,
                             std::span<const measured::NyquistCircle> circles,
                             const std::string& title = {});

}  // namespace flexarm::report
