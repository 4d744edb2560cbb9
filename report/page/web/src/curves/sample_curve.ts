import type { Samples, Series } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import { type Curve, kEmpty, lowerBound, type Paint, type Projection, type Range, type Reading } from "./curve.js";
import { bandPath, linePath } from "./paths.js";

const kMarkedSpacing = 14; // px between samples from which on each has a dot
const kDot = 2.2; // px
const kBandOpacity = 0.22;
const kDenseStems = 3; // px

/** A curve that is sent sample by sample. */
export class SampleCurve implements Curve {
  readonly xExtent: Range;
  private readonly x: Float64Array;
  private readonly y: Float64Array;
  private readonly std: Float64Array | undefined;

  constructor(
    readonly series: Series,
    data: Samples,
    arrays: Arrays,
  ) {
    this.x = arrays.read(data.x);
    this.y = arrays.read(data.y);
    this.std = data.y_std && arrays.read(data.y_std);
    if (this.x.length !== this.y.length || (this.std && this.std.length !== this.y.length)) {
      throw new Error(`"${series.label}" has ${this.x.length} x and ${this.y.length} y`);
    }
    this.xExtent = finiteExtent(this.x);
  }

  yExtent(range: Range, positiveOnly: boolean): Range {
    const extent = { ...kEmpty };
    const take = (value: number) => {
      if (!Number.isFinite(value) || (positiveOnly && value <= 0)) return;
      extent.least = Math.min(extent.least, value);
      extent.greatest = Math.max(extent.greatest, value);
    };
    for (let i = this.first(range.least); i < this.end(range.greatest); ++i) {
      const y = this.y[i] ?? NaN;
      const std = this.std?.[i] ?? 0;
      take(y);
      if (std > 0 && Number.isFinite(std)) {
        take(y - std);
        take(y + std);
      }
    }
    if (this.series.draw === "stems") take(0);
    return extent;
  }

  at(x: number): Reading | undefined {
    const i = this.nearest(x);
    const found = this.x[i];
    if (found === undefined) return undefined;
    const std = this.std?.[i];
    return { x: found, y: this.y[i] ?? NaN, ...(std === undefined ? {} : { std }) };
  }

  stepped(x: number, steps: number): number {
    const i = Math.max(0, Math.min(this.x.length - 1, this.nearest(x) + steps));
    return this.x[i] ?? x;
  }

  paint(context: CanvasRenderingContext2D, to: Projection, range: Range, paint: Paint): void {
    // One sample beyond either end, so that lines go on to the edge.
    const first = Math.max(0, this.first(range.least) - 1);
    const end = Math.min(this.x.length, this.end(range.greatest) + 1);
    const spacing = (to.right - to.left) / Math.max(1, end - first);
    context.strokeStyle = context.fillStyle = paint.colour;
    context.lineWidth = paint.width * to.scale;
    context.setLineDash(paint.dash.map((length) => length * to.scale));
    if (this.series.draw === "line") {
      if (this.std) {
        context.globalAlpha = kBandOpacity;
        context.fill(bandPath(this.x, this.y, this.std, first, end, to));
        context.globalAlpha = 1;
      }
      const { path, lonely } = linePath(this.x, this.y, first, end, to);
      context.stroke(path);
      for (const i of lonely) this.dot(context, to, i, kDot + paint.width / 4);
      if (spacing > kMarkedSpacing * to.scale) this.dots(context, to, first, end, kDot);
      return;
    }
    context.setLineDash([]);
    if (this.series.draw === "stems") this.stems(context, to, first, end, spacing);
    else this.errorBars(context, to, first, end);
    const dense = this.series.draw === "stems" && spacing < kDenseStems * to.scale;
    if (!dense) this.dots(context, to, first, end, kDot);
  }

  private stems(context: CanvasRenderingContext2D, to: Projection, first: number, end: number, spacing: number) {
    context.lineWidth = Math.min(1.5 * to.scale, Math.max(0.75 * to.scale, spacing / 2));
    const zero = to.y(0);
    context.beginPath();
    for (let i = first; i < end; ++i) {
      const y = this.y[i] ?? NaN;
      if (!Number.isFinite(y)) continue;
      const x = to.x(this.x[i] ?? NaN);
      context.moveTo(x, zero);
      context.lineTo(x, to.y(y));
    }
    context.stroke();
  }

  private errorBars(context: CanvasRenderingContext2D, to: Projection, first: number, end: number) {
    if (!this.std) return;
    context.lineWidth = to.scale;
    context.beginPath();
    for (let i = first; i < end; ++i) {
      const y = this.y[i] ?? NaN;
      const std = this.std[i] ?? NaN;
      if (!Number.isFinite(y) || !(std > 0)) continue;
      const x = to.x(this.x[i] ?? NaN);
      context.moveTo(x, to.y(to.isLogY ? Math.max(y - std, y * 1e-3) : y - std));
      context.lineTo(x, to.y(y + std));
    }
    context.stroke();
  }

  private dots(context: CanvasRenderingContext2D, to: Projection, first: number, end: number, radius: number) {
    for (let i = first; i < end; ++i) this.dot(context, to, i, radius);
  }

  private dot(context: CanvasRenderingContext2D, to: Projection, i: number, radius: number) {
    const y = this.y[i] ?? NaN;
    if (!Number.isFinite(y) || (to.isLogY && y <= 0)) return;
    context.beginPath();
    context.arc(to.x(this.x[i] ?? NaN), to.y(y), radius * to.scale, 0, 2 * Math.PI);
    context.fill();
  }

  private first(x: number): number {
    return lowerBound(this.x, x);
  }

  private end(x: number): number {
    let i = lowerBound(this.x, x);
    while ((this.x[i] ?? NaN) <= x) ++i;
    return i;
  }

  private nearest(x: number): number {
    const i = lowerBound(this.x, x);
    const [below, above] = [this.x[i - 1], this.x[i]];
    if (above === undefined) return Math.max(0, i - 1);
    return below !== undefined && x - below < above - x ? i - 1 : i;
  }
}

function finiteExtent(numbers: Float64Array): Range {
  const extent = { ...kEmpty };
  for (const value of numbers) {
    if (!Number.isFinite(value)) continue;
    extent.least = Math.min(extent.least, value);
    extent.greatest = Math.max(extent.greatest, value);
  }
  return extent;
}
