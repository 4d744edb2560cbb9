import { quantityText } from "../axes/number_text.js";
import type { CurvesBlock, CurvesView } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import { withUnit } from "../document/data_table.js";
import { html } from "../page/element.js";
import { followGestures, type PlotInput } from "../page/plot_input.js";
import { type Curve, curveOf, joined, kEmpty, type Range, type Reading } from "./curve.js";
import { Legend, readingText } from "./legend.js";
import { kOverviewHeight, Overview } from "./overview.js";
import { PanelPlot, yAxisWidth } from "./panel_plot.js";
import { paperCopy } from "./paper_copy.js";

const kHeights = [270, 330, 350, 420]; // px of one, two, three and more panels
const kNarrow = 500;
const kNarrowShare = 0.85;
const kAxisHeight = 26;
const kLegendHeight = 31;
const kLabelHeight = 21;
const kMostZoom = 1e7;

interface Part {
  curves: Curve[];
  legend: Legend;
  place: HTMLElement;
  element: HTMLElement;
  plot?: PanelPlot;
}

/** The panels of one view over a common x, with one cursor. */
export class ViewPlot implements PlotInput {
  readonly element = html("div", { class: "panels" });
  private readonly parts: Part[];
  private readonly extent: Range;
  /** The whole range below the panels, of a linear axis. */
  private readonly overview: Overview | undefined;
  private readonly start: Range;
  private x: Range;
  private cursor: number | undefined;

  constructor(
    private readonly block: CurvesBlock,
    private readonly view: CurvesView,
    arrays: Arrays,
    private readonly hidden: Set<string>,
    private readonly on: { cursor(text: string, spoken: string): void; range(isZoomed: boolean): void },
  ) {
    this.parts = view.panels.map((panel) => {
      const curves = panel.series.map((series) => curveOf(series, arrays));
      const legend = new Legend(panel, curves, hidden, () => {
        this.showRange(this.x);
        this.overview?.redraw();
      });
      const place = html("div", { class: "canvas", "aria-hidden": "true" });
      const element = html("div", { class: "panel" }, legend.element, place);
      this.element.append(element);
      return { curves, legend, place, element };
    });
    this.extent = this.wholeRange();
    const { shown } = view;
    this.start = shown ? this.limited({ least: shown[0], greatest: shown[1] }) : this.extent;
    this.x = this.start;
    const xLabel = html("p", { class: "x-label" }, withUnit(block.x.label, block.x.unit));
    this.parts.at(-1)?.element.append(xLabel);
    if (hasOverview(block, view)) {
      const isShown = (curve: Curve) => !hidden.has(curve.series.label);
      this.overview = new Overview(this.parts[0]?.curves ?? [], this.extent, isShown, (x) => this.showRange(this.limited(x)));
      this.overview.show(this.x);
      this.element.append(this.overview.element);
    }
  }

  /** Draws for the first time or at another width. */
  draw(width: number): void {
    this.parts.forEach((part, i) => {
      const height = this.height(i, width);
      if (part.plot) part.plot.resize(width, height);
      else {
        part.plot = this.panelPlot(i, part.place, width, height, 1);
        followGestures(part.plot.plot.over, this);
      }
    });
    this.overview?.draw(width, yAxisWidth(width));
    this.on.range(this.zoomed !== undefined);
  }

  redraw(): void {
    for (const part of this.parts) part.plot?.plot.redraw(false, true);
    this.overview?.redraw();
  }

  /** Pictures in the resolution of paper in place of the canvases, until the next call. */
  forPaper(on: boolean): void {
    for (const copy of this.element.querySelectorAll(".paper")) copy.remove();
    if (!on) return;
    this.parts.forEach((part, i) => {
      const copy = paperCopy((place, width, scale) => {
        this.panelPlot(i, place, width * scale, this.height(i, width) * scale, scale);
      });
      part.place.after(copy);
    });
  }

  destroy(): void {
    for (const part of this.parts) part.plot?.plot.destroy();
    this.element.remove();
  }

