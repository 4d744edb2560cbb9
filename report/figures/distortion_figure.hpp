#pragma once

#include "arm/sensor.hpp"
#include "measured/spectra/distortion.hpp"
#include "report/figures/figure.hpp"

#include <string>

namespace flexarm::report {

/// Amplitudes of the lines of a periodic output over frequency: those that the torque drives, the
/// odd and the even ones that it does not, and the noise of each. The legend says what the test of
/// each parity came to, with its level against the driven lines.
///
/// Throws std::invalid_argument for a channel without a positive amplitude.
Figure distortion_figure(const arm::Sensor& sensor, const measured::ChannelDistortion& channel,
                         const std::string& title = {}, Scale frequency_scale = Scale::linear);

}  // namespace flexarm::report
