#include "measured/spectra/periodic_spectra.hpp"

#include "arm/input_error.hpp"
#include "measured/files/record_constants.hpp"
#include "measured/spectra/fourier.hpp"
#include "measured/spectra/segment.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flexarm::measured {

namespace {

using Complex = std::complex<double>;

/// Least squares of a polynomial on the lines between three neighbouring ones of a periodic signal.
class LocalPolynomial {
 public:
  explicit LocalPolynomial(std::size_t periods) {
    const int degree = std::min(2, static_cast<int>(periods) - 2);
    const auto count = static_cast<Eigen::Index>(2 * (periods - 1));
    powers_.resize(count, degree + 1);
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto beside = static_cast<std::ptrdiff_t>(i) - static_cast<std::ptrdiff_t>(count) / 2;
      offsets_.push_back(beside < 0 ? beside : beside + 1);
      for (int power = 0; power <= degree; ++power) {
        powers_(i, power) =
            std::pow(static_cast<double>(offsets_.back()) / static_cast<double>(periods), power);
      }
    }
    inverse_ = powers_.completeOrthogonalDecomposition().pseudoInverse();
    degrees_of_freedom_ = static_cast<double>(count - degree - 1);
  }

  Eigen::Index lines() const { return powers_.rows(); }
  double degrees_of_freedom() const { return degrees_of_freedom_; }
  /// Variance of a line less the polynomial, over that of the line.
  double variance_factor() const { return 1.0 + inverse_.row(0).squaredNorm(); }

  /// The `lines()` around `line` of a transform.
  Eigen::VectorXcd around(const std::vector<Complex>& lines, std::size_t line) const {
    Eigen::VectorXcd values(static_cast<Eigen::Index>(offsets_.size()));
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      values(static_cast<Eigen::Index>(i)) =
          lines[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(line) + offsets_[i])];
    }
    return values;
  }
  /// By powers of the distance from the middle; the first is the value there.
  Eigen::VectorXcd coefficients(const Eigen::VectorXcd& around) const { return inverse_ * around; }
  Eigen::VectorXcd residual(const Eigen::VectorXcd& around,
                            const Eigen::VectorXcd& coefficients) const {
    return around - powers_ * coefficients;
  }

 private:
  std::vector<std::ptrdiff_t> offsets_;
  Eigen::MatrixXd powers_;
  Eigen::MatrixXd inverse_;
  double degrees_of_freedom_ = 0.0;
};

/// The signal's differences over the last `count` samples. Where the record begins with them, the
/// first differences are those of a period later: an error of a sample or two has a flat spectrum,
/// which is taken off with the transient.
std::vector<double> last_differences(const Signal& signal, std::size_t count,
                                     std::size_t period_samples) {
  const std::size_t first = signal.values.size() - count;
  const auto needed = static_cast<std::size_t>(signal.differences);
  const std::size_t missing = first < needed ? needed - first : 0;
  std::vector<double> values(count);
  copy_differenced(signal, first + missing, std::span(values).subspan(missing));
  for (std::size_t j = 0; j < missing && j + period_samples < count; ++j) {
    values[j] = values[j + period_samples];
  }
  return values;
}

double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Size of the values whose differences are taken, off which rounding comes.
double rounding_of(const Signal& signal, std::size_t count) {
  // The transform adds a few units in the last place of its root mean square.
  constexpr double kUnits = 16.0;
  const auto used = signal.values.last(count);
  return kUnits * std::numeric_limits<double>::epsilon() * root_mean_square(used) *
         std::sqrt(static_cast<double>(1 << (2 * signal.differences)));
}

}  // namespace

