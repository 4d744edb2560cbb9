import { leadingNumber } from "../axes/number_text.js";

/** Order of two cells: numbers by their value, before texts; texts as in a directory. */
export function compareCells(a: string, b: string, numeric: boolean): number {
  if (numeric) {
    const [x, y] = [leadingNumber(a), leadingNumber(b)];
    if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y));
    return x < y ? -1 : x > y ? 1 : 0;
  }
  return a.localeCompare(b, "en", { numeric: true });
}
