import type { CurvesBlock } from "../contract.js";
import { viewData, viewsData } from "../curves/view_data.js";
import { ViewPlot, viewHeight } from "../curves/view_plot.js";
import type { Arrays } from "../document/arrays.js";
import type { BlockContent } from "../page/block_frame.js";
import { button, html } from "../page/element.js";
import { factList } from "../page/facts.js";
import { attempted } from "../page/failure.js";
import { followKeys } from "../page/plot_input.js";
import { onPaper, onThemeChange } from "../page/theme.js";
import { fileName } from "./file_name.js";
import { Speech } from "./speech.js";
import { viewChoice } from "./view_choice.js";

const kBarHeight = 42; // of selectors and facts

/** Curves over a common x axis, one view at a time. */
export function curvesBlock(block: CurvesBlock, arrays: Arrays): BlockContent {
  const hidden = new Set<string>();
  const speech = new Speech();
  const readout = html("span", { class: "readout" });
  const reset = button("Whole range", { class: "reset", hidden: true }, () => plot?.reset());
  const facts = html("div", { class: "view-facts" });
  const place = html("div", {
    class: "plot",
    role: "application",
    tabindex: 0,
    "aria-label": `Plot: ${block.title}. Left and right arrows move the cursor, plus and minus zoom, Escape resets.`,
  });
  let shown = 0;
  let plot: ViewPlot | undefined;
  let changed = () => {};

  const draw = () => {
    const view = block.views[shown];
    if (!view) return;
    const range = plot?.chosen;
    plot?.destroy();
    plot = new ViewPlot(block, view, arrays, hidden, {
      cursor: (text, spoken) => {
        readout.textContent = text;
        if (spoken !== "") speech.say(spoken);
      },
      range: (isZoomed) => {
        reset.hidden = !isZoomed;
      },
    });
    place.replaceChildren(plot.element);
    facts.replaceChildren(factList(view.facts, "inline-facts"));
    plot.draw(place.clientWidth);
    if (range) plot.showRange(range);
  };
  followKeys(place, {
    zoom: (factor) => plot?.zoom(factor),
    pan: (x) => plot?.pan(x),
    reset: () => plot?.reset(),
    step: (steps, coarse, upright) => plot?.step(steps, coarse, upright),
    toEnd: (end) => plot?.toEnd(end),
  });
  const choice = viewChoice(block.id, block.choices, block.views, (view) => {
    shown = view;
    attempted(element, draw);
    changed();
  });
  const element = html(
    "div",
    {},
    html("div", { class: "view-bar" }, choice, facts, html("span", { class: "at-cursor" }, reset, readout)),
    block.views.length > 0 ? place : html("p", { class: "note" }, "No data."),
    speech.element,
  );
  return {
    element,
    height: (width) => (block.views[0] ? viewHeight(block, block.views[0], width) + kBarHeight : 0),
    draw: () => {
      draw();
      onThemeChange(() => plot?.redraw());
      onPaper((on) => plot?.forPaper(on));
      new ResizeObserver(() => {
        if (place.clientWidth > 0) plot?.draw(place.clientWidth);
      }).observe(place);
    },
    files: () => {
      const view = block.views[shown];
      if (!view) return [];
      const one = { label: "CSV", name: fileName(block, view.labels), table: () => viewData(block, view, arrays) };
      if (block.views.length === 1) return [one];
      return [one, { label: "CSV of all views", name: `${block.id}-all`, table: () => viewsData(block, arrays) }];
    },
    onChange: (callback) => {
      changed = callback;
    },
  };
}
