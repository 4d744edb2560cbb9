import { numberText } from "../axes/number_text.js";
import { type DataTable, withUnit } from "../document/data_table.js";
import { html } from "./element.js";

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
