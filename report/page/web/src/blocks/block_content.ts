import type { Block } from "../contract";
import type { Arrays } from "../document/arrays";
import type { BlockContent } from "../page/block_frame";
import { html } from "../page/element";
import { tableBlock } from "./table_block";

export function blockContent(block: Block, _arrays: Arrays): BlockContent {
  switch (block.kind) {
    case "table":
      return tableBlock(block);
    default:
      return { element: html("p", {}, block.kind), files: () => [] };
  }
}
