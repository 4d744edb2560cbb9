#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace flexarm::response {

/// The instants k period, k = 0 to samples - 1, at which a torque is given.
struct SampleGrid {
  std::size_t samples = 0;
  double period_s = 0.0;

  double duration_s() const { return static_cast<double>(samples) * period_s; }
  double nyquist_Hz() const { return 0.5 / period_s; }
  /// k period; where a whole number of periods make a second, as k over that number, which is the
  /// nearest double to the decimal.
  double time_s(std::size_t k) const;
};

/// Pulses +amplitude, -amplitude of equal length, then zero: the input of the paper's Figure 20
/// (whose amplitude and times are not in print; these turn its arm by half a radian). Start and
/// pulse are rounded to whole samples, so that the two pulses cancel.
struct BangBang {
  double amplitude_N_m = 0.3;
  double pulse_s = 0.3;
  double start_s = 0.0;
  int pairs = 1;  ///< 0: as many as fit
};

/// Zero, then amplitude from the sample nearest to `start_s` on.
struct Step {
  double amplitude_N_m = 0.05;
  double start_s = 0.0;
};

/// Pseudo-random binary sequence, +amplitude or -amplitude: a maximum-length sequence of period
/// 2^register - 1 clocks, from the feedback shift register of that length. Each value is held for
/// one clock, rounded to whole samples. Its spectrum falls to half the power near 0.44/clock
/// [Ljung1999]. The seed sets where in the sequence it begins.
struct Prbs {
  double amplitude_N_m = 0.05;
  double clock_s = 0.005;
  int register_length = 9;  ///< 2 to kMostRegisterLength
  std::uint64_t seed = 1;
};
inline constexpr int kMostRegisterLength = 24;

/// offset + amplitude sin(2 pi frequency (t - start) + phase) from the sample nearest to `start_s`
/// on, zero before it.
struct Sine {
  double amplitude_N_m = 0.05;
  double frequency_Hz = 1.0;
  double offset_N_m = 0.0;
  double phase_rad = 0.0;
  double start_s = 0.0;
};

/// Normal noise of mean 0 whose spectrum is flat between two frequencies and zero outside: lines
/// 1/(duration) apart with normal real and imaginary parts, scaled so that the samples' root mean
/// square is `rms_N_m`. The duration is that of the record, or a little longer where its number of
/// samples has a prime factor above 5.
struct RandomNoise {
  double rms_N_m = 0.05;
  double from_Hz = 0.1;
  double to_Hz = 100.0;
  std::uint64_t seed = 1;
};

/// Random-phase odd multisine: sum over odd k of A cos(2 pi k t/period + phase_k), lines between
/// two frequencies, A = rms sqrt(2/lines), phases uniform. Odd lines leave the even ones free for
/// what even nonlinearities answer; of each `detection_group` lines next to each other one, drawn
/// at random, may be left out too, for the odd nonlinearities
/// [PintelonSchoukens2012].
struct Multisine {
  double rms_N_m = 0.05;
  double from_Hz = 0.1;
  double to_Hz = 100.0;
  double period_s = 0.0;    ///< rounded to whole samples; 0: the whole record
  int detection_group = 0;  ///< 0: no line is left out; else 2 or more
  std::uint64_t seed = 1;
};

enum class Sweep {
  linear,       ///< phase 2 pi (f0 t + (f1 - f0) t^2/(2 D))
  logarithmic,  ///< phase 2 pi f0 D/log(f1/f0) ((f1/f0)^(t/D) - 1)
};

/// amplitude sin(phase), from one frequency at the first sample to another at the record's end, D.
struct Chirp {
  double amplitude_N_m = 0.1;
  double from_Hz = 0.5;
  double to_Hz = 100.0;
  Sweep sweep = Sweep::logarithmic;
};

/// Steps of one size, each held for a dwell: up from 0 to `levels` times the size and down to 0
/// again, and so on to the end of the record. Start and dwell are rounded to whole samples.
struct Staircase {
  double amplitude_N_m = 0.05;  ///< of one step
  double dwell_s = 0.5;
  double start_s = 0.0;  ///< of the first step
  int levels = 3;
};

using Excitation =
    std::variant<BangBang, Step, RandomNoise, Multisine, Chirp, Staircase, Prbs, Sine>;

/// "bang-bang", "step", "random", "multisine", "chirp", "staircase", "prbs", "sine".
std::string_view name(const Excitation& excitation);

/// A torque, and the lines it is made of.
struct SampledTorque {
  std::vector<double> torque_N_m;    ///< one a sample
  std::vector<double> lines_Hz;      ///< of a multisine, ascending; else empty
  std::vector<double> detection_Hz;  ///< its odd lines in the band that were left out
};

/// The excitation with its times as `sample` takes them, in whole samples of `grid`; a time that is
/// whole samples to rounding stays as it is.
Excitation in_whole_samples(const Excitation& excitation, const SampleGrid& grid);

/// The torque at the samples of `grid`. Throws InputError for a grid of fewer than two samples, a
/// number out of its range, a band that holds no line or lies above half the sampling frequency, a
/// signal that does not fit into the record, and a multisine's period whose number of samples has
/// too large a prime factor to be transformed.
SampledTorque sample(const Excitation& excitation, const SampleGrid& grid);

/// Largest size [N m].
double peak_N_m(std::span<const double> torque_N_m);
/// Root mean square [N m].
double rms_N_m(std::span<const double> torque_N_m);
/// Peak over root mean square; 0 for a torque that is zero.
double crest_factor(std::span<const double> torque_N_m);

}  // namespace flexarm::response
