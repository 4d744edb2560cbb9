import type { Block } from "../contract.js";
import { csv } from "../document/csv.js";
import type { DataTable } from "../document/data_table.js";
import { button, html } from "./element.js";
import { whenInView } from "./in_view.js";
import { tableElement, thinnedNote } from "./table_element.js";

/** What a kind of block puts into its frame. */
export interface BlockContent {
  element: HTMLElement;
  /** Called when the block comes into view for the first time. */
  draw?(): void;
  /** The data shown, named; several where the block has further views. */
  files(): { label: string; name: string; table(): DataTable }[];
  /** Calls back whenever other data are shown. */
  onChange?(callback: () => void): void;
  /** The block is its own table. */
  isTable?: boolean;
}

/** Title, caption, content, links to its data and the data as a table. */
export function blockFrame(block: Block, content: BlockContent, level: 2 | 3): HTMLElement {
  const frame = titledFrame(block, level);
  if (block.caption !== "") frame.append(html("p", { class: "caption" }, block.caption));
  frame.append(content.element, dataBar(block, content));
  whenInView(frame, () => {
    try {
      content.draw?.();
    } catch (error) {
      frame.append(failure(error));
    }
  });
  return frame;
}

/** A block whose data are damaged says so in its place; the rest of the page stays. */
export function failedFrame(block: Block, level: 2 | 3, error: unknown): HTMLElement {
  const frame = titledFrame(block, level);
  frame.append(failure(error));
  return frame;
}

function titledFrame(block: Block, level: 2 | 3): HTMLElement {
  const titleId = `${block.id}-title`;
  const frame = html("article", { id: block.id, class: `block ${block.kind}`, "aria-labelledby": titleId });
  frame.append(html(level === 2 ? "h2" : "h3", { id: titleId }, block.title));
  return frame;
}

function failure(error: unknown): HTMLElement {
  const reason = error instanceof Error ? error.message : String(error);
  return html("p", { class: "failure", role: "alert" }, `This block cannot be shown: ${reason}.`);
}

function dataBar(block: Block, content: BlockContent): HTMLElement {
  const bar = html("div", { class: "data-bar" });
  const links = html("span", { class: "links" });
  const showLinks = () => links.replaceChildren(...content.files().map((file) => csvLink(file, block)));
  showLinks();
  bar.append(links);
  if (content.isTable) return bar;

  const place = html("div", { class: "data-table", id: `${block.id}-data`, hidden: true });
  const toggle = button(
    "Table",
    { "aria-expanded": "false", "aria-controls": place.id, "aria-label": `Table of ${block.title}` },
    () => {
      const open = place.hidden;
      place.hidden = !open;
      toggle.setAttribute("aria-expanded", String(open));
      fillTable();
    },
  );
  const fillTable = () => {
    place.replaceChildren();
    const table = content.files()[0]?.table();
    if (place.hidden || table === undefined) return;
    const note = thinnedNote(table);
    if (note !== "") place.append(html("p", { class: "note" }, note));
    place.append(tableElement(table, `Data of ${block.title}`));
  };
  content.onChange?.(() => {
    showLinks();
    fillTable();
  });
  bar.append(toggle);
  return html("div", {}, bar, place);
}

function csvLink(file: ReturnType<BlockContent["files"]>[number], block: Block): HTMLAnchorElement {
  const link = html(
    "a",
    { href: `#${block.id}`, download: `${file.name}.csv`, "aria-label": `${file.label} of ${block.title}` },
    file.label,
  );
  // The file is made when it is asked for: of a long record it takes a moment and memory.
  link.addEventListener("click", () => {
    const address = URL.createObjectURL(new Blob([csv(file.table())], { type: "text/csv" }));
    link.href = address;
    setTimeout(() => {
      link.href = `#${block.id}`;
      URL.revokeObjectURL(address);
    }, 1000);
  });
  return link;
}
