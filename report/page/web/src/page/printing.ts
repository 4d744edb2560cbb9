import { drawAll } from "./in_view.js";
import { setPrinting } from "./theme.js";

/** Paper gets what was not in view yet. */
export function followPrinting(): void {
  addEventListener("beforeprint", () => {
    drawAll();
    setPrinting(true);
  });
  addEventListener("afterprint", () => setPrinting(false));
}
