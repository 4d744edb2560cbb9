import type { Block } from "../contract.js";
import { csv } from "../document/csv.js";
import type { DataTable } from "../document/data_table.js";
import { blockWidth } from "./block_width.js";
import { button, html } from "./element.js";
import { attempted, failure } from "./failure.js";
import { whenInView } from "./in_view.js";
import { tableElement, thinnedNote } from "./table_element.js";

/** What a kind of block puts into its frame. */
export interface BlockContent {
  element: HTMLElement;
  /** Called when the block comes into view for the first time. */
  draw?(): void;
  /** About how high it is then. */
  height?(width: number): number;
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
  if (content.draw) {
    // Its height beforehand, so that a link to what is below leads there.
    content.element.style.minHeight = `${content.height?.(blockWidth()) ?? 0}px`;
    whenInView(frame, () => {
      content.element.style.minHeight = "";
      attempted(content.element, () => content.draw?.());
    });
  }
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

function dataBar(block: Block, content: BlockContent): HTMLElement {
  const bar = html("div", { class: "data-bar" });
  const links = html("span", { class: "links" });
  const showLinks = () => links.replaceChildren(...content.files().map((file) => csvLink(file, block, bar)));
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
      attempted(place, fillTable);
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
    attempted(place, fillTable);
  });
  bar.append(toggle);
  return html("div", {}, bar, place);
}

function csvLink(
  file: ReturnType<BlockContent["files"]>[number],
  block: Block,
  bar: HTMLElement,
): HTMLAnchorElement {
  const link = html(
    "a",
    { href: `#${block.id}`, download: `${file.name}.csv`, "aria-label": `${file.label} of ${block.title}` },
    file.label,
  );
  // The file is made when it is asked for: of a long record it takes a moment and memory.
  link.addEventListener("click", (event) => {
    let text = "";
    if (!attempted(bar, () => (text = csv(file.table())))) return event.preventDefault();
    const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
    link.href = address;
    setTimeout(() => {
      link.href = `#${block.id}`;
      URL.revokeObjectURL(address);
    }, 1000);
  });
  return link;
}
