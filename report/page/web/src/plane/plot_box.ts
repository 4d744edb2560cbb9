import { button, html } from "../page/element.js";
import { followKeys } from "../page/plot_input.js";
import { onPaper } from "../page/theme.js";
import type { Picker } from "./picker.js";
import type { Plane } from "./plane.js";

/** A plane in a box that takes the focus: arrows go from point to point, with Shift they move the
 * view. */
export function plotBox(plane: Plane, picker: Picker | undefined, name: string): HTMLElement {
  const hint = picker ? "Arrows go from point to point, plus and minus zoom, Escape resets." : "Plus and minus zoom, arrows move, Escape resets.";
  const box = html(
    "div",
    { class: "plot", role: "application", tabindex: 0, "aria-label": `Plot: ${name}. ${hint}` },
    plane.element,
  );
  followKeys(box, {
    zoom: (factor) => plane.zoom(factor),
    pan: () => {},
    reset: () => {
      picker?.clear();
      plane.reset();
    },
    step: (steps, coarse, upright) => {
      if (picker && !coarse) picker.step(steps);
      else plane.pan(upright ? 0 : steps / 10, upright ? -steps / 10 : 0);
    },
    toEnd: (end) => picker?.toEnd(end),
  });
  return box;
}

/** Shown while a plane is zoomed. */
export function resetButton(onReset: () => void): HTMLButtonElement {
  return button("Whole range", { class: "reset", hidden: true }, onReset);
}

/** Draws a plane at first, whenever the width of its box changes, and in the width of paper. */
export function keepDrawn(plane: Plane, box: HTMLElement, paperWidth: number): void {
  new ResizeObserver(() => plane.draw()).observe(box);
  onPaper((on) => plane.draw(on ? paperWidth : undefined));
}
