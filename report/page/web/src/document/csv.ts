import { type DataTable, withUnit } from "./data_table.js";

const kAllDigits = 17;

/** Comma-separated values as of RFC 4180; a gap is an empty cell. */
export function csv(table: DataTable): string {
  const lines = [table.columns.map((column) => field(withUnit(column.title, column.unit))).join(",")];
  for (let row = 0; row < table.rowCount; ++row) {
    lines.push(
      table.columns
        .map((column, i) => {
          const cell = table.cell(row, i);
          return typeof cell === "string" ? field(cell) : plainNumber(cell, column.digits ?? kAllDigits);
        })
        .join(","),
    );
  }
  return lines.join("\r\n") + "\r\n";
}

function field(text: string): string {
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
}

function plainNumber(value: number, digits: number): string {
  if (!Number.isFinite(value)) return "";
  return String(digits >= kAllDigits ? value : Number(value.toPrecision(digits)));
}
