#include "app/spectrum_choice.hpp"

#include "app/word.hpp"
#include "arm/input_error.hpp"

#include <CLI/CLI.hpp>

#include <array>

namespace flexarm::app {

measured::SpectrumSettings SpectrumChoice::settings() const {
  measured::SpectrumSettings settings;
  if (!window.empty()) settings.window = measured::parse_window(window);
  if (!detrend.empty()) {
    settings.detrend = read_word(
        "--detrend", detrend,
        std::array{measured::Detrend::none, measured::Detrend::mean, measured::Detrend::line});
  }
  if (resolution_Hz && !(*resolution_Hz > 0.0)) {
    throw arm::out_of_range("--resolution", *resolution_Hz, "Hz", "above 0");
  }
  if (overlap && !(*overlap >= 0.0 && *overlap < 100.0)) {
    throw arm::out_of_range("--overlap", *overlap, "%", "0 or more and below 100");
  }
  settings.resolution_Hz = resolution_Hz;
  if (overlap) settings.overlap = *overlap / 100.0;
  if (settings.window || settings.detrend || resolution_Hz || overlap) settings.periodic = false;
  return settings;
}

measured::PeakPlace SpectrumChoice::place() const {
  if (peaks == "between") return measured::PeakPlace::resonance;
  if (peaks == "on-line") return measured::PeakPlace::on_line;
  throw arm::InputError(
      fmt::format("--peaks {}: must be between (interpolated) or on-line (as in the paper)",
                  arm::shown(peaks)));
}

void add_spectrum_choice(CLI::App& parser, SpectrumChoice& choice) {
  parser.add_option(
      "--window", choice.window,
      "Window of each segment: hann, rectangular, hamming, blackman or flat-top. Default for this "
      "and the next three options: chosen from the data; not used with a periodic torque");
  parser.add_option("--resolution", choice.resolution_Hz, "Spacing of spectral lines [Hz]");
  parser.add_option("--overlap", choice.overlap, "Overlap of segments [%]");
  parser.add_option("--detrend", choice.detrend, "Detrending of each segment: none, mean or line");
  parser
      .add_option(
          "--peaks", choice.peaks,
          "Location of extrema: between (interpolated) or on-line (nearest line, as in the paper)")
      ->capture_default_str();
}

}  // namespace flexarm::app
