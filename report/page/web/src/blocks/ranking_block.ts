import type { RankingBlock } from "../contract.js";
import type { BlockContent } from "../page/block_frame.js";
import { html, svg } from "../page/element.js";
import { factList } from "../page/facts.js";

/** Bars, each a whole by itself; the chosen ones are marked. */
export function rankingBlock(block: RankingBlock): BlockContent {
  const list = html("ol", { class: "ranking" });
  for (const item of block.items) {
    const share = Math.max(0, Math.min(1, item.share));
    const bar = svg(
      "svg",
      { class: "bar", viewBox: "0 0 100 10", preserveAspectRatio: "none", "aria-hidden": "true" },
      svg("rect", { width: 100, height: 10, class: "whole" }),
      svg("rect", { width: 100 * share, height: 10, class: "share" }),
    );
    const head = [
      html("span", { class: "name" }, item.label),
      item.chosen ? html("span", { class: "chosen" }, `✓ ${block.chosen_word}`) : undefined,
      html("span", { class: "value" }, item.value),
      bar,
    ];
    const element = html("li", { class: item.chosen ? "is-chosen" : "" });
    element.append(
      item.details.length > 0
        ? html("details", {}, html("summary", { class: "line" }, ...head), factList(item.details, "item-facts"))
        : html("div", { class: "line" }, ...head),
    );
    list.append(element);
  }
  const details = [...new Set(block.items.flatMap((item) => item.details.map((fact) => fact.label)))];
  return {
    element: block.items.length > 0 ? list : html("p", { class: "note" }, "No candidates."),
    files: () => [
      {
        label: "CSV",
        name: block.id,
        table: () => ({
          columns: [
            { title: "name", unit: "", numeric: false },
            { title: "bar", unit: "", numeric: true },
            { title: "value", unit: "", numeric: true },
            { title: block.chosen_word, unit: "", numeric: false },
            ...details.map((title) => ({ title, unit: "", numeric: false })),
          ],
          rowCount: block.items.length,
          cell: (row, column) => {
            const item = block.items[row];
            if (!item) return "";
            const head = [item.label, item.share, item.value, item.chosen ? "yes" : "no"];
            return head[column] ?? item.details.find((fact) => fact.label === details[column - head.length])?.value ?? "";
          },
        }),
      },
    ],
  };
}
