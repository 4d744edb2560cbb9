import { colour } from "../page/theme.js";
import { html } from "../page/element.js";
import { type Curve, joined, kEmpty, type Range } from "./curve.js";
import { colourName, kRoleStyles } from "./role_style.js";

export const kOverviewHeight = 46; // px, with its gap
const kInnerHeight = 38;
const kGrip = 8; // px beside an edge of the lens within which it is moved
const kMostWidth = 1.2; // px of strokes
const kMargin = 12; // px at the right, as of the panels

/** The curves of a panel over the whole range, with a lens on what the panels show: a drag moves it or
 * one of its edges, or draws a new one. Keys zoom and move the panels themselves. */
export class Overview {
  readonly element = html("div", { class: "overview", "aria-hidden": "true" });
  private readonly canvas = html("canvas");
  private readonly lens = html("div", { class: "lens" });
  private width = 0;
  private left = 0;
  private shown: Range;

  constructor(
    private readonly curves: Curve[],
    private readonly extent: Range,
    private readonly isShown: (curve: Curve) => boolean,
    private readonly onRange: (x: Range) => void,
  ) {
    this.shown = extent;
    this.element.append(this.canvas, this.lens);
    this.element.addEventListener("pointerdown", (event) => this.drag(event));
    this.element.addEventListener("dblclick", () => this.onRange(this.extent));
  }

  draw(width: number, left: number): void {
    this.width = Math.max(width - left - kMargin, 1);
    this.left = left;
    const ratio = devicePixelRatio;
    this.element.style.marginLeft = `${left}px`;
    this.element.style.width = `${this.width}px`;
    this.canvas.width = Math.round(this.width * ratio);
    this.canvas.height = Math.round(kInnerHeight * ratio);
    const context = this.canvas.getContext("2d");
    if (!context) return;
    let y = { ...kEmpty };
    const curves = this.curves.filter(this.isShown);
    for (const curve of curves) y = joined(y, curve.yExtent(this.extent, false));
    const room = y.greatest > y.least ? 0.08 * (y.greatest - y.least) : 1;
    const [low, high] = [y.least - room, y.greatest + room];
    const to = {
      x: (value: number) => this.place(value) * ratio,
      y: (value: number) => ((high - value) / (high - low)) * this.canvas.height,
      left: 0,
      right: this.canvas.width,
      scale: ratio,
      isLogY: false,
    };
    context.lineJoin = "round";
    for (const curve of curves) {
      const { role } = curve.series;
      const style = kRoleStyles[role];
      const width = Math.min(style.width, kMostWidth);
      curve.paint(context, to, this.extent, { dash: [], width, colour: colour(colourName(role)) });
    }
    this.show(this.shown);
  }

  show(x: Range): void {
    this.shown = x;
    const [from, to] = [this.place(x.least), this.place(x.greatest)];
    this.lens.style.left = `${from}px`;
    this.lens.style.width = `${Math.max(to - from, 2)}px`;
  }

  redraw(): void {
    this.draw(this.width + this.left + kMargin, this.left);
  }

  private place(x: number): number {
    return ((x - this.extent.least) / (this.extent.greatest - this.extent.least)) * this.width;
  }

  private value(px: number): number {
    const part = Math.max(0, Math.min(1, px / this.width));
    return this.extent.least + part * (this.extent.greatest - this.extent.least);
  }

  private drag(start: PointerEvent): void {
    if (start.button !== 0) return;
    start.preventDefault();
    const box = this.element.getBoundingClientRect();
    const at = start.clientX - box.left;
    const [from, to] = [this.place(this.shown.least), this.place(this.shown.greatest)];
    const size = this.shown.greatest - this.shown.least;
    const move = (event: PointerEvent) => {
      const px = event.clientX - box.left;
      if (Math.abs(at - from) <= kGrip) this.choose(this.shown.greatest, this.value(px));
      else if (Math.abs(at - to) <= kGrip) this.choose(this.shown.least, this.value(px));
      else if (at > from && at < to) {
        const least = this.value(from + px - at);
        const within = Math.min(least, this.extent.greatest - size);
        this.onRange({ least: within, greatest: within + size });
      } else this.choose(this.value(at), this.value(px));
    };
    this.element.setPointerCapture(start.pointerId);
    this.element.addEventListener("pointermove", move);
    const end = () => this.element.removeEventListener("pointermove", move);
    this.element.addEventListener("pointerup", end, { once: true });
    this.element.addEventListener("pointercancel", end, { once: true });
  }

  private choose(one: number, other: number): void {
    if (one === other) return;
    this.onRange({ least: Math.min(one, other), greatest: Math.max(one, other) });
  }
}
