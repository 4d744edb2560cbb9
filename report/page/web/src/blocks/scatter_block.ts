import { quantityText } from "../axes/number_text.js";
import type { Axis, ScatterBlock, ScatterPanel } from "../contract.js";
import { colourName, kRoleStyles } from "../curves/role_style.js";
import { type Arrays, digitsOf } from "../document/arrays.js";
import type { DataTable } from "../document/data_table.js";
import type { BlockContent } from "../page/block_frame.js";
import { html, svg } from "../page/element.js";
import { factList } from "../page/facts.js";
import { attempted } from "../page/failure.js";
import { kHalfPaperWidth, kPaperWidth } from "../page/paper.js";
import { linearMap, logMap } from "../plane/axis_map.js";
import { Picker, type Pickable } from "../plane/picker.js";
import { Plane, type PlaneProjection } from "../plane/plane.js";
import { planeLegend } from "../plane/plane_legend.js";
import { keepDrawn, plotBox, resetButton } from "../plane/plot_box.js";
import { fileName } from "./file_name.js";
import { Speech } from "./speech.js";
import { viewChoice } from "./view_choice.js";

const kGrid = 1.5; // px within which points coincide
const kMostPicked = 3000; // points that keys and pointer go through

const kTwoColumnsFrom = 790; // px, as in style/blocks.css
const kBarHeight = 40; // of selectors, of a legend

function planeHeight(width: number, equalScales: boolean): number {
  return Math.round(Math.min(Math.max(280, width * 0.75), equalScales ? 520 : 400));
}

/** Points without an order along x. */
export function scatterBlock(block: ScatterBlock, arrays: Arrays): BlockContent {
  const hidden = new Set<string>();
  const speech = new Speech();
  const facts = html("div", { class: "view-facts" });
  const place = html("div", { class: "panels side" });
  let shown = 0;
  let changed = () => {};
  const draw = () => {
    const view = block.views[shown];
    facts.replaceChildren(factList(view?.facts ?? [], "inline-facts"));
    const panels = view?.panels ?? [];
    const paperWidth = panels.length > 1 ? kHalfPaperWidth : kPaperWidth;
    place.replaceChildren(...panels.map((panel) => panelElement(panel, block.title, arrays, hidden, speech, paperWidth)));
  };
  const choice = viewChoice(block.id, block.choices, block.views, (view) => {
    shown = view;
    attempted(element, draw);
    changed();
  });
  const empty = block.views.length === 0 ? html("p", { class: "note" }, "No data.") : undefined;
  const element = html("div", {}, html("div", { class: "view-bar" }, choice, facts), empty, place, speech.element);
  return {
    element,
    height: (width) => {
      const panels = block.views[0]?.panels ?? [];
      const rows = width < kTwoColumnsFrom ? panels.length : Math.ceil(panels.length / 2);
      return rows * (planeHeight(width, panels[0]?.equal_scales ?? false) + kBarHeight) + kBarHeight;
    },
    draw,
    files: () => {
      const view = block.views[shown];
      if (!view) return [];
      return [{ label: "CSV", name: fileName(block, view.labels), table: () => scatterTable(view.panels, arrays) }];
    },
    onChange: (callback) => {
      changed = callback;
    },
  };
}

function panelElement(
  panel: ScatterPanel,
  title: string,
  arrays: Arrays,
  hidden: Set<string>,
  speech: Speech,
  paperWidth: number,
): HTMLElement {
  const series = panel.series.map((one) => {
    const [x, y] = [arrays.read(one.x), arrays.read(one.y)];
    if (x.length !== y.length) throw new Error(`"${one.label}" has ${x.length} x and ${y.length} y`);
    return { ...one, xs: x, ys: y };
  });
  const isShown = (one: { label: string }) => !hidden.has(one.label);
  const reset = resetButton(() => plane.reset());
  const plane = new Plane({
    x: panel.x,
    y: panel.y,
    xMap: mapOf(panel.x),
    yMap: mapOf(panel.y),
    equalScales: panel.equal_scales,
    height: (width) => planeHeight(width, panel.equal_scales),
    onZoom: (isZoomed) => {
      reset.hidden = !isZoomed;
    },
    paint: (layer, to) => {
      for (const one of series) if (isShown(one)) layer.append(seriesPath(one, to));
      picker.showOn(layer, to);
    },
  });
  plane.setHome(flat(series.map((one) => one.xs)), flat(series.map((one) => one.ys)));
  const picker = new Picker(plane, (text) => speech.say(text));
  const setPoints = () => picker.setPoints(pickables(series.filter(isShown), panel));
  setPoints();
  const legend = planeLegend(
    series.map((one) => ({ name: one.label, role: one.role, shape: one.draw })),
    hidden,
    () => {
      setPoints();
      plane.draw();
    },
  );
  const box = plotBox(plane, picker, title);
  keepDrawn(plane, box, paperWidth);
  return html("div", { class: "panel" }, html("div", { class: "legend-bar" }, legend, reset), box);
}

