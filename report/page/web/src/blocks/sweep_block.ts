import { numberText, quantityText } from "../axes/number_text.js";
import type { SweepBlock } from "../contract.js";
import { colourName, kRoleStyles } from "../curves/role_style.js";
import type { Arrays } from "../document/arrays.js";
import { withUnit } from "../document/data_table.js";
import type { BlockContent } from "../page/block_frame.js";
import { html, svg } from "../page/element.js";
import { kHalfPaperWidth } from "../page/paper.js";
import { linearMap, logMap, signedLogMap } from "../plane/axis_map.js";
import { markPath } from "../plane/marks.js";
import { Plane, type PlaneProjection } from "../plane/plane.js";
import { planeLegend } from "../plane/plane_legend.js";
import { keepDrawn, plotBox, resetButton } from "../plane/plot_box.js";
import { readTracks, sweepTable, type Track } from "./sweep_tracks.js";

const kMarkSize = 5.5; // px

const kTwoColumnsFrom = 790; // px, as in style/blocks.css
const kBarsHeight = 170; // of slider, events and legend

function planeHeight(width: number): number {
  return Math.round(Math.min(Math.max(300, width * 0.85), 460));
}

/** Poles and zeros over a parameter: their way in the s plane and their frequencies, with a slider. */
export function sweepBlock(block: SweepBlock, arrays: Arrays): BlockContent {
  const values = arrays.read(block.values);
  const tracks = readTracks(block, arrays);
  const hidden = new Set<string>();
  const shown = () => tracks.filter((track) => !hidden.has(track.label));
  let at = 0;

  const readout = html("output", { class: "readout" });
  const slider = html("input", {
    type: "range",
    id: `${block.id}-slider`,
    min: 0,
    max: Math.max(0, values.length - 1),
    step: 1,
    value: 0,
  });
  const eventNote = html("p", { class: "event", role: "status" });
  const planes: Plane[] = [];
  const drawPlanes = () => {
    for (const plane of planes) plane.draw();
  };
  const moveTo = (index: number) => {
    at = Math.max(0, Math.min(values.length - 1, index));
    const text = quantityText(values[at] ?? NaN, block.parameter.unit);
    slider.value = String(at);
    slider.setAttribute("aria-valuetext", text);
    readout.textContent = text;
    const event = block.events.find(({ value }) => nearestIndex(values, value) === at);
    const said = event?.text ?? "";
    if (eventNote.textContent !== said) eventNote.textContent = said;
    drawPlanes();
  };
  slider.addEventListener("input", () => moveTo(Number(slider.value)));

  const resets = [0, 1].map((i) => resetButton(() => planes[i]?.reset()));
  const onZoom = (i: number) => (isZoomed: boolean) => {
    const reset = resets[i];
    if (reset) reset.hidden = !isZoomed;
  };
  const isSignedLog = block.x.scale === "log" || block.y.scale === "log";
  const planeMap = (axis: "x" | "y") =>
    isSignedLog
      ? signedLogMap(tracks.flatMap((track) => [...(axis === "x" ? track.real : track.imaginary)]))
      : linearMap(block[axis]);
  const sPlane = new Plane({
    x: block.x,
    y: block.y,
    xMap: planeMap("x"),
    yMap: planeMap("y"),
    equalScales: false,
    height: planeHeight,
    onZoom: onZoom(0),
    paint: (layer, to) => {
      for (const track of shown()) paintWay(layer, to, track, at);
      for (const track of shown()) paintRoot(layer, to.x(track.real[at] ?? NaN), to.y(track.imaginary[at] ?? NaN), track);
    },
  });
  const overParameter = new Plane({
    x: block.parameter,
    y: block.frequency,
    xMap: block.parameter.scale === "log" ? logMap() : linearMap(block.parameter),
    yMap: block.frequency.scale === "log" ? logMap() : linearMap(block.frequency),
    equalScales: false,
    height: planeHeight,
    onZoom: onZoom(1),
    paint: (layer, to) => {
      const marker = to.x(values[at] ?? NaN);
      layer.append(svg("path", { d: `M${marker} ${to.top}V${to.bottom}`, class: "marker" }));
      for (const track of shown()) {
        layer.append(trackPath(values, track.frequency, to, track, "way"));
        paintRoot(layer, marker, to.y(track.frequency[at] ?? NaN), track);
      }
    },
  });
  planes.push(sPlane, overParameter);
  sPlane.setHome(tracks.flatMap((track) => [...track.real]), tracks.flatMap((track) => [...track.imaginary]));
  overParameter.setHome(values, tracks.flatMap((track) => [...track.frequency]));
  overParameter.element.addEventListener("click", (event) => {
    moveTo(nearestIndex(values, overParameter.valueAt(event.clientX, event.clientY).x));
  });

  const legend = planeLegend(
    tracks.map((track) => ({ name: track.label, role: track.role, shape: track.shape })),
    hidden,
    drawPlanes,
  );
  const boxes = [plotBox(sPlane, undefined, `${block.title}, s plane`), plotBox(overParameter, undefined, `${block.title}, frequency`)];
  const control = html(
    "div",
    { class: "slider" },
    html("label", { for: slider.id }, withUnit(block.parameter.label, block.parameter.unit)),
    slider,
    readout,
  );
  const isEmpty = values.length === 0 || tracks.length === 0;
  return {
    element: isEmpty
      ? html("p", { class: "note" }, "No data.")
      : html(
          "div",
          {},
          control,
          block.events.length > 0 ? eventList(block, (value) => moveTo(nearestIndex(values, value))) : undefined,
          block.events.length > 0 ? eventNote : undefined,
          legend,
          html(
            "div",
            { class: "panels side" },
            ...boxes.map((box, i) => html("div", { class: "panel" }, html("div", { class: "legend-bar" }, resets[i]), box)),
          ),
        ),
    height: (width) =>
      isEmpty ? 0 : kBarsHeight + (width < kTwoColumnsFrom ? 2 * planeHeight(width) : planeHeight(width / 2)),
    draw: () => {
      moveTo(0);
      planes.forEach((plane, i) => keepDrawn(plane, boxes[i] as HTMLElement, kHalfPaperWidth));
    },
    files: () => [{ label: "CSV", name: block.id, table: () => sweepTable(block, values, tracks) }],
  };
}

