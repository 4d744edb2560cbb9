#include "app/spectrum_choice.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_spectrum_choice(CLI::App& parser, compare::SpectrumRequest& choice) {
  parser.add_option(
      "--window", choice.window,
      "Window of each segment: hann, rectangular, hamming, blackman or flat-top. Default for this "
      "and the next three options: chosen from the data; not used with a periodic torque");
  parser.add_option("--resolution", choice.resolution_Hz, "Spacing of spectral lines [Hz]");
  parser.add_option("--overlap", choice.overlap_percent, "Overlap of segments [%]");
  parser.add_option("--detrend", choice.detrend, "Detrending of each segment: none, mean or line");
  parser
      .add_option(
          "--peaks", choice.peaks,
          "Location of extrema: between (interpolated) or on-line (nearest line, as in the paper)")
      ->capture_default_str();
}

}  // namespace flexarm::app
