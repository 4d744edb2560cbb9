import type { ArrayRef, EvenRange, Numbers } from "../contract.js";
import { MalformedDocument } from "./checks.js";

const kBytes = { f64: 8, f32: 4, i16: 2 } as const;
const kGap = -32768; // of i16

/** The numbers of a page, of which those that are drawn are decoded: four letters of base64 are three
 * bytes, so that any range of bytes can be cut out of the text. */
export class Arrays {
  private readonly base64: string;
  private readonly byteCount: number;
  private readonly decoded = new Map<string, Float64Array>();

  constructor(base64: string) {
    this.base64 = /\s/.test(base64) ? base64.replace(/\s+/g, "") : base64;
    const padding = this.base64.endsWith("==") ? 2 : this.base64.endsWith("=") ? 1 : 0;
    this.byteCount = (this.base64.length / 4) * 3 - padding;
  }

  /** All numbers, NaN for a gap. The same array for the same range. */
  read(numbers: Numbers): Float64Array {
    const key = JSON.stringify(numbers);
    let array = this.decoded.get(key);
    if (array === undefined) {
      array = "type" in numbers ? this.decode(numbers) : spread(numbers);
      this.decoded.set(key, array);
    }
    return array;
  }

  private decode(ref: ArrayRef): Float64Array {
    const size = kBytes[ref.type];
    const end = ref.byte_offset + size * ref.count;
    if (end > this.byteCount) {
      throw new MalformedDocument(`an array ends at byte ${end}, the page has ${this.byteCount}`);
    }
    const view = this.bytes(ref.byte_offset, end);
    const array = new Float64Array(ref.count);
    const scale = ref.scale ?? 1;
    const offset = ref.offset ?? 0;
    for (let i = 0; i < ref.count; ++i) {
      if (ref.type === "f64") array[i] = view.getFloat64(i * 8, true);
      else if (ref.type === "f32") array[i] = view.getFloat32(i * 4, true);
      else {
        const integer = view.getInt16(i * 2, true);
        array[i] = integer === kGap ? NaN : offset + scale * integer;
      }
    }
    return array;
  }

  private bytes(begin: number, end: number): DataView {
    const firstGroup = Math.floor(begin / 3);
    const text = atob(this.base64.slice(firstGroup * 4, Math.ceil(end / 3) * 4));
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    return new DataView(bytes.buffer, begin - firstGroup * 3);
  }
}

function spread(range: EvenRange): Float64Array {
  const array = new Float64Array(range.count);
  for (let i = 0; i < range.count; ++i) array[i] = range.start + range.step * i;
  return array;
}

/** Decimals of the numbers that carry information, for text: of quantised ones fewer. */
export function digitsOf(numbers: Numbers): number {
  if (!("type" in numbers)) return 12;
  return numbers.type === "f64" ? 17 : 7;
}
