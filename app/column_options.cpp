#include "app/column_choice.hpp"
#include "app/command.hpp"

#include <CLI/CLI.hpp>

namespace flexarm::app {

void add_column_choice(CLI::App& parser, ColumnChoice& choice) {
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

}  // namespace flexarm::app
