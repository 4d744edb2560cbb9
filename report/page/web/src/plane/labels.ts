import { svg } from "../page/element.js";
import type { PlaneProjection } from "./plane.js";

export interface Label {
  x: number; // px
  y: number;
  text: string;
}

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const kLetter = 6.3; // px: width of a letter of 11 px, on the safe side
const kHeight = 12;
const kDistance = 9; // from the point to its label
const kMostLabels = 60;

/** Texts beside their points where they cover no point and no other text; the rest is left out, and
 * appears when the plane is zoomed. */
export function placeLabels(layer: SVGGElement, labels: Label[], to: PlaneProjection): void {
  const taken: Box[] = labels.map(({ x, y }) => ({ left: x - 5, right: x + 5, top: y - 5, bottom: y + 5 }));
  const isFree = (box: Box) =>
    box.left >= to.left &&
    box.right <= to.right &&
    box.top >= to.top &&
    box.bottom <= to.bottom &&
    !taken.some((other) => box.left < other.right && box.right > other.left && box.top < other.bottom && box.bottom > other.top);
  let placed = 0;
  for (const { x, y, text } of labels) {
    if (placed >= kMostLabels) break;
    const width = text.length * kLetter;
    // Obliquely first: bars of standard deviations go along the axes.
    const rows = [y - kHeight - 3, y + 3, y - kHeight / 2];
    const boxes = rows.flatMap((top) =>
      [x + kDistance, x - kDistance - width].map((left) => ({ left, right: left + width, top, bottom: top + kHeight })),
    );
    const box = boxes.find(isFree);
    if (!box) continue;
    taken.push(box);
    ++placed;
    layer.append(svg("text", { x: box.left, y: box.bottom - 2, class: "point-label" }, text));
  }
}
