#pragma once

#include "measured/files/atomic_file.hpp"
#include "report/figures/figure_files.hpp"
#include "report/figures/nyquist_figure.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}  // namespace CLI

namespace flexarm::app {

/// How the figures of `--out` are drawn.
struct FigureChoice {
  std::vector<std::string> formats;
  std::string size;
  std::string font;
  std::optional<double> font_size_pt;
  std::string magnitude;
  std::string frequency_unit;
  std::vector<std::string> nyquist;

  /// Throws arm::InputError for an option that has no such value, and for any of them where there
  /// is no `folder` for figures. Without gnuplot too, where there is one.
  void require_valid(const std::string& folder) const;
  report::FigureOptions options() const;
  report::NyquistMarks nyquist_marks() const;
  /// Adds the figures, drawn, to the files of a folder; `folder` is in it.
  void add_to(std::vector<measured::NamedContent>& files, const std::filesystem::path& folder,
              const std::vector<report::NamedFigure>& figures) const;
};

/// `--figure-format`, `--figure-size`, `--font`, `--font-size`, `--magnitude`, `--frequency-unit`
/// and `--nyquist`, in all commands that draw.
void add_figure_choice(CLI::App& parser, FigureChoice& choice);

}  // namespace flexarm::app
