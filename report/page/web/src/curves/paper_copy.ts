import { html } from "../page/element.js";
import { kPaperWidth } from "../page/paper.js";

const kPaperScale = 2.5; // dots of the picture in one of these

/** A canvas as drawn by `draw` in the resolution of paper, shown in print alone. */
export function paperCopy(draw: (place: HTMLElement, width: number, scale: number) => void): HTMLElement {
  const drawing = html("div", { class: "drawing" });
  document.body.append(drawing);
  draw(drawing, kPaperWidth, kPaperScale);
  const copy = html("div", { class: "paper", "aria-hidden": "true" });
  const canvas = drawing.querySelector("canvas");
  if (canvas) copy.append(canvas);
  drawing.remove();
  return copy;
}
