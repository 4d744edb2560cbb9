import type { Envelope, Series } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import { type Curve, kEmpty, type Paint, type Projection, type Range, type Reading } from "./curve.js";

type Level = Envelope["levels"][number];

/** A record too long to send whole: boxes from the least to the greatest value of each bucket. */
export class EnvelopeCurve implements Curve {
  readonly xExtent: Range;

  constructor(
    readonly series: Series,
    private readonly data: Envelope,
    private readonly arrays: Arrays,
  ) {
    const { x, levels } = data;
    if (levels.length === 0) throw new Error(`"${series.label}" has no level`);
    this.xExtent =
      x.count > 0 ? { least: x.start, greatest: x.start + x.step * (x.count - 1) } : { ...kEmpty };
  }

  yExtent(range: Range, positiveOnly: boolean): Range {
    const level = this.levelFor(range, 2000);
    const { least, greatest } = this.read(level);
    const extent = { ...kEmpty };
    const take = (value: number) => {
      if (!Number.isFinite(value) || (positiveOnly && value <= 0)) return;
      extent.least = Math.min(extent.least, value);
      extent.greatest = Math.max(extent.greatest, value);
    };
    const [first, end] = this.bucketsIn(range, level);
    for (let i = first; i < end; ++i) {
      take(least[i] ?? NaN);
      take(greatest[i] ?? NaN);
    }
    return extent;
  }

  at(x: number): Reading | undefined {
    const level = this.finest();
    const bucket = this.bucketAt(x, level);
    const { least, greatest } = this.read(level);
    const y = least[bucket];
    if (y === undefined) return undefined;
    return { x: this.middle(bucket, level), y, greatest: greatest[bucket] ?? NaN };
  }

  stepped(x: number, steps: number): number {
    const level = this.finest();
    const bucket = Math.max(0, Math.min(level.least.count - 1, this.bucketAt(x, level) + steps));
    return this.middle(bucket, level);
  }

  paint(context: CanvasRenderingContext2D, to: Projection, range: Range, paint: Paint): void {
    const level = this.levelFor(range, (to.right - to.left) / to.scale);
    const { least, greatest } = this.read(level);
    const [first, end] = this.bucketsIn(range, level);
    const thickness = Math.min(paint.width, 1.5) * to.scale;
    context.fillStyle = paint.colour;
    context.beginPath();
    for (let i = first; i < end; ++i) {
      const low = least[i] ?? NaN;
      const high = greatest[i] ?? NaN;
      if (!Number.isFinite(low) || !Number.isFinite(high) || (to.isLogY && high <= 0)) continue;
      const left = to.x(this.begin(i, level));
      const right = to.x(Math.min(this.begin(i + 1, level), this.xExtent.greatest));
      const top = to.y(high);
      const bottom = to.isLogY && low <= 0 ? to.y(high * 1e-9) : to.y(low);
      context.rect(left, top - thickness / 2, Math.max(right - left, to.scale), bottom - top + thickness);
    }
    context.fill();
  }

  private finest(): Level {
    return this.data.levels[0] as Level;
  }

  /** The coarsest level with at least one bucket a pixel in view. */
  private levelFor(range: Range, pixels: number): Level {
    const samples = (Math.min(range.greatest, this.xExtent.greatest) - Math.max(range.least, this.xExtent.least)) / this.data.x.step;
    const wanted = samples / Math.max(1, pixels);
    let chosen = this.finest();
    for (const level of this.data.levels) {
      if (level.samples_per_bucket <= wanted && level.samples_per_bucket > chosen.samples_per_bucket) chosen = level;
    }
    return chosen;
  }

  private read(level: Level): { least: Float64Array; greatest: Float64Array } {
    return { least: this.arrays.read(level.least), greatest: this.arrays.read(level.greatest) };
  }

  private begin(bucket: number, level: Level): number {
    return this.data.x.start + this.data.x.step * level.samples_per_bucket * bucket;
  }

  private middle(bucket: number, level: Level): number {
    return Math.min(this.begin(bucket + 0.5, level), this.xExtent.greatest);
  }

  private bucketAt(x: number, level: Level): number {
    const bucket = Math.floor((x - this.data.x.start) / (this.data.x.step * level.samples_per_bucket));
    return Math.max(0, Math.min(level.least.count - 1, bucket));
  }

  private bucketsIn(range: Range, level: Level): [number, number] {
    if (range.greatest < this.xExtent.least || range.least > this.xExtent.greatest) return [0, 0];
    return [this.bucketAt(range.least, level), this.bucketAt(range.greatest, level) + 1];
  }
}
