const kDigits = 4;
const kLeastPlain = 1e-4;
const kGreatestPlain = 1e6;

/** Four significant digits; a minus sign rather than a hyphen; "–" for what is not there. */
export function numberText(value: number, digits = kDigits): string {
  if (Number.isNaN(value)) return "–";
  if (!Number.isFinite(value)) return value > 0 ? "∞" : "−∞";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const text =
    size >= kLeastPlain && size < kGreatestPlain
      ? String(Number(value.toPrecision(digits)))
      : value.toExponential(digits - 1).replace(/\.?0+e/, "e").replace("e+", "e");
  return text.replaceAll("-", "−");
}

export function quantityText(value: number, unit: string): string {
  return unit === "" ? numberText(value) : `${numberText(value)} ${unit}`;
}

/** The number that a text begins with, for sorting: "−1.2e-5 ± 0.1", "99.5 %". NaN without one. */
export function leadingNumber(text: string): number {
  const plain = text.trim().replace(/^−/, "-").replace(/e−/, "e-").replace(/^[<>≤≥≈]\s*/, "");
  if (/^-?∞/.test(plain)) return plain.startsWith("-") ? -Infinity : Infinity;
  return Number.parseFloat(plain);
}
