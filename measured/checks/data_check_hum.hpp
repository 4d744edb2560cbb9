#pragma once

#include "measured/checks/data_check.hpp"
#include "measured/checks/data_check_signal.hpp"

#include <span>
#include <vector>

namespace flexarm::measured {

/// Hum of the mains, 50 or 60 Hz within 0.1 Hz, or its alias below half the sampling frequency.
struct Hum {
  std::vector<DataFinding> findings;        ///< one a signal and frequency
  std::vector<std::vector<double>> values;  ///< of every signal, without the hum that was found
};

/// In the lines f + L/duration, |L| <= 12, of the transforms under Hann's window a channel X is
/// explained by the torque U, a transient and one line of the window's shape W:
///
///     X = (g0 + g1 L + g2 L^2 + g3 L^3) U + t0 + t1 L + t2 L^2 + (a W + b W1 + c W2)/2,
///
/// by least squares. W1 and W2 are those of lines whose amplitude grows with time and its square.
/// Hum: |a| > 8 standard errors and 0.03 standard deviations of the channel, and Re(b/a), |c/a|
/// below 0.25 beside their own errors, so that a resonance that rings or is driven is none. Im(b/a)
/// corrects f. The torque has no first term.
///
/// Beside a resonance, friction of the hub or pulses the gain of the torque is not that smooth. The
/// ratio to another channel Y is: it takes the place of the first term, with (d0 + d1 L) U beside
/// it. A line of 0.05 standard deviations is of X and not of Y if no other signal in the place of Y
/// explains it, and one at least explains the line that Y would have instead.
///
/// Hum of the torque is claimed only where it is not made of few levels or of other lines. It
/// stands out of the torque and no channel answers it, or several signals give it the same
/// amplitude: the torque's own a, and -a/g0 of channels. Where a torque is made of lines and has
/// one here, channels are compared with each other alone, likewise beside pulses.
Hum check_hum(std::span<const CheckedSignal> signals, const std::vector<bool>& usable,
              double period_s);

}  // namespace flexarm::measured
