import type { Role, SweepBlock } from "../contract.js";
import { type Arrays, digitsOf } from "../document/arrays.js";
import type { DataTable } from "../document/data_table.js";
import type { Mark } from "../plane/marks.js";

export interface Track {
  label: string;
  shape: Mark;
  role: Role;
  real: Float64Array;
  imaginary: Float64Array;
  frequency: Float64Array;
  digits: number;
}

const kInRightHalfPlane = 1e-9; // of the size of the root

/** A zero that is in the right half plane somewhere has the mark of one. */
export function readTracks(block: SweepBlock, arrays: Arrays): Track[] {
  const { length } = arrays.read(block.values);
  return block.tracks.map((track) => {
    const [real, imaginary, frequency] = [track.real, track.imaginary, track.frequency].map((numbers) => arrays.read(numbers));
    if (!real || !imaginary || !frequency || [real, imaginary, frequency].some((array) => array.length !== length)) {
      throw new Error(`"${track.label}" does not have ${length} values`);
    }
    const isRight = real.some((re, i) => re > kInRightHalfPlane * Math.hypot(re, imaginary[i] ?? 0));
    return {
      label: track.label,
      role: track.role,
      shape: track.mark === "zero" && isRight ? ("non_minimum_phase_zero" as const) : track.mark,
      real,
      imaginary,
      frequency,
      digits: digitsOf(track.real),
    };
  });
}

/** A value of the parameter a row, three columns a root. */
export function sweepTable(block: SweepBlock, values: Float64Array, tracks: Track[]): DataTable {
  const parts = [
    { axis: block.x, of: (track: Track) => track.real },
    { axis: block.y, of: (track: Track) => track.imaginary },
    { axis: block.frequency, of: (track: Track) => track.frequency },
  ];
  const columns = tracks.flatMap((track) =>
    parts.map(({ axis, of }) => ({
      title: `${track.label}, ${axis.label}`,
      unit: axis.unit,
      numeric: true,
      digits: track.digits,
      numbers: of(track),
    })),
  );
  return {
    columns: [{ title: block.parameter.label, unit: block.parameter.unit, numeric: true, digits: 12 }, ...columns],
    rowCount: values.length,
    cell: (row, column) => (column === 0 ? values[row] : columns[column - 1]?.numbers[row]) ?? NaN,
  };
}
