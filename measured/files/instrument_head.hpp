#pragma once

#include "measured/files/delimited_line.hpp"
#include "measured/files/foreign_table.hpp"
#include "measured/files/sampling_settings.hpp"
#include "measured/files/text_lines.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::measured {

/// A header of oscilloscopes that count samples (Rigol): names, and the start and the period of the
/// samples in the same line or the one below, which has the units as well.
///
///     X,CH1,CH2,Start,Increment            CH1V,CH2V,t0 = -0.1,tInc = 2e-3
///     Sequence,Volt,Volt,0,2e-3
///
/// So are the keys of recorders (Yokogawa), a line each with a cell for each signal, in any order:
///
///     "TraceName","CH1","CH2"
///     "VUnit","V","V"
///     "HResolution",2e-3,2e-3
///     "HOffset",0,0
struct CountedHeader {
  std::vector<ForeignColumn> columns;  ///< names and units
  SamplingSettings settings;
  std::size_t head = 0;    ///< place of the line of names
  std::size_t behind = 0;  ///< place of the first line of samples
};

/// The header among `lines`; empty without one. Throws InputError for signals of unlike periods.
std::optional<CountedHeader> counted_header(std::span<const TextLine> lines, LineSplitter& splitter,
                                            char decimal);

/// Columns that hold settings beside the first samples (Tektronix): `Record Length,2500,,` and the
/// like in the first rows, empty cells below.
struct SettingsBeside {
  std::vector<std::size_t> columns;
  std::vector<std::string> sentences;  ///< on the units that they tell of the signals
};

/// Reads the settings beside the samples. The two columns behind them, a time and a signal, get
/// their names from these where `columns` has none, and the time its unit. The unit of the signal
/// is reported only: it is the instrument's, not the quantity's.
SettingsBeside settings_beside(std::span<const TextLine> rows, LineSplitter& splitter, char decimal,
                               std::vector<ForeignColumn>& columns);

}  // namespace flexarm::measured
