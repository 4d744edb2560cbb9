#pragma once

#include "measured/files/frequency_record.hpp"
#include "measured/files/modal_table.hpp"
#include "measured/modal/circle_fit.hpp"

#include <complex>
#include <string>
#include <vector>

namespace flexarm::measured {

/// The circle that one mode draws in the Nyquist diagram, and the mode from it
/// ([KennedyPancu1947]; [Paper], section 6.2, Tables 4 and 5).
///
/// All is done in velocity form, V = (i omega)^(1 - derivatives of the sensor) G. There the
/// response of a mode with viscous damping,
///
///     V = r i omega/(omega_n^2 - omega^2 + 2 i zeta omega_n omega)
///       = r/(2 zeta omega_n)/(1 + i q),   q = (omega/omega_n - omega_n/omega)/(2 zeta),
///
/// is a circle exactly, through 0 and r/(2 zeta omega_n), and the angle at its centre from the
/// point at omega_n is -2 atan q. (In the form of displacement or acceleration it is one but for
/// terms of order zeta.) Other modes move the circle by what they add, which hardly varies over a
/// resonance: their slope remains as an error of order zeta omega_n |dV_rest/d omega|/|V| in
/// frequency ratio and damping ratio.
struct NyquistCircle {
  int order = 0;  ///< of the circles of a sensor, from 1
  Circle circle;  ///< of V
  /// By the least squares of angles, a + 2 atan q + angle_k = 0, in a, omega_n and zeta.
  double natural_frequency_Hz = 0.0;
  double natural_frequency_std_Hz = 0.0;  ///< from the scatter of the angles
  /// Where the angle changes fastest with log omega, by the points' own differences.
  double fastest_Hz = 0.0;
  /// Mean over pairs of one point below resonance and one above,
  /// 2 zeta = (p_above - p_below)/(tan(angle_below/2) + tan(angle_above/2)), p = omega/omega_n -
  /// omega_n/omega, half-power points among them; both angles between 30 and 150 degrees.
  double damping_ratio = 0.0;
  double damping_ratio_std = 0.0;  ///< scatter of the pairs: of one, not of their mean
  int pairs = 0;
  /// r of the displacement form G_0 = r/(omega_n^2 - omega^2 + ...): phi_i'(0) sigma_i/I_T,
  /// equation (48) of the paper; real but for the errors above.
  std::complex<double> modal_constant;
  std::vector<double> frequency_Hz;            ///< the points used
  std::vector<std::complex<double>> velocity;  ///< V at them
};

/// A resonance without a circle.
struct RefusedCircle {
  double frequency_Hz = 0.0;
  std::string reason;
};

struct CircleSettings {
  /// Resonances near these frequencies; empty: the peaks of |V| by measured/modal/peaks.hpp.
  std::vector<double> near_Hz;
  /// Points are used to this angle to both sides of the resonance [degrees].
  double half_arc_deg = 135.0;
  int fewest_points = 5;
};

struct CircleSet {
  std::vector<NyquistCircle> circles;  ///< ascending in frequency
  std::vector<RefusedCircle> refused;
};

/// The circles of a channel with finely spaced frequencies. A resonance is refused, with the
/// reason, where fewer than `fewest_points` lie on its arc, none on one side of it, or the points
/// are no circle (rms distance above a tenth of the radius).
CircleSet nyquist_circles(const FrequencyChannel& channel, const CircleSettings& settings = {});

/// The circles' poles as rows of a modal table.
ModalTable modal_table(const arm::Sensor& sensor, const std::vector<NyquistCircle>& circles);

}  // namespace flexarm::measured
