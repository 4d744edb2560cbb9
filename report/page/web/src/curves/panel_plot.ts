import uPlot from "uplot";

import { linearTicks, logTicks, type Tick } from "../axes/ticks.js";
import type { Axis, CurvesPanel } from "../contract.js";
import { colour } from "../page/theme.js";
import { html } from "../page/element.js";
import { type Curve, joined, kEmpty, type Projection, type Range, type Reading } from "./curve.js";
import { colourName, kRoleStyles } from "./role_style.js";

const kFont = "system-ui, sans-serif";
const kFontSize = 12;
const kTickSpacing_x = 80; // px
const kTickSpacing_y = 27;
const kAloneWidth = 1.4; // px of the only curve of a panel
const kMargin = 0.06; // of the range of y, above and below

export interface PanelOptions {
  panel: CurvesPanel;
  curves: Curve[];
  xAxis: Axis;
  x: Range;
  width: number;
  height: number;
  isLowest: boolean;
  /** Pixels of the canvas in one of the layout, besides the screen's ratio: above 1 for paper. */
  scale: number;
  isShown(curve: Curve): boolean;
  /** After a drag: the ranges of the rectangle, of what was dragged along. */
  onSelect(ranges: { x?: Range; y?: Range }): void;
  /** The pointer is at x; undefined: it has left. */
  onPointer(x: number | undefined): void;
}

/** One panel: uPlot has the axes, the cross hair and the selection, the curves paint themselves. */
export class PanelPlot {
  readonly plot: uPlot;
  /** Set while y is zoomed by hand. */
  private yChosen: Range | undefined;
  private isPlacingCursor = false;
  private dots: HTMLElement[] = [];

  constructor(
    place: HTMLElement,
    private readonly options: PanelOptions,
  ) {
    const { scale } = options;
    const font = `${kFontSize * scale}px ${kFont}`;
    const grid = { stroke: () => colour("grid"), width: scale };
    const axis = (which: "x" | "y"): uPlot.Axis => ({
      scale: which,
      font,
      stroke: () => colour("text-soft"),
      grid,
      ticks: { ...grid, size: 4 * scale },
      gap: 4 * scale,
      size: (which === "x" ? (options.isLowest ? 26 : 8) : yAxisWidth(options.width / scale)) * scale,
      splits: (plot) => this.ticks(plot, which).map((tick) => tick.value),
      values: (plot) =>
        which === "x" && !options.isLowest ? [] : this.ticks(plot, which).map((tick) => tick.text),
      filter: (_plot, splits) => splits,
    });
    this.plot = new uPlot(
      {
        width: options.width,
        height: options.height,
        padding: [8 * scale, 12 * scale, 0, 0],
        legend: { show: false },
        scales: {
          x: this.scaleOf(options.xAxis, () => this.options.x),
          y: this.scaleOf(options.panel.y, () => this.yRange()),
        },
        axes: [axis("x"), axis("y")],
        series: [{}, {}],
        cursor: {
          points: { show: false },
          y: false,
          drag: { x: true, y: true, uni: 30, dist: 5, setScale: false },
          bind: { dblclick: () => null },
        },
        hooks: {
          drawAxes: [() => this.paint()],
          setSelect: [(plot) => this.selected(plot)],
          setCursor: [(plot) => this.pointed(plot)],
        },
      },
      [
        [0, 1],
        [null, null],
      ],
      place,
    );
    this.showRange(options.x);
  }

  showRange(x: Range): void {
    this.options.x = x;
    this.plot.batch(() => {
      this.plot.setScale("x", { min: x.least, max: x.greatest });
      const y = this.yRange();
      this.plot.setScale("y", { min: y.least, max: y.greatest });
    });
  }

  chooseY(y: Range | undefined): void {
    this.yChosen = y;
    this.showRange(this.options.x);
  }

  get isYChosen(): boolean {
    return this.yChosen !== undefined;
  }

  resize(width: number, height: number): void {
    this.plot.setSize({ width, height });
  }

  placeCursor(x: number | undefined): void {
    this.isPlacingCursor = true;
    const left = x === undefined ? -10 : this.plot.valToPos(x, "x");
    this.plot.setCursor({ left, top: x === undefined ? -10 : 0 }, false);
    this.isPlacingCursor = false;
  }

  /** A dot on each curve at the cursor. */
  showDots(readings: Map<Curve, Reading | undefined>): void {
    for (const dot of this.dots) dot.remove();
    this.dots = [];
    const { over } = this.plot;
    for (const [curve, reading] of readings) {
      if (!reading || !this.options.isShown(curve)) continue;
      const left = this.plot.valToPos(reading.x, "x");
      for (const y of [reading.y, reading.greatest]) {
        if (y === undefined) continue;
        const top = this.plot.valToPos(y, "y");
        if (!(left >= 0 && left <= over.clientWidth && top >= 0 && top <= over.clientHeight)) continue;
        const dot = html("div", { class: "cursor-dot" });
        dot.style.left = `${left}px`;
        dot.style.top = `${top}px`;
        dot.style.background = `var(--${colourName(curve.series.role)})`;
        over.append(dot);
        this.dots.push(dot);
      }
    }
  }

