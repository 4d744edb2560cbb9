import type { Block } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import type { BlockContent } from "../page/block_frame.js";
import { curvesBlock } from "./curves_block.js";
import { mapBlock } from "./map_block.js";
import { rankingBlock } from "./ranking_block.js";
import { scatterBlock } from "./scatter_block.js";
import { sweepBlock } from "./sweep_block.js";
import { tableBlock } from "./table_block.js";

export function blockContent(block: Block, arrays: Arrays): BlockContent {
  switch (block.kind) {
    case "table":
      return tableBlock(block);
    case "curves":
      return curvesBlock(block, arrays);
    case "scatter":
      return scatterBlock(block, arrays);
    case "map":
      return mapBlock(block);
    case "ranking":
      return rankingBlock(block);
    case "sweep":
      return sweepBlock(block, arrays);
  }
}
