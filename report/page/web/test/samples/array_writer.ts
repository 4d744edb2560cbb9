import type { ArrayRef } from "../../src/contract.js";

const kSteps = 32767; // of i16 to either side

/** The arrays of a sample document, as the program writes them. */
export class ArrayWriter {
  private readonly parts: Buffer[] = [];
  private length = 0;

  f64(numbers: ArrayLike<number>): ArrayRef {
    const bytes = Buffer.alloc(8 * numbers.length);
    for (let i = 0; i < numbers.length; ++i) bytes.writeDoubleLE(numbers[i]!, 8 * i);
    return { type: "f64", byte_offset: this.append(bytes), count: numbers.length };
  }

  f32(numbers: ArrayLike<number>): ArrayRef {
    const bytes = Buffer.alloc(4 * numbers.length);
    for (let i = 0; i < numbers.length; ++i) bytes.writeFloatLE(numbers[i]!, 4 * i);
    return { type: "f32", byte_offset: this.append(bytes), count: numbers.length };
  }

  i16(numbers: ArrayLike<number>): ArrayRef {
    let least = Infinity;
    let greatest = -Infinity;
    for (let i = 0; i < numbers.length; ++i) {
      if (Number.isNaN(numbers[i]!)) continue;
      least = Math.min(least, numbers[i]!);
      greatest = Math.max(greatest, numbers[i]!);
    }
    const offset = (least + greatest) / 2;
    const scale = (greatest - least) / (2 * kSteps) || 1;
    const bytes = Buffer.alloc(2 * numbers.length);
    for (let i = 0; i < numbers.length; ++i) {
      const value = numbers[i]!;
      bytes.writeInt16LE(Number.isNaN(value) ? -32768 : Math.round((value - offset) / scale), 2 * i);
    }
    return { type: "i16", byte_offset: this.append(bytes), count: numbers.length, scale, offset };
  }

  base64(): string {
    return Buffer.concat(this.parts).toString("base64");
  }

  private append(bytes: Buffer): number {
    const offset = this.length;
    this.parts.push(bytes);
    this.length += bytes.length;
    return offset;
  }
}