function eventList(block: SweepBlock, go: (value: number) => void): HTMLElement {
  const list = html("ul", { class: "events" });
  for (const event of block.events) {
    const link = html("button", { type: "button" }, `${numberText(event.value)}: ${event.text}`);
    link.addEventListener("click", () => go(event.value));
    list.append(html("li", {}, link));
  }
  return list;
}

/** The whole way of a root faintly, what lies behind it strongly, and where it began. */
function paintWay(layer: SVGGElement, to: PlaneProjection, track: Track, at: number): void {
  layer.append(trackPath(track.real, track.imaginary, to, track, "way ahead"));
  const behind = trackPath(track.real.slice(0, at + 1), track.imaginary.slice(0, at + 1), to, track, "way");
  layer.append(behind);
  const first = track.real.findIndex((real) => Number.isFinite(real));
  if (first < 0) return;
  const [x, y] = [to.x(track.real[first] ?? NaN), to.y(track.imaginary[first] ?? NaN)];
  layer.append(svg("circle", { cx: x, cy: y, r: 2, fill: `var(--${colourName(track.role)})` }));
}

function paintRoot(layer: SVGGElement, x: number, y: number, track: Track): void {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return;
  layer.append(
    svg("path", {
      d: markPath(track.shape, x, y, kMarkSize),
      stroke: `var(--${colourName(track.role)})`,
      class: `marks ${track.shape}`,
      "data-track": track.label,
    }),
  );
}

function trackPath(
  xs: Float64Array,
  ys: Float64Array,
  to: PlaneProjection,
  track: Track,
  name: string,
): SVGPathElement {
  let d = "";
  let isJoined = false;
  for (let i = 0; i < xs.length; ++i) {
    const [x, y] = [to.x(xs[i] ?? NaN), to.y(ys[i] ?? NaN)];
    const isThere = Number.isFinite(x) && Number.isFinite(y);
    if (isThere) d += `${isJoined ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
    isJoined = isThere;
  }
  const dash = kRoleStyles[track.role].dash;
  return svg("path", {
    d,
    class: name,
    stroke: `var(--${colourName(track.role)})`,
    "stroke-dasharray": dash.length > 0 ? dash.join(" ") : undefined,
  });
}

function nearestIndex(values: Float64Array, value: number): number {
  let best = 0;
  values.forEach((candidate, i) => {
    if (Math.abs(candidate - value) < Math.abs((values[best] ?? NaN) - value)) best = i;
  });
  return best;
}
