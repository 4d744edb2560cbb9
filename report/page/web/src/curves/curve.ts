import type { Series } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import { EnvelopeCurve } from "./envelope_curve.js";
import { SampleCurve } from "./sample_curve.js";

/** A range of numbers; empty while least > greatest. */
export interface Range {
  least: number;
  greatest: number;
}

export const kEmpty: Range = { least: Infinity, greatest: -Infinity };

export function joined(a: Range, b: Range): Range {
  return { least: Math.min(a.least, b.least), greatest: Math.max(a.greatest, b.greatest) };
}

/** What a curve shows at a place: a value, or the least and greatest of a bucket. */
export interface Reading {
  x: number;
  y: number;
  greatest?: number; // then y is the least
  std?: number;
}

/** Maps values to pixels of the canvas. */
export interface Projection {
  x(value: number): number;
  y(value: number): number;
  left: number;
  right: number;
  /** Pixels of the canvas in one of the layout. */
  scale: number;
  isLogY: boolean;
}

export interface Paint {
  colour: string;
  width: number;
  dash: number[];
}

export interface Curve {
  readonly series: Series;
  readonly xExtent: Range;
  /** Least and greatest y for x in the range, bands included; positive ones alone on request. */
  yExtent(x: Range, positiveOnly: boolean): Range;
  /** The sample nearest to x. */
  at(x: number): Reading | undefined;
  /** x of the sample `steps` on from the one nearest to x. */
  stepped(x: number, steps: number): number;
  paint(context: CanvasRenderingContext2D, to: Projection, x: Range, paint: Paint): void;
}

export function curveOf(series: Series, arrays: Arrays): Curve {
  return series.data.kind === "samples"
    ? new SampleCurve(series, series.data, arrays)
    : new EnvelopeCurve(series, series.data, arrays);
}

/** Index of the first number that is not below x, of ascending numbers. */
export function lowerBound(numbers: Float64Array, x: number): number {
  let low = 0;
  let high = numbers.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((numbers[middle] ?? NaN) < x) low = middle + 1;
    else high = middle;
  }
  return low;
}
