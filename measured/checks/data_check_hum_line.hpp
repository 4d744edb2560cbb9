#pragma once

#include <Eigen/Core>

#include <complex>
#include <cstddef>
#include <optional>
#include <vector>

namespace flexarm::measured {

/// Lines of a band about a frequency: a row a line, a column a function of time.
using BandLines = Eigen::MatrixXcd;

constexpr Eigen::Index kBandSide = 12;      ///< lines on either side
constexpr double kMainsTolerance_Hz = 0.1;  ///< of its frequency

/// The lines `centre_Hz` + L/duration of transforms under Hann's window, |L| <= 12, or fewer where
/// the band would reach 0 or half the sampling frequency.
class HumBand {
 public:
  HumBand(std::size_t samples, double period_s, double centre_Hz);

  bool is_usable() const;  ///< eight lines or more on either side
  Eigen::Index lines() const { return 2 * side_ + 1; }
  double centre_Hz() const { return centre_Hz_; }
  double duration_s() const { return static_cast<double>(samples_) * period_s_; }

  /// Lines of signals: a row a sample.
  BandLines of(const Eigen::MatrixXd& values) const { return exponentials_ * values; }

  /// Lines of half of t^p exp(i 2 pi f t), p = 0 to `most`, with t from -1 to 1 over the record.
  BandLines of_wave(double frequency_Hz, int most) const;

  /// Columns `factor` L^p, p = 0 to `degree`, with L from -1 to 1 over the band.
  void add_polynomial(int degree, const Eigen::VectorXcd& factor, BandLines& columns) const;

  /// Columns of a transient, 1 to L^2.
  BandLines transient() const;

 private:
  /// The band's first line [1/duration].
  double lowest_line() const {
    return centre_Hz_ * period_s_ * static_cast<double>(samples_) - static_cast<double>(side_);
  }
  /// A line of of_wave(frequency_Hz, 0), by the sum of the geometric series: a grid of frequencies
  /// over a long record takes no time by its samples.
  std::complex<double> windowed_wave(double frequency_Hz, Eigen::Index line) const;

  Eigen::Index samples_;
  double period_s_;
  double centre_Hz_;
  Eigen::Index side_ = 0;
  BandLines exponentials_;
};

/// A line of constant frequency in a signal.
struct HumLine {
  double frequency_Hz = 0.0;
  std::complex<double> amplitude;
  double error = 0.0;          ///< standard error of the amplitude
  std::complex<double> slope;  ///< of the amplitude, over half the record
  std::complex<double> bend;
  double change_error = 0.0;
  std::complex<double> gain;  ///< of the first signal beside it, at the band's centre

  double score() const { return error > 0.0 ? std::abs(amplitude) / error : 0.0; }

  /// Whether the amplitude changes by less than 0.25 of itself over half the record, beside three
  /// standard errors.
  bool is_constant() const;
};

/// Least squares of `target` by the columns of `wave`, one or three, and `others`. These begin with
/// the transient; the next column, if any, is that of a signal with degree 0.
HumLine fit_line(const Eigen::VectorXcd& target, const BandLines& others, const BandLines& wave,
                 double frequency_Hz);

/// Frequencies that are tried, and their lines.
struct HumGrid {
  double reach_Hz = 0.0;  ///< on either side of the band's centre
  std::vector<double> frequencies_Hz;
  std::vector<BandLines> waves;
};

/// 0.1 Hz or half a line on either side, in steps of half a line or less.
HumGrid hum_grid(const HumBand& band);

/// The line of most evidence on the grid with its frequency refined and its change over the record,
/// or none where it has less than four standard errors.
std::optional<HumLine> strongest_line(const HumBand& band, const HumGrid& grid,
                                      const Eigen::VectorXcd& target, const BandLines& others);

}  // namespace flexarm::measured
