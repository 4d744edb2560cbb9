/** What a block shows, as a table: for its CSV file and for those who do not see the plot. */
export interface DataTable {
  columns: { title: string; unit: string; numeric: boolean; digits?: number }[];
  rowCount: number;
  /** NaN: nothing there. */
  cell(row: number, column: number): number | string;
}

/** "title [unit]". */
export function withUnit(title: string, unit: string): string {
  return unit === "" ? title : `${title} [${unit}]`;
}
