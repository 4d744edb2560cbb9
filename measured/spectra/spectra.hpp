#pragma once

#include "measured/files/time_record.hpp"
#include "measured/spectra/window.hpp"

#include <complex>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace flexarm::measured {

/// What is taken off each segment before it is windowed.
enum class Detrend {
  none,
  mean,
  line,  ///< the straight line of least squares
};

/// "none", "mean", "line".
std::string_view to_string(Detrend detrend);

/// How a record is cut into segments.
struct SegmentPlan {
  std::size_t segment_samples = 1024;
  std::size_t shift_samples = 512;  ///< from the start of a segment to that of the next
  Window window = Window::hann;
  Detrend detrend = Detrend::mean;
};

/// A signal whose spectra are asked for. Where it drifts, as an angle whose arm turns freely does,
/// it is differenced before it is windowed and its spectra are divided by the response of that,
/// (1 - exp(-i omega T))^differences, afterwards: a spectrum that falls as omega^-4 leaks from its
/// lowest lines into all others, its second difference is flat.
struct Signal {
  std::span<const double> values;
  int differences = 0;  ///< 0, 1 or 2
};

/// Mean spectra of windowed segments, one-sided: the mean square of a signal is the sum of its
/// power spectral density times the spacing of lines (Parseval; of windowed segments it is that of
/// the values weighted by w^2/mean w^2). Equations (43)-(44) of the paper.
struct CrossSpectra {
  std::vector<double> frequency_Hz;          ///< k fs/n, k = 0 to n/2
  std::vector<double> input;                 ///< S_xx [unit^2/Hz]
  std::vector<std::vector<double>> outputs;  ///< S_yy, one an output
  /// S_xy = mean of conj(X) Y, so that S_xy = H S_xx; one an output.
  std::vector<std::vector<std::complex<double>>> cross;
  std::vector<int> differences;  ///< of the outputs
  int input_differences = 0;
  std::size_t segments = 0;
  double effective_averages = 0.0;  ///< nd: measured/spectra/window.hpp
  double spacing_Hz = 0.0;          ///< of lines
  double noise_bandwidth_Hz = 0.0;  ///< of the window
};

/// Spectra of `input` and `outputs`, all of one length and sampled `period_s` apart, and the cross
/// spectra from input to each output. Of a differenced signal line 0 is NaN, of an even number of
/// samples a segment line n/2 stands for itself alone as line 0 does. One pass over the record, in
/// memory of a few segments.
///
/// Throws InputError for a record shorter than a segment (by two samples more where a signal is
/// differenced), a segment of fewer than 4 samples, a shift of 0 or more than a segment.
CrossSpectra cross_spectra(const Signal& input, std::span<const Signal> outputs, double period_s,
                           const SegmentPlan& plan);

/// Standard deviation of a mean power spectral density of random signals, relative to itself:
/// 1/sqrt(nd), and sqrt(2/nd) on lines 0 and n/2 (`is_real`), where one real number is all there is
/// [BendatPiersol2010].
double relative_autopower_std(double effective_averages, bool is_real = false);

/// The amplitude of the sine that would show this power spectral density at its line:
/// sqrt(2 S B) with the window's noise bandwidth B. In the signal's unit.
double sine_amplitude(double power_spectral_density, double noise_bandwidth_Hz);

/// (1 - exp(-2 pi i f T))^differences.
std::complex<double> difference_response(double frequency_Hz, double period_s, int differences);

/// How often a sensor is differenced: until the motion of a free arm under random torque no longer
/// drifts. 2 for angle and displacement, 1 for velocity, 0 for acceleration and for strain and
/// deflection, which do not show the rigid arm.
int differences_until_steady(const arm::Sensor& sensor);

}  // namespace flexarm::measured
