import { decadeText, linearTicks, logTicks, type Tick, ticksOfStep } from "../axes/ticks.js";
import type { Axis } from "../contract.js";

/** How values of an axis become even distances. Ranges and zooms are in these. */
export interface AxisMap {
  forward(value: number): number;
  inverse(distance: number): number;
  ticks(least: number, greatest: number, most: number, step?: number): Tick[];
  isLinear: boolean;
}

export function linearMap(axis: Axis): AxisMap {
  return {
    forward: (value) => value,
    inverse: (distance) => distance,
    ticks: (least, greatest, most, step) =>
      step === undefined ? linearTicks(least, greatest, most, axis.unit) : ticksOfStep(least, greatest, step),
    isLinear: true,
  };
}

export function logMap(): AxisMap {
  return {
    forward: (value) => (value > 0 ? Math.log10(value) : NaN),
    inverse: (distance) => 10 ** distance,
    ticks: (least, greatest, most) => logTicks(10 ** least, 10 ** greatest, most),
    isLinear: false,
  };
}

const kLinearPart = 1 / 3; // v0 over the smallest number
const kLeastPart = 1e-5; // v0 over the greatest: what is smaller counts as 0
const kFirstTick = 0.4; // closer to the origin a label would touch "0"

/** sign(v) log10(1 + |v|/v0): decades to either side of a linear part about 0. v0 is a third of the
 * smallest of the numbers, so that each has a place of its own. */
export function signedLogMap(numbers: Iterable<number>): AxisMap {
  let least = Infinity;
  let greatest = 0;
  const sizes = [...numbers].map(Math.abs).filter(Number.isFinite);
  for (const size of sizes) greatest = Math.max(greatest, size);
  for (const size of sizes) if (size > greatest * kLeastPart) least = Math.min(least, size);
  const v0 = greatest > 0 ? least * kLinearPart : 1;
  const forward = (value: number) => Math.sign(value) * Math.log10(1 + Math.abs(value) / v0);
  const inverse = (distance: number) => Math.sign(distance) * v0 * (10 ** Math.abs(distance) - 1);
  return {
    forward,
    inverse,
    isLinear: false,
    ticks: (from, to, most) => {
      // Zoomed in between two decades: even steps, by their values.
      if (to - from < 1) return linearTicks(inverse(from), inverse(to), most);
      const each = Math.max(1, Math.round((to - from) / most));
      const ticks: Tick[] = from <= 0 && to >= 0 ? [{ value: 0, text: "0" }] : [];
      const reach = Math.max(Math.abs(inverse(from)), Math.abs(inverse(to)));
      for (let exponent = Math.floor(Math.log10(v0)); 10 ** exponent <= reach; ++exponent) {
        const value = 10 ** exponent;
        if (forward(value) < kFirstTick) continue;
        const text = exponent % each === 0 ? decadeText(1, exponent) : "";
        if (forward(value) <= to) ticks.push({ value, text });
        if (-forward(value) >= from) ticks.push({ value: -value, text: text === "" ? "" : `−${text}` });
      }
      return ticks;
    },
  };
}
