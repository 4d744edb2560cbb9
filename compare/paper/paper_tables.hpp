#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace flexarm::compare::paper {

/// A number as the paper prints it. `decimals` are the digits behind the point: the printed value
/// stands for any number within half a unit of the last one.
struct PrintedNumber {
  double value = 0.0;
  int decimals = 0;
};

/// True when `value`, rounded to the printed decimals, gives the printed number; a tie may go
/// either way.
bool rounds_to(double value, const PrintedNumber& printed);

/// Table 1, in the units printed.
struct ArmTable {
  double length_mm = 0.0;
  double thickness_mm = 0.0;
  double width_mm = 0.0;
  double density_kg_per_m3 = 0.0;
  double youngs_modulus_Pa = 0.0;
  double area_moment_m4 = 0.0;
  double hub_inertia_kg_m2 = 0.0;
  double beam_inertia_kg_m2 = 0.0;
};

/// One pair of cells of Tables 2-4: a measured frequency and its error.
struct FrequencyCell {
  int table = 0;
  std::string method;    ///< "autopower spectrum", "transfer function", "spectrum analyser"
  std::string location;  ///< "shaft encoder", ..., "average"
  std::string feature;   ///< "pole" or "zero"
  int order = 0;         ///< 1 or 2
  PrintedNumber analytical_Hz;
  std::optional<PrintedNumber> measured_Hz;  ///< empty: a dash in the paper
  std::optional<PrintedNumber> error_percent;
};

/// One cell of Table 5.
struct DampingCell {
  std::string location;
  int order = 0;
  PrintedNumber damping_ratio;
};

/// Tables 6 and 7, by mode; `gain` is the hub modal slope or the accelerometer's modal gain.
struct ModelTable {
  std::array<PrintedNumber, 2> zero_Hz;
  std::array<PrintedNumber, 2> pole_Hz;
  std::array<PrintedNumber, 2> gain;
  std::array<PrintedNumber, 2> damping_ratio;
};

/// Tables 1-7 as transcribed in data/paper.
struct Tables {
  ArmTable arm;                             ///< Table 1
  std::vector<FrequencyCell> frequencies;   ///< Tables 2-4, in the order of the files
  std::vector<DampingCell> damping_ratios;  ///< Table 5
  ModelTable hub_model;                     ///< Table 6
  ModelTable accelerometer_model;           ///< Table 7
};

/// Read once from the text built into the program; throws std::logic_error when that text is
/// damaged.
const Tables& tables();

/// The value in the heading of Tables 2-4: feature "pole" or "zero", order 1 or 2.
PrintedNumber analytical_Hz(const std::string& feature, int order);

}  // namespace flexarm::compare::paper
