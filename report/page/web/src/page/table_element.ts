import { leadingNumber, numberText } from "../axes/number_text";
import { type DataTable, withUnit } from "../document/data_table";
import { html } from "./element";

const kMostRows = 200;

/** Every how many-th row of a table is shown. */
function rowStep(table: DataTable): number {
  return Math.ceil(table.rowCount / kMostRows);
}

/** Says which rows are shown; empty: all. */
export function thinnedNote(table: DataTable): string {
  const step = rowStep(table);
  return step > 1 ? `Every ${step}th of ${table.rowCount} rows; the CSV file has all.` : "";
}

/** The rows of a data table in a frame that scrolls by itself. */
export function tableElement(table: DataTable, name: string): HTMLElement {
  const head = html("tr");
  for (const column of table.columns) {
    head.append(
      html("th", { scope: "col", class: column.numeric ? "number" : "" }, withUnit(column.title, column.unit)),
    );
  }
  const body = html("tbody");
  for (let row = 0; row < table.rowCount; row += rowStep(table)) {
    const line = html("tr");
    table.columns.forEach((column, i) => {
      const cell = table.cell(row, i);
      const text = typeof cell === "number" ? numberText(cell) : cell;
      line.append(html("td", { class: column.numeric ? "number" : "" }, text));
    });
    body.append(line);
  }
  if (table.rowCount === 0) {
    body.append(html("tr", {}, html("td", { colspan: Math.max(1, table.columns.length) }, "No data")));
  }
  return scrolling(html("table", {}, html("thead", {}, head), body), name);
}

/** A wide table scrolls in its frame, also by keyboard, and not with the page. */
export function scrolling(table: HTMLTableElement, name: string): HTMLElement {
  return html("div", { class: "scrolling", role: "region", tabindex: 0, "aria-label": name }, table);
}

/** Order of two cells: numbers by their value, before texts; texts as in a directory. */
export function compareCells(a: string, b: string, numeric: boolean): number {
  if (numeric) {
    const [x, y] = [leadingNumber(a), leadingNumber(b)];
    if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
    return x < y ? -1 : x > y ? 1 : 0;
  }
  return a.localeCompare(b, "en", { numeric: true });
}
