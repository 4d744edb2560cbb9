import { stepOf } from "../axes/ticks.js";
import type { Axis } from "../contract.js";
import { joined, kEmpty, type Range } from "../curves/curve.js";
import { withUnit } from "../document/data_table.js";
import { html, svg } from "../page/element.js";
import { followGestures } from "../page/plot_input.js";
import type { AxisMap } from "./axis_map.js";
import { followDrag } from "./drag.js";

/** Distances of the two axes that are in view. */
export interface View {
  x: Range;
  y: Range;
}

export interface PlaneOptions {
  x: Axis;
  y: Axis;
  xMap: AxisMap;
  yMap: AxisMap;
  /** One unit is as long on either axis. */
  equalScales: boolean;
  height(width: number): number;
  /** Draws what the plane holds; called whenever the view or the size changes. */
  paint(layer: SVGGElement, to: PlaneProjection): void;
  onZoom?(isZoomed: boolean): void;
}

/** Values to pixels of the SVG. */
export interface PlaneProjection {
  x(value: number): number;
  y(value: number): number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const kMargin = { right: 14, top: 10, bottom: 40 };
const kLabelWidth = 26; // px of the label of the vertical axis, with gaps
const kDigitWidth = 6.8; // of 12 px text
const kTickSpacing_x = 70; // px
const kTickSpacing_y = 32;
const kRoom = 0.06; // of the range, around what is shown
const kMostZoom = 1e6;

let planes = 0; // for the ids of clip paths

/** A plane with axes as SVG, which is zoomed and moved. */
export class Plane {
  readonly element = html("div", { class: "plane" });
  private readonly picture = svg("svg", { "aria-hidden": "true" });
  private readonly clipId = `clip-${++planes}`;
  private home: View = { x: { least: -1, greatest: 1 }, y: { least: -1, greatest: 1 } };
  private view: View = this.home;
  private width = 0;
  private left = 0; // px of the vertical axis, by its texts

  constructor(private readonly options: PlaneOptions) {
    this.element.append(this.picture);
    followGestures(this.picture, {
      zoom: (factor, at) => this.zoom(factor, at && this.inner(at)),
      pan: (x, y) => this.pan(x, y),
      reset: () => this.reset(),
      step: () => {},
      toEnd: () => {},
    });
    followDrag(this.picture, (box) => {
      const [from, to] = [this.inner({ x: box.left, y: box.bottom }), this.inner({ x: box.right, y: box.top })];
      this.show({ x: part(this.view.x, from.x, to.x), y: part(this.view.y, 1 - from.y, 1 - to.y) });
    });
  }

  /** Shows what encloses these values, and comes back to it on reset. */
  setHome(xs: Iterable<number>, ys: Iterable<number>): void {
    const { x, y, xMap, yMap } = this.options;
    this.home = { x: enclosing(xs, x, xMap), y: enclosing(ys, y, yMap) };
    this.view = this.home;
  }

  draw(width = this.element.clientWidth): void {
    if (width <= 0) return;
    this.width = width;
    this.render();
  }

  zoom(factor: number, at = { x: 0.5, y: 0.5 }): void {
    const about = (range: Range, centre: number) => part(range, centre * (1 - 1 / factor), centre + (1 - centre) / factor);
    this.show({ x: about(this.view.x, at.x), y: about(this.view.y, 1 - at.y) });
  }

  pan(x: number, y: number): void {
    this.show({ x: part(this.view.x, x, 1 + x), y: part(this.view.y, -y, 1 - y) });
  }

  reset(): void {
    this.view = this.home;
    this.changed();
  }

  get isZoomed(): boolean {
    return this.view !== this.home;
  }

  /** The place of a pixel of the window as values. */
  valueAt(clientX: number, clientY: number): { x: number; y: number } {
    const box = this.picture.getBoundingClientRect();
    const at = this.inner({ x: (clientX - box.left) / box.width, y: (clientY - box.top) / box.height });
    return {
      x: this.options.xMap.inverse(part(this.view.x, at.x, at.x).least),
      y: this.options.yMap.inverse(part(this.view.y, 1 - at.y, 1 - at.y).least),
    };
  }

  private show(view: View): void {
    const size = (range: Range) => range.greatest - range.least;
    const isTooFar = size(view.x) < size(this.home.x) / kMostZoom || size(view.y) < size(this.home.y) / kMostZoom;
    const isOut = size(view.x) >= size(this.home.x) && size(view.y) >= size(this.home.y);
    if (isTooFar) return;
    this.view = isOut ? this.home : view;
    this.changed();
  }

  private changed(): void {
    this.render();
    this.options.onZoom?.(this.isZoomed);
  }

  /** Fractions of the picture as fractions of the area within the axes. */
  private inner(at: { x: number; y: number }): { x: number; y: number } {
    const height = this.options.height(this.width);
    const area = { width: this.width - this.left - kMargin.right, height: height - kMargin.top - kMargin.bottom };
    return { x: (at.x * this.width - this.left) / area.width, y: (at.y * height - kMargin.top) / area.height };
  }

