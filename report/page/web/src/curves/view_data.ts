import type { CurvesBlock, CurvesView, Numbers, Series } from "../contract.js";
import { type Arrays, digitsOf } from "../document/arrays.js";
import type { DataTable } from "../document/data_table.js";
import { lowerBound } from "./curve.js";

interface Column {
  title: string;
  unit: string;
  digits: number;
  x: Float64Array;
  y: Float64Array;
}

/** The curves of a view as columns over x; a curve that has no sample at an x has an empty cell. Of an
 * envelope the least and greatest values of its finest buckets, at the first sample of each. */
export function viewData(block: CurvesBlock, view: CurvesView, arrays: Arrays): DataTable {
  const columns = view.panels.flatMap((panel) =>
    panel.series.flatMap((series) => seriesColumns(series, panel.y, arrays)),
  );
  const x = commonX(columns);
  return {
    columns: [
      { title: block.x.label, unit: block.x.unit, numeric: true, digits: 12 },
      ...columns.map(({ title, unit, digits }) => ({ title, unit, digits, numeric: true })),
    ],
    rowCount: x.length,
    cell: (row, column) => {
      const at = x[row] ?? NaN;
      if (column === 0) return at;
      const source = columns[column - 1];
      if (!source) return NaN;
      if (source.x === x) return source.y[row] ?? NaN;
      const i = lowerBound(source.x, at);
      return source.x[i] === at ? (source.y[i] ?? NaN) : NaN;
    },
  };
}

/** All views one below the other, behind columns that say which view a row is of. The columns of data
 * are those of all views, by title and unit. */
export function viewsData(block: CurvesBlock, arrays: Arrays): DataTable {
  const tables = block.views.map((view) => viewData(block, view, arrays));
  const key = (column: DataTable["columns"][number]) => `${column.title}\n${column.unit}`;
  const columns = [...new Map(tables.flatMap((table) => table.columns.map((column) => [key(column), column])))];
  const places = tables.map((table) => columns.map(([name]) => table.columns.findIndex((column) => key(column) === name)));
  const rows = tables.flatMap((table, i) => Array.from({ length: table.rowCount }, (_, row) => [i, row] as const));
  return {
    columns: [
      ...block.choices.map((title) => ({ title, unit: "", numeric: false })),
      ...columns.map(([, column]) => column),
    ],
    rowCount: rows.length,
    cell: (row, column) => {
      const [view, viewRow] = rows[row] ?? [0, 0];
      if (column < block.choices.length) return block.views[view]?.labels[column] ?? "";
      const place = places[view]?.[column - block.choices.length] ?? -1;
      return place < 0 ? NaN : (tables[view]?.cell(viewRow, place) ?? NaN);
    },
  };
}

function seriesColumns(series: Series, axis: { label: string; unit: string }, arrays: Arrays): Column[] {
  const { data } = series;
  const column = (suffix: string, x: Float64Array, y: Numbers): Column => ({
    title: `${axis.label}, ${series.label}${suffix}`,
    unit: axis.unit,
    digits: digitsOf(y),
    x,
    y: arrays.read(y),
  });
  if (data.kind === "samples") {
    const x = arrays.read(data.x);
    const columns = [column("", x, data.y)];
    if (data.y_std) columns.push(column(", standard deviation", x, data.y_std));
    return columns;
  }
  const finest = data.levels[0];
  if (!finest) return [];
  const x = arrays.read({
    start: data.x.start,
    step: data.x.step * finest.samples_per_bucket,
    count: finest.least.count,
  });
  return [column(", least", x, finest.least), column(", greatest", x, finest.greatest)];
}

/** The x of all columns; the array itself where all have the same. */
function commonX(columns: Column[]): Float64Array {
  const first = columns[0]?.x ?? new Float64Array();
  if (columns.every((column) => column.x === first)) return first;
  return Float64Array.from(new Set(columns.flatMap((column) => [...column.x]))).sort();
}