interface Drawn {
  label: string;
  role: ScatterPanel["series"][number]["role"];
  draw: "line" | "points";
  xs: Float64Array;
  ys: Float64Array;
}

function seriesPath(one: Drawn, to: PlaneProjection): SVGPathElement {
  const parts: string[] = [];
  const taken = new Set<number>();
  let isJoined = false;
  for (let i = 0; i < one.xs.length; ++i) {
    const [x, y] = [to.x(one.xs[i] ?? NaN), to.y(one.ys[i] ?? NaN)];
    if (!Number.isFinite(x) || !Number.isFinite(y)) {
      isJoined = false;
      continue;
    }
    if (one.draw === "line") {
      parts.push(`${isJoined ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`);
      isJoined = true;
      continue;
    }
    // What lies on another point does not show: thousands of points stay a short path.
    if (x < to.left || x > to.right || y < to.top || y > to.bottom) continue;
    const cell = Math.round(x / kGrid) * 10000 + Math.round(y / kGrid);
    if (taken.has(cell)) continue;
    taken.add(cell);
    parts.push(`M${x.toFixed(1)} ${y.toFixed(1)}h0`);
  }
  const style = kRoleStyles[one.role];
  return svg("path", {
    d: parts.join(""),
    class: one.draw === "line" ? "curve" : "dots",
    stroke: `var(--${colourName(one.role)})`,
    "stroke-width": one.draw === "line" ? Math.max(style.width, 1.6) : undefined,
    "stroke-dasharray": one.draw === "line" && style.dash.length > 0 ? style.dash.join(" ") : undefined,
  });
}

function mapOf(axis: Axis) {
  return axis.scale === "log" ? logMap() : linearMap(axis);
}

function* flat(arrays: Float64Array[]): Iterable<number> {
  for (const array of arrays) yield* array;
}

function pickables(series: Drawn[], panel: ScatterPanel): Pickable[] {
  const total = series.reduce((sum, one) => sum + one.xs.length, 0);
  const step = Math.ceil(total / kMostPicked) || 1;
  const points: Pickable[] = [];
  for (const one of series) {
    for (let i = 0; i < one.xs.length; i += step) {
      const [x, y] = [one.xs[i] ?? NaN, one.ys[i] ?? NaN];
      if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
      const details = [
        { label: panel.x.label, value: quantityText(x, panel.x.unit) },
        { label: panel.y.label, value: quantityText(y, panel.y.unit) },
      ];
      points.push({ x, y, title: one.label, details });
    }
  }
  return points.sort((a, b) => a.x - b.x);
}

/** One point a row, behind the name of its series; panels with other axes have columns of their own. */
function scatterTable(panels: ScatterPanel[], arrays: Arrays): DataTable {
  const rows: { label: string; x: number; y: number; panel: number }[] = [];
  panels.forEach((panel, i) => {
    for (const one of panel.series) {
      const [x, y] = [arrays.read(one.x), arrays.read(one.y)];
      x.forEach((value, k) => rows.push({ label: one.label, x: value, y: y[k] ?? NaN, panel: i }));
    }
  });
  const columnsOf = (panel: ScatterPanel) => {
    const digits = Math.max(...panel.series.map((one) => digitsOf(one.y)), 1);
    return [panel.x, panel.y].map(({ label, unit }) => ({ title: label, unit, numeric: true, digits }));
  };
  return {
    columns: [{ title: "series", unit: "", numeric: false }, ...panels.flatMap(columnsOf)],
    rowCount: rows.length,
    cell: (row, column) => {
      const one = rows[row];
      if (!one || column === 0) return one?.label ?? "";
      if (Math.floor((column - 1) / 2) !== one.panel) return NaN;
      return column % 2 === 1 ? one.x : one.y;
    },
  };
}
