/** Shapes of roots: a cross for a pole, a circle for a zero, a diamond for a zero in the right half
 * plane, so that colour is not needed to tell them apart. */
export type Mark = "pole" | "zero" | "non_minimum_phase_zero";

export function markOf(root: { mark: "pole" | "zero"; non_minimum_phase: boolean }): Mark {
  return root.mark === "zero" && root.non_minimum_phase ? "non_minimum_phase_zero" : root.mark;
}

export const kMarkWords: Record<Mark, string> = {
  pole: "pole",
  zero: "zero",
  non_minimum_phase_zero: "non-minimum-phase zero",
};

/** The outline of a mark about a place. */
export function markPath(mark: Mark, x: number, y: number, size: number): string {
  const s = size;
  switch (mark) {
    case "pole":
      return `M${x - s} ${y - s}l${2 * s} ${2 * s}M${x - s} ${y + s}l${2 * s} ${-2 * s}`;
    case "zero":
      return `M${x - s} ${y}a${s} ${s} 0 1 0 ${2 * s} 0a${s} ${s} 0 1 0 ${-2 * s} 0z`;
    case "non_minimum_phase_zero":
      return `M${x - 1.4 * s} ${y}l${1.4 * s} ${-1.4 * s}l${1.4 * s} ${1.4 * s}l${-1.4 * s} ${1.4 * s}z`;
  }
}