  /** The range in view, if it is not the whole one. */
  get zoomed(): Range | undefined {
    return this.x === this.extent ? undefined : this.x;
  }

  /** The range in view, if a reader has chosen a part. */
  get chosen(): Range | undefined {
    return this.x === this.start ? undefined : this.zoomed;
  }

  showRange(x: Range): void {
    this.x = x;
    for (const part of this.parts) part.plot?.showRange(x);
    this.overview?.show(x);
    this.moveCursor(this.cursor, false);
    this.on.range(this.zoomed !== undefined || this.parts.some((part) => part.plot?.isYChosen));
  }

  zoom(factor: number, at?: { x: number }): void {
    const centre = at?.x ?? (this.cursor === undefined ? 0.5 : this.fraction(this.cursor));
    const size = 1 / factor;
    this.showFractions(centre * (1 - size), centre * (1 - size) + size);
  }

  pan(x: number): void {
    if (this.zoomed) this.showFractions(x, 1 + x);
  }

  reset(): void {
    for (const part of this.parts) part.plot?.chooseY(undefined);
    this.moveCursor(undefined, false);
    this.showRange(this.extent);
  }

  step(steps: number, coarse: boolean, upright: boolean): void {
    if (upright) return;
    const curve = this.leading();
    if (!curve) return;
    const from = this.cursor ?? this.value(steps > 0 ? 0 : 1);
    const to = coarse
      ? (curve.at(this.value(this.fraction(from) + steps / 10))?.x ?? from)
      : this.cursor === undefined
        ? (curve.at(from)?.x ?? from)
        : curve.stepped(from, steps);
    this.followTo(to);
    this.moveCursor(to, true);
  }

  toEnd(end: "first" | "last"): void {
    const x = this.leading()?.at(end === "first" ? this.x.least : this.x.greatest)?.x;
    if (x !== undefined) this.moveCursor(x, true);
  }

  private panelPlot(i: number, place: HTMLElement, width: number, height: number, scale: number): PanelPlot {
    const part = this.parts[i] as Part;
    const plot: PanelPlot = new PanelPlot(place, {
      panel: this.view.panels[i] as CurvesView["panels"][number],
      curves: part.curves,
      xAxis: this.block.x,
      x: this.x,
      width,
      height,
      isLowest: i === this.parts.length - 1,
      scale,
      isShown: (curve) => !this.hidden.has(curve.series.label),
      onSelect: ({ x, y }) => {
        if (y) plot.chooseY(y);
        this.showRange(x ? this.limited(x) : this.x);
      },
      onPointer: (x) => this.moveCursor(x === undefined ? undefined : (this.leading()?.at(x)?.x ?? x), false),
    });
    return plot;
  }

  /** The curve whose samples the cursor goes along: the first that is shown. */
  private leading(): Curve | undefined {
    const curves = this.parts.flatMap((part) => part.curves);
    return curves.find((curve) => !this.hidden.has(curve.series.label) && curve.at(this.x.least)) ?? curves[0];
  }

  private moveCursor(x: number | undefined, speak: boolean): void {
    this.cursor = x;
    const said: string[] = [];
    this.parts.forEach((part, i) => {
      part.plot?.placeCursor(x);
      const readings = new Map<Curve, Reading | undefined>();
      const unit = this.view.panels[i]?.y.unit ?? "";
      for (const curve of part.curves) {
        const reading = x === undefined ? undefined : this.readingAt(curve, x);
        readings.set(curve, reading);
        const text = readingText(reading, unit);
        if (text !== "" && !this.hidden.has(curve.series.label)) said.push(`${curve.series.label} ${text}`);
      }
      part.legend.show(readings);
      part.plot?.showDots(readings);
    });
    const text = x === undefined ? "" : `${this.block.x.label} ${quantityText(x, this.block.x.unit)}`;
    this.on.cursor(text, speak ? [text, ...said].join("; ") : "");
  }

