import type { TableBlock } from "../contract.js";
import { withUnit } from "../document/data_table.js";
import type { BlockContent } from "../page/block_frame.js";
import { button, html } from "../page/element.js";
import { compareCells } from "../page/cells.js";
import { scrolling } from "../page/table_element.js";

type Direction = "ascending" | "descending";

/** A table that is sorted by the heads of its columns. */
export function tableBlock(block: TableBlock): BlockContent {
  const body = html("tbody");
  const order = block.rows.map((_, i) => i);
  const show = () => body.replaceChildren(...order.map((i) => rowElement(block, block.rows[i] ?? [])));
  show();
  if (block.rows.length === 0) {
    body.append(html("tr", {}, html("td", { colspan: Math.max(1, block.columns.length) }, "No rows")));
  }

  const heads = block.columns.map((column, i) => {
    const head = html("th", { scope: "col", class: column.numeric ? "number" : "" });
    const sort = () => {
      const direction: Direction =
        head.getAttribute("aria-sort") === "ascending" ? "descending" : "ascending";
      for (const other of heads) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", direction);
      const sign = direction === "ascending" ? 1 : -1;
      const cell = (row: number) => block.rows[row]?.[i] ?? "";
      order.sort((a, b) => sign * compareCells(cell(a), cell(b), column.numeric) || a - b);
      show();
    };
    head.append(button(withUnit(column.title, column.unit), { class: "sort" }, sort));
    return head;
  });
  const table = html("table", {}, html("thead", {}, html("tr", {}, ...heads)), body);
  return {
    element: scrolling(table, block.title),
    isTable: true,
    files: () => [
      {
        label: "CSV",
        name: block.id,
        table: () => ({
          columns: block.columns,
          rowCount: block.rows.length,
          cell: (row, column) => block.rows[row]?.[column] ?? "",
        }),
      },
    ],
  };
}

function rowElement(block: TableBlock, cells: string[]): HTMLTableRowElement {
  return html(
    "tr",
    {},
    ...block.columns.map((column, i) =>
      html(i === 0 ? "th" : "td", { scope: i === 0 ? "row" : undefined, class: column.numeric ? "number" : "" }, cells[i] ?? ""),
    ),
  );
}
