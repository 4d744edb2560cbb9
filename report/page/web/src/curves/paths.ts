import type { Projection } from "./curve.js";

/** The line through the samples from `first` up to `end`, with gaps where y is not a number. Of the
 * samples in one column of pixels the first, least, greatest and last are joined, which looks the
 * same as all. `lonely`: samples between two gaps, which no line shows. */
export function linePath(
  x: Float64Array,
  y: Float64Array,
  first: number,
  end: number,
  to: Projection,
): { path: Path2D; lonely: number[] } {
  const path = new Path2D();
  const lonely: number[] = [];
  let column = NaN;
  let least = 0;
  let greatest = 0;
  let last = 0;
  let lineLength = 0;
  const finishColumn = () => {
    if (least !== last || greatest !== last) {
      path.lineTo(column, least);
      path.lineTo(column, greatest);
      path.lineTo(column, last);
    }
  };
  const finishLine = (next: number) => {
    if (lineLength > 0) finishColumn();
    if (lineLength === 1) lonely.push(next - 1);
    lineLength = 0;
  };
  for (let i = first; i < end; ++i) {
    const value = y[i] ?? NaN;
    if (!Number.isFinite(value) || (to.isLogY && value <= 0)) {
      finishLine(i);
      continue;
    }
    const px = Math.round(to.x(x[i] ?? NaN) * 2) / 2;
    const py = to.y(value);
    if (lineLength > 0 && px === column) {
      least = Math.min(least, py);
      greatest = Math.max(greatest, py);
    } else {
      if (lineLength > 0) {
        finishColumn();
        path.lineTo(px, py);
      } else path.moveTo(px, py);
      column = px;
      least = greatest = py;
    }
    last = py;
    ++lineLength;
  }
  finishLine(end);
  return { path, lonely };
}

/** The area between y - std and y + std. */
export function bandPath(
  x: Float64Array,
  y: Float64Array,
  std: Float64Array,
  first: number,
  end: number,
  to: Projection,
): Path2D {
  const path = new Path2D();
  let begin = first;
  const isThere = (i: number) =>
    Number.isFinite(y[i] ?? NaN) && (std[i] ?? NaN) >= 0 && !(to.isLogY && (y[i] ?? 0) <= 0);
  while (begin < end) {
    while (begin < end && !isThere(begin)) ++begin;
    let stop = begin;
    while (stop < end && isThere(stop)) ++stop;
    for (let i = begin; i < stop; ++i) {
      const px = to.x(x[i] ?? NaN);
      const py = to.y((y[i] ?? NaN) + (std[i] ?? NaN));
      if (i === begin) path.moveTo(px, py);
      else path.lineTo(px, py);
    }
    for (let i = stop - 1; i >= begin; --i) {
      const lower = (y[i] ?? NaN) - (std[i] ?? NaN);
      // On a logarithmic axis the band may reach below what has a place.
      path.lineTo(to.x(x[i] ?? NaN), to.y(to.isLogY ? Math.max(lower, (y[i] ?? NaN) * 1e-3) : lower));
    }
    if (stop > begin) path.closePath();
    begin = stop + 1;
  }
  return path;
}