  /** The sample at the cursor; none where the curve has no sample near. */
  private readingAt(curve: Curve, x: number): Reading | undefined {
    const reading = curve.at(x);
    if (!reading) return undefined;
    const spacing = Math.abs(curve.stepped(reading.x, x > reading.x ? 1 : -1) - reading.x);
    const tolerance = Math.max(spacing, (this.x.greatest - this.x.least) / 200);
    return Math.abs(reading.x - x) <= tolerance ? reading : undefined;
  }

  /** Moves the range so that the cursor stays in view. */
  private followTo(x: number): void {
    const at = this.fraction(x);
    if (at < 0) this.showFractions(at - 0.1, at + 0.9);
    else if (at > 1) this.showFractions(at - 0.9, at + 0.1);
  }

  private showFractions(from: number, to: number): void {
    this.showRange(this.limited({ least: this.value(from), greatest: this.value(to) }));
  }

  /** Not beyond the data; the whole range where little is missing. */
  private limited(range: Range): Range {
    const [least, greatest] = [this.scaled(this.extent.least), this.scaled(this.extent.greatest)];
    const whole = greatest - least;
    const size = Math.max(this.scaled(range.greatest) - this.scaled(range.least), whole / kMostZoom);
    if (!(size < whole * 0.999)) return this.extent;
    const start = Math.max(least, Math.min(this.scaled(range.least), greatest - size));
    return { least: this.unscaled(start), greatest: this.unscaled(start + size) };
  }

  private wholeRange(): Range {
    const { range, scale } = this.block.x;
    if (range) return { least: range[0], greatest: range[1] };
    let extent = { ...kEmpty };
    for (const { curves } of this.parts) for (const curve of curves) extent = joined(extent, curve.xExtent);
    if (extent.least > extent.greatest) return scale === "log" ? { least: 1, greatest: 10 } : { least: 0, greatest: 1 };
    if (scale === "log") {
      const least = extent.least > 0 ? extent.least : extent.greatest / 1e3;
      return least < extent.greatest ? { least, greatest: extent.greatest } : { least: least / 2, greatest: least * 2 };
    }
    if (extent.least === extent.greatest) return { least: extent.least - 0.5, greatest: extent.greatest + 0.5 };
    return extent;
  }

  private height(panel: number, width: number): number {
    const shares = this.view.panels.map((other) => Math.max(other.height, 0.1));
    const share = (shares[panel] ?? 1) / shares.reduce((sum, value) => sum + value, 0);
    return Math.round(areaHeight(shares.length, width) * share + (panel === shares.length - 1 ? kAxisHeight : 0));
  }

  private scaled(x: number): number {
    return this.block.x.scale === "log" ? Math.log(x) : x;
  }

  private unscaled(x: number): number {
    return this.block.x.scale === "log" ? Math.exp(x) : x;
  }

  private fraction(x: number): number {
    const [least, greatest] = [this.scaled(this.x.least), this.scaled(this.x.greatest)];
    return (this.scaled(x) - least) / (greatest - least);
  }

  private value(fraction: number): number {
    const [least, greatest] = [this.scaled(this.x.least), this.scaled(this.x.greatest)];
    return this.unscaled(least + fraction * (greatest - least));
  }
}

/** Where a record may be long: signals over time. */
function hasOverview(block: CurvesBlock, view: CurvesView): boolean {
  return block.x.scale === "linear" && block.x.unit === "s" && view.panels.some((panel) => panel.series.length > 0);
}

/** Height of all panels without their legends and axes. */
function areaHeight(panels: number, width: number): number {
  const height = kHeights[Math.min(panels, kHeights.length) - 1] ?? 0;
  return width < kNarrow ? height * kNarrowShare : height;
}

/** Height of a view that has not been drawn. */
export function viewHeight(block: CurvesBlock, view: CurvesView, width: number): number {
  const panels = view.panels.length;
  const overview = hasOverview(block, view) ? kOverviewHeight : 0;
  return areaHeight(panels, width) + panels * kLegendHeight + kAxisHeight + kLabelHeight + overview;
}
