import { html } from "../page/element.js";

const kPaperWidth = 680; // px: the text width of A4 at 96 dots an inch
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
