#include "app/import_options.hpp"

#include "app/command.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_column_choice(CLI::App& parser, importing::ColumnChoice& choice) {
  parser
      .add_option("--column", choice.typed,
                  "QUANTITY=NAME:UNIT:SCALE: column NAME is time, torque or a sensor, SCALE times "
                  "its number in UNIT (default: that of the file), e.g. rpm:1/50 behind a gear. "
                  "Of a UNIT that the quantity does not have, V, SCALE is the conversion to SI. "
                  "NAME can be #3, the third column. Frequency responses: frequency=NAME:UNIT, "
                  "SENSOR.magnitude, .phase, .real, .imaginary, .coherence. Repeat for more "
                  "columns")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--compute", choice.computed,
                  "QUANTITY [UNIT]=EXPRESSION: a quantity computed from columns, e.g. "
                  "\"hub_velocity [deg/s]=6*[Speed (rpm)]\"; UNIT of the result, default SI; "
                  "names that are no plain words in brackets. Repeat for more")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--torque", choice.torque,
                  "Expression for the torque [N m], e.g. \"0.1574*(V - 0.518*omega)\"; as "
                  "--compute torque=EXPRESSION")
      ->check(not_empty());
  parser
      .add_option("--time-unit", choice.time_unit,
                  "Unit of the time column instead of that of the file: s, ms, us, ...")
      ->check(not_empty());
  parser
      .add_option("--reference", choice.reference,
                  "NAME:UNIT:SCALE: column NAME is the reference of --controller; default of UNIT "
                  "and SCALE: those of the sensor that the controller reads. A computed one: "
                  "--compute reference=EXPRESSION")
      ->check(not_empty());
  parser
      .add_option("--own-rate", choice.own_rate,
                  "QUANTITY=hold, linear or rows: what stands in the empty cells of a column that "
                  "was written at its own rate: the number above, the line over time, or nothing "
                  "(only rows with all numbers are read). Repeat for more")
      ->check(not_empty())
      ->allow_extra_args(false);
  parser
      .add_option("--leave-out", choice.left_out,
                  "Column that is not imported although its name tells a quantity. Repeat for more")
      ->check(not_empty())
      ->allow_extra_args(false);
}

void add_runs_choice(CLI::App& parser, importing::RunsChoice& choice) {
  parser.add_option("--id", choice.id, "Run id; default: file name");
  parser.add_option("--rows", choice.rows,
                    "Rows FROM:TO of the data, counted from 1; one end can be left out");
  parser.add_option("--times", choice.times, "Times FROM:TO [s], as in the file");
  parser
      .add_option("--run", choice.runs,
                  "ID=FROM:TO [s] or ID=rows:FROM:TO: a range of the file as a run of its own. "
                  "Repeat for more runs")
      ->allow_extra_args(false);
  parser.add_option("--decimate", choice.decimation,
                    "Every N-th sample, after a zero-phase low-pass of all signals; the torque "
                    "then has a first-order hold");
  parser
      .add_option("--clock", choice.clock,
                  "Uneven times: stamped (the samples were taken then, and are resampled) or even "
                  "(the stamps are late, the samples even)")
      ->capture_default_str();
  parser
      .add_option("--fill-gaps", choice.longest_filled_gap,
                  "Longest gap [samples] that is filled by interpolation; a longer one splits the "
                  "run")
      ->capture_default_str();
  parser.add_option("--purpose", choice.purpose, "Purpose of the runs: estimation or validation");
  parser
      .add_option("--validation", choice.validation,
                  "Id of a run for validation; the others are for estimation. Repeat for more")
      ->allow_extra_args(false);
  parser.add_option("--hold", choice.hold,
                    "Torque between samples: zero (zero-order hold, default) or first (first-order "
                    "hold, default after --decimate)");
  parser.add_option("--initial", choice.initial,
                    "Initial state: rest or free (unknown); default: rest, and free for a run that "
                    "does not begin where its file does");
  parser.add_option("--payload-mass", choice.payload_mass_kg,
                    "Payload mass [kg] of the runs instead of that of the arm");
  parser.add_option("--payload-inertia", choice.payload_inertia_kg_m2,
                    "Payload inertia about its centre of mass [kg m^2] of the runs");
}

void add_join_choice(CLI::App& parser, importing::JoinChoice& choice) {
  parser.add_flag("--join", choice.is_wanted,
                  "The files are one run, with some of its signals each; they are joined by time");
  parser
      .add_option("--join-grid", choice.grid,
                  "Times of the joined run: same (those of all files, which must agree), first "
                  "(those of the first file) or coarsest (those of the file with the longest "
                  "period); the others are resampled")
      ->capture_default_str();
}

}  // namespace flexarm::app
