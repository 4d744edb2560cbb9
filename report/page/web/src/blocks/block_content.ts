import type { Block } from "../contract";
import type { Arrays } from "../document/arrays";
import type { BlockContent } from "../page/block_frame";
import { curvesBlock } from "./curves_block";
import { mapBlock } from "./map_block";
import { rankingBlock } from "./ranking_block";
import { scatterBlock } from "./scatter_block";
import { sweepBlock } from "./sweep_block";
import { tableBlock } from "./table_block";

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