PeriodicSpectra periodic_spectra(const Signal& input, std::span<const Signal> outputs,
                                 double period_s, std::size_t period_samples, std::size_t periods) {
  constexpr std::size_t kFewestSamples = 4;
  if (period_samples < kFewestSamples) {
    throw arm::InputError(
        fmt::format("period = {} samples: must be {} or more", period_samples, kFewestSamples));
  }
  const std::size_t count = period_samples * periods;
  if (periods == 0 || count > input.values.size()) {
    throw arm::InputError(fmt::format("{} periods of {} samples: the record has only {} samples",
                                      periods, period_samples, input.values.size()));
  }
  PeriodicSpectra made;
  made.period_samples = period_samples;
  made.periods = periods;
  const std::size_t lines = period_samples / 2 - 1;
  const double period_length_s = static_cast<double>(period_samples) * period_s;
  for (std::size_t k = 1; k <= lines; ++k) {
    made.frequency_Hz.push_back(static_cast<double>(k) / period_length_s);
  }

  RealTransform transform(count);
  std::vector<Complex> spectrum(transform.lines());
  const bool has_noise = periods > 1;
  const LocalPolynomial local(std::max<std::size_t>(periods, 2));
  if (has_noise) made.degrees_of_freedom = local.degrees_of_freedom();
  const double to_amplitude = 2.0 / static_cast<double>(count);
  const double to_variance = local.variance_factor() / local.degrees_of_freedom();

  std::vector<Eigen::MatrixXcd> residuals;  // of each line, a column a signal
  if (has_noise) {
    residuals.assign(lines, Eigen::MatrixXcd(local.lines(), 1 + std::ssize(outputs)));
  }
  const auto read = [&](const Signal& signal, Eigen::Index column) {
    PeriodicSignal found;
    const auto values = last_differences(signal, count, period_samples);
    transform(values, spectrum);
    const double rounding = rounding_of(signal, count) * std::sqrt(2.0 * to_amplitude);
    for (std::size_t k = 1; k <= lines; ++k) {
      const Complex back = to_amplitude / difference_response(made.frequency_Hz[k - 1], period_s,
                                                              signal.differences);
      Complex value = spectrum[k * periods];
      double noise = kUnknown;
      if (has_noise) {
        const auto around = local.around(spectrum, k * periods);
        const auto polynomial = local.coefficients(around);
        value -= polynomial(0);
        auto residual = residuals[k - 1].col(column);
        residual = local.residual(around, polynomial) * back;
        noise = std::sqrt(residual.squaredNorm() * to_variance);
      }
      found.amplitude.push_back(value * back);
      found.noise_std.push_back(noise);
      found.rounding.push_back(rounding * std::abs(back) / to_amplitude);
    }
    return found;
  };
  made.input = read(input, 0);
  for (const auto& output : outputs) {
    made.outputs.push_back(read(output, 1 + std::ssize(made.outputs)));
  }
  for (const auto& residual : residuals) {
    made.noise_covariance.emplace_back(residual.adjoint() * residual * to_variance);
  }
  return made;
}

std::size_t unsettled_periods(std::span<const Signal> outputs, std::size_t period_samples,
                              std::size_t periods) {
  constexpr double kUnusual = 4.0;
  if (periods < 3) return 0;
  std::size_t leave_out = 0;
  const std::size_t most = periods - std::max<std::size_t>(2, (periods + 1) / 2);
  for (const auto& output : outputs) {
    const auto values = last_differences(output, period_samples * periods, period_samples);
    std::vector<double> change(periods - 1);
    for (std::size_t i = 0; i + 1 < periods; ++i) {
      const double* x = values.data() + i * period_samples;
      for (std::size_t j = 0; j < period_samples; ++j) {
        const double difference = x[j + period_samples] - x[j];
        change[i] += difference * difference;
      }
    }
    std::vector<double> later(change.end() - static_cast<std::ptrdiff_t>((change.size() + 1) / 2),
                              change.end());
    const auto middle = later.begin() + static_cast<std::ptrdiff_t>(later.size() / 2);
    std::nth_element(later.begin(), middle, later.end());
    std::size_t here = 0;
    while (here < most && change[here] > kUnusual * *middle) ++here;
    leave_out = std::max(leave_out, here);
  }
  return leave_out;
}

double probability_of_chance(const PeriodicSignal& signal, std::size_t line,
                             double degrees_of_freedom) {
  if (degrees_of_freedom == 0.0) return kUnknown;
  const double noise = std::max(signal.noise_std[line], signal.rounding[line]);
  const double power = std::norm(signal.amplitude[line]);
  if (power == 0.0) return 1.0;
  return std::pow(1.0 + power / (degrees_of_freedom * noise * noise), -degrees_of_freedom);
}

std::vector<bool> driven_lines(const PeriodicSpectra& spectra) {
  constexpr double kLeastAmplitude = 1e-3;
  constexpr double kSignificance = 1e-4;
  double largest = 0.0;
  for (const auto& amplitude : spectra.input.amplitude) {
    largest = std::max(largest, std::abs(amplitude));
  }
  std::vector<bool> driven(spectra.input.amplitude.size());
  for (std::size_t k = 0; k < driven.size(); ++k) {
    if (!(std::abs(spectra.input.amplitude[k]) > kLeastAmplitude * largest)) continue;
    // Few periods leave few degrees of freedom: there the size alone decides.
    constexpr double kEnoughFreedom = 3.0;
    driven[k] = spectra.degrees_of_freedom < kEnoughFreedom ||
                probability_of_chance(spectra.input, k, spectra.degrees_of_freedom) < kSignificance;
  }
  return driven;
}

}  // namespace flexarm::measured
