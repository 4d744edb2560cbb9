import { numberText } from "./number_text.js";

export interface Tick {
  value: number;
  text: string; // empty: a line without a label
}

const kLeastTicks = 3;
const kCloser = 1.7;

/** Ticks of a linear axis at multiples of 1, 2 or 5 times a power of ten; of an angle in degrees at
 * multiples of 15, 30, 45 or 90 where they fit. */
export function linearTicks(least: number, greatest: number, most: number, unit = ""): Tick[] {
  const span = greatest - least;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const ticks = ticksOfStep(least, greatest, stepOf(span, most, unit));
  // One or two do not show a scale: closer ones, which still have room.
  return ticks.length < kLeastTicks ? ticksOfStep(least, greatest, stepOf(span, kCloser * most, unit)) : ticks;
}

export function stepOf(span: number, most: number, unit = ""): number {
  const wanted = span / Math.max(1, most);
  if ((unit === "°" || unit === "deg") && wanted > 5 && wanted <= 180) {
    return [15, 30, 45, 90, 180].find((step) => step >= wanted) ?? 180;
  }
  const power = 10 ** Math.floor(Math.log10(wanted));
  const factor = [1, 2, 5].find((candidate) => candidate * power >= wanted * (1 - 1e-12)) ?? 10;
  return factor * power;
}

export function ticksOfStep(least: number, greatest: number, step: number): Tick[] {
  const first = Math.ceil(least / step - 1e-9);
  const last = Math.floor(greatest / step + 1e-9);
  // As many digits as tell neighbours apart.
  const digits = Math.ceil(Math.log10(Math.max(Math.abs(first), Math.abs(last), 1) + 1)) + 1;
  const ticks: Tick[] = [];
  for (let i = first; i <= last; ++i) {
    const value = Number((i * step).toPrecision(14));
    ticks.push({ value, text: numberText(value, Math.max(digits, 3)) });
  }
  return ticks;
}

const kMinorShare = 0.7; // decades over ticks with room, up to which there are lines between them

/** Ticks of a logarithmic axis: decades, with 2 and 5 between them where few decades are in view;
 * linear ones within less than a decade. */
export function logTicks(least: number, greatest: number, most: number): Tick[] {
  if (!(least > 0) || !(greatest > least)) return [];
  const decades = Math.log10(greatest / least);
  if (decades < 0.9) return linearTicks(least, greatest, most);
  const labelEach = Math.ceil(decades / most);
  const labelled = decades <= most / 3 ? [1, 2, 5] : [1];
  const ticks: Tick[] = [];
  for (let exponent = Math.floor(Math.log10(least)); 10 ** exponent <= greatest; ++exponent) {
    for (let factor = 1; factor <= 9; ++factor) {
      const value = Number((factor * 10 ** exponent).toPrecision(12));
      if (value < least * (1 - 1e-9) || value > greatest * (1 + 1e-9)) continue;
      if (factor > 1 && decades > kMinorShare * most) continue;
      const named = labelled.includes(factor) && exponent % labelEach === 0;
      ticks.push({ value, text: named ? decadeText(factor, exponent) : "" });
    }
  }
  return ticks;
}

const kSuperscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹";

export function decadeText(factor: number, exponent: number): string {
  if (exponent >= -3 && exponent <= 4) return numberText(factor * 10 ** exponent);
  const digits = [...String(Math.abs(exponent))].map((digit) => kSuperscripts[Number(digit)]).join("");
  const power = `10${exponent < 0 ? "⁻" : ""}${digits}`;
  return factor === 1 ? power : `${factor}·${power}`;
}
