#pragma once

#include "measured/modal/peaks.hpp"
#include "measured/spectra/spectrum_settings.hpp"

#include <optional>
#include <string>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// How spectra are estimated and their peaks read off; what is not given is chosen from the data.
struct SpectrumChoice {
  std::string window;
  std::optional<double> resolution_Hz;
  std::optional<double> overlap;
  std::string detrend;
  std::string peaks = "between";

  /// A window, resolution, overlap or trend makes segments of a periodic torque, too. Throws
  /// InputError.
  measured::SpectrumSettings settings() const;
  /// Throws InputError.
  measured::PeakPlace place() const;
};

/// Adds `--window`, `--resolution`, `--overlap`, `--detrend` and `--peaks`.
void add_spectrum_choice(CLI::App& parser, SpectrumChoice& choice);

}  // namespace flexarm::app