  private scaleOf(axis: Axis, range: () => Range): uPlot.Scale {
    return {
      time: false,
      auto: false,
      distr: axis.scale === "log" ? 3 : 1,
      range: (_plot, min, max) => (min === null || max === null ? [range().least, range().greatest] : [min, max]),
    };
  }

  private ticks(plot: uPlot, which: "x" | "y"): Tick[] {
    const axis = which === "x" ? this.options.xAxis : this.options.panel.y;
    const { min = 0, max = 1 } = plot.scales[which] ?? {};
    const length = (which === "x" ? plot.bbox.width : plot.bbox.height) / devicePixelRatio / this.options.scale;
    const most = Math.max(2, length / (which === "x" ? kTickSpacing_x : kTickSpacing_y));
    return axis.scale === "log" ? logTicks(min, max, most) : linearTicks(min, max, most, axis.unit);
  }

  /** The range of y: chosen, that of the axis, or of the data in view. */
  private yRange(): Range {
    const { panel, curves, x } = this.options;
    if (this.yChosen) return this.yChosen;
    if (panel.y.range) return { least: panel.y.range[0], greatest: panel.y.range[1] };
    const isLog = panel.y.scale === "log";
    let range = { ...kEmpty };
    for (const curve of curves) {
      if (this.options.isShown(curve)) range = joined(range, curve.yExtent(x, isLog));
    }
    for (const level of panel.levels) {
      if (!isLog || level.y > 0) range = joined(range, { least: level.y, greatest: level.y });
    }
    return widened(range, isLog);
  }

  private paint(): void {
    const { plot, options } = this;
    const { left, top, width, height } = plot.bbox;
    const scale = devicePixelRatio * options.scale;
    const to: Projection = {
      x: (value) => plot.valToPos(value, "x", true),
      y: (value) => plot.valToPos(value, "y", true),
      left,
      right: left + width,
      scale,
      isLogY: options.panel.y.scale === "log",
    };
    const { ctx } = plot;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.lineJoin = "round";
    for (const curve of options.curves) {
      if (!options.isShown(curve)) continue;
      const { role } = curve.series;
      const { width, dash } = kRoleStyles[role];
      // What is measured is broad for the sake of what lies on it.
      const ownWidth = options.curves.length > 1 ? width : Math.min(width, kAloneWidth);
      curve.paint(ctx, to, options.x, { dash, width: ownWidth, colour: colour(colourName(role)) });
    }
    this.paintLevels(ctx, to);
    ctx.restore();
  }

  private paintLevels(ctx: CanvasRenderingContext2D, to: Projection): void {
    for (const level of this.options.panel.levels) {
      const style = kRoleStyles[level.role];
      ctx.strokeStyle = colour(colourName(level.role));
      ctx.lineWidth = style.width * to.scale;
      ctx.setLineDash([6 * to.scale, 4 * to.scale]);
      ctx.beginPath();
      ctx.moveTo(to.left, to.y(level.y));
      ctx.lineTo(to.right, to.y(level.y));
      ctx.stroke();
    }
    ctx.setLineDash([]);
  }

  private selected(plot: uPlot): void {
    const { left, top, width, height } = plot.select;
    if (width === 0 && height === 0) return;
    const fullHeight = plot.over.clientHeight;
    const fullWidth = plot.over.clientWidth;
    const ranges: { x?: Range; y?: Range } = {};
    if (width > 0 && width < fullWidth) {
      ranges.x = { least: plot.posToVal(left, "x"), greatest: plot.posToVal(left + width, "x") };
    }
    if (height > 0 && height < fullHeight) {
      ranges.y = { least: plot.posToVal(top + height, "y"), greatest: plot.posToVal(top, "y") };
    }
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.options.onSelect(ranges);
  }

  private pointed(plot: uPlot): void {
    if (this.isPlacingCursor) return;
    const left = plot.cursor.left ?? -10;
    this.options.onPointer(left < 0 ? undefined : plot.posToVal(left, "x"));
  }
}

export function yAxisWidth(width: number): number {
  return width < 500 ? 50 : 62;
}

/** With a margin, and never empty. */
function widened(range: Range, isLog: boolean): Range {
  if (range.least > range.greatest) return isLog ? { least: 1, greatest: 10 } : { least: -1, greatest: 1 };
  if (isLog) {
    const margin = Math.max((range.greatest / range.least) ** kMargin, 1.1);
    return { least: range.least / margin, greatest: range.greatest * margin };
  }
  const span = range.greatest - range.least;
  const size = Math.max(Math.abs(range.least), Math.abs(range.greatest));
  const margin = span > 1e-12 * size ? span * kMargin : size > 0 ? 0.1 * size : 1;
  return { least: range.least - margin, greatest: range.greatest + margin };
}