  private leftMargin(height: number): number {
    const { least, greatest } = this.view.y;
    const ticks = this.options.yMap.ticks(least, greatest, (height - kMargin.top - kMargin.bottom) / kTickSpacing_y);
    const longest = Math.max(1, ...ticks.map((tick) => tick.text.length));
    return Math.ceil(kLabelWidth + longest * kDigitWidth);
  }

  private render(): void {
    const { x, y, xMap, yMap, equalScales } = this.options;
    const height = this.options.height(this.width);
    this.left = this.leftMargin(height);
    const frame = {
      left: this.left,
      right: Math.max(this.width - kMargin.right, this.left + 1),
      top: kMargin.top,
      bottom: height - kMargin.bottom,
    };
    const view = equalScales ? evened(this.view, frame) : this.view;
    const toX = (distance: number) =>
      frame.left + ((distance - view.x.least) / (view.x.greatest - view.x.least)) * (frame.right - frame.left);
    const toY = (distance: number) =>
      frame.bottom - ((distance - view.y.least) / (view.y.greatest - view.y.least)) * (frame.bottom - frame.top);
    const to: PlaneProjection = { ...frame, x: (value) => toX(xMap.forward(value)), y: (value) => toY(yMap.forward(value)) };

    const most = { x: (frame.right - frame.left) / kTickSpacing_x, y: (frame.bottom - frame.top) / kTickSpacing_y };
    const step = equalScales ? stepOf(view.x.greatest - view.x.least, most.x) : undefined;
    const grid = svg("g", { class: "grid" });
    const texts = svg("g", { class: "ticks" });
    for (const tick of xMap.ticks(view.x.least, view.x.greatest, most.x, step)) {
      const px = to.x(tick.value);
      grid.append(svg("path", { d: `M${px} ${frame.top}V${frame.bottom}`, class: tick.value === 0 ? "zero" : undefined }));
      texts.append(svg("text", { x: px, y: frame.bottom + 16, "text-anchor": "middle" }, tick.text));
    }
    for (const tick of yMap.ticks(view.y.least, view.y.greatest, most.y, step)) {
      const py = to.y(tick.value);
      grid.append(svg("path", { d: `M${frame.left} ${py}H${frame.right}`, class: tick.value === 0 ? "zero" : undefined }));
      texts.append(svg("text", { x: frame.left - 6, y: py + 4, "text-anchor": "end" }, tick.text));
    }
    const middle = { x: (frame.left + frame.right) / 2, y: (frame.top + frame.bottom) / 2 };
    texts.append(
      svg("text", { x: middle.x, y: height - 6, "text-anchor": "middle", class: "label" }, withUnit(x.label, x.unit)),
      svg(
        "text",
        { x: 12, y: middle.y, "text-anchor": "middle", class: "label", transform: `rotate(-90 12 ${middle.y})` },
        withUnit(y.label, y.unit),
      ),
    );
    const box = { x: frame.left, y: frame.top, width: frame.right - frame.left, height: frame.bottom - frame.top };
    const layer = svg("g", { "clip-path": `url(#${this.clipId})` });
    this.picture.setAttribute("viewBox", `0 0 ${this.width} ${height}`);
    this.picture.replaceChildren(
      svg("defs", {}, svg("clipPath", { id: this.clipId }, svg("rect", box))),
      grid,
      svg("rect", { ...box, class: "frame" }),
      layer,
      texts,
    );
    this.options.paint(layer, to);
  }
}

/** The part of a range between two fractions. */
function part(range: Range, from: number, to: number): Range {
  const size = range.greatest - range.least;
  return { least: range.least + from * size, greatest: range.least + to * size };
}

function enclosing(values: Iterable<number>, axis: Axis, map: AxisMap): Range {
  if (axis.range) return { least: map.forward(axis.range[0]), greatest: map.forward(axis.range[1]) };
  let range = { ...kEmpty };
  for (const value of values) {
    const distance = map.forward(value);
    if (Number.isFinite(distance)) range = joined(range, { least: distance, greatest: distance });
  }
  if (range.least > range.greatest) return map.isLinear ? { least: -1, greatest: 1 } : { least: 0, greatest: 1 };
  const span = range.greatest - range.least;
  const size = Math.max(Math.abs(range.least), Math.abs(range.greatest));
  const room = span > 1e-9 * size ? span * kRoom : size > 0 ? 0.1 * size : 1;
  return { least: range.least - room, greatest: range.greatest + room };
}

/** The view widened on one axis, so that a unit is as many pixels on both. */
function evened(view: View, frame: { left: number; right: number; top: number; bottom: number }): View {
  const width = view.x.greatest - view.x.least;
  const height = view.y.greatest - view.y.least;
  const unit = Math.max(width / (frame.right - frame.left), height / (frame.bottom - frame.top));
  const about = (range: Range, size: number) => {
    const middle = (range.least + range.greatest) / 2;
    return { least: middle - size / 2, greatest: middle + size / 2 };
  };
  return {
    x: about(view.x, unit * (frame.right - frame.left)),
    y: about(view.y, unit * (frame.bottom - frame.top)),
  };
}
