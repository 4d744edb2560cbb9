import { numberText, quantityText } from "../axes/number_text.js";
import type { MapBlock, MapPoint } from "../contract.js";
import { colourName } from "../curves/role_style.js";
import type { BlockContent } from "../page/block_frame.js";
import { button, html, svg } from "../page/element.js";
import { kPaperWidth } from "../page/paper.js";
import { linearMap, signedLogMap } from "../plane/axis_map.js";
import { placeLabels } from "../plane/labels.js";
import { kMarkWords, type Mark, markOf, markPath } from "../plane/marks.js";
import { Picker, type Pickable } from "../plane/picker.js";
import { Plane, type PlaneProjection } from "../plane/plane.js";
import { type Entry, planeLegend } from "../plane/plane_legend.js";
import { keepDrawn, plotBox, resetButton } from "../plane/plot_box.js";
import { Speech } from "./speech.js";

const kMarkSize = 5; // px
const kNestedSizes = [7.5, 5.5, 4, 3]; // of several series: where they coincide each shows
const kSmallMark = 3.5; // where there are many
const kMany = 200;

const kBarsHeight = 100; // of tools and legend

function planeHeight(width: number): number {
  return Math.round(Math.min(Math.max(320, width * 0.7), 560));
}

interface Group {
  entry: Entry;
  size: number;
  points: MapPoint[];
}

/** Poles and zeros in the s plane. */
export function mapBlock(block: MapBlock): BlockContent {
  const groups = groupsOf(block.points);
  const hidden = new Set<string>();
  const speech = new Speech();
  const reset = resetButton(() => plane.reset());
  const place = html("div", {});
  let isSignedLog = block.x.scale === "log" || block.y.scale === "log";
  let plane: Plane;
  let picker: Picker;

  const shown = () => groups.filter((group) => !hidden.has(group.entry.name));
  const build = () => {
    const map = (axis: "x" | "y") => {
      const part = axis === "x" ? "real" : "imaginary";
      return isSignedLog ? signedLogMap(block.points.map((point) => point[part])) : linearMap(block[axis]);
    };
    plane = new Plane({
      x: block.x,
      y: block.y,
      xMap: map("x"),
      yMap: map("y"),
      equalScales: false,
      height: planeHeight,
      onZoom: (isZoomed) => {
        reset.hidden = !isZoomed;
      },
      paint: (layer, to) => {
        shadeRightHalfPlane(layer, to);
        for (const group of shown()) paintGroup(layer, to, group);
        paintLabels(layer, to, shown());
        picker.showOn(layer, to);
      },
    });
    plane.setHome(
      block.points.map((point) => point.real),
      block.points.map((point) => point.imaginary),
    );
    picker = new Picker(plane, (text) => speech.say(text));
    picker.setPoints(pickables(block, shown()));
    const box = plotBox(plane, picker, block.title);
    place.replaceChildren(box);
    reset.hidden = true;
    keepDrawn(plane, box, kPaperWidth);
  };
  const legend = planeLegend(
    groups.map((group) => group.entry),
    hidden,
    () => {
      picker.setPoints(pickables(block, shown()));
      plane.draw();
    },
  );
  const scale = button("Logarithmic", { class: "toggle", "aria-pressed": String(isSignedLog) }, () => {
    isSignedLog = !isSignedLog;
    scale.setAttribute("aria-pressed", String(isSignedLog));
    build();
  });
  const tools = html("div", { class: "view-bar" }, scale, html("span", { class: "at-cursor" }, reset));
  return {
    element:
      block.points.length > 0
        ? html("div", {}, tools, legend, place, speech.element)
        : html("p", { class: "note" }, "No poles or zeros."),
    height: (width) => (block.points.length > 0 ? planeHeight(width) + kBarsHeight : 0),
    draw: build,
    files: () => [{ label: "CSV", name: block.id, table: () => mapTable(block) }],
  };
}

function groupsOf(points: MapPoint[]): Group[] {
  const groups = new Map<string, Group>();
  const series = [...new Set(points.map((point) => point.series))];
  const sizeOf = (name: string) => {
    if (points.length > kMany) return kSmallMark;
    if (series.length === 1) return kMarkSize;
    return kNestedSizes[Math.min(series.indexOf(name), kNestedSizes.length - 1)] ?? kMarkSize;
  };
  for (const point of points) {
    const mark = markOf(point);
    const name = `${point.series}, ${kMarkWords[mark]}s`;
    const group = groups.get(name) ?? {
      entry: { name, role: point.role, shape: mark },
      size: sizeOf(point.series),
      points: [],
    };
    group.points.push(point);
    groups.set(name, group);
  }
  return [...groups.values()];
}

function paintGroup(layer: SVGGElement, to: PlaneProjection, { entry, size, points }: Group): void {
  const colour = `var(--${colourName(entry.role)})`;
  const bars: string[] = [];
  const marks: string[] = [];
  for (const point of points) {
    const [x, y] = [to.x(point.real), to.y(point.imaginary)];
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    const { real_std: realStd = 0, imaginary_std: imaginaryStd = 0 } = point;
    if (realStd > 0) bars.push(`M${to.x(point.real - realStd)} ${y}H${to.x(point.real + realStd)}`);
    if (imaginaryStd > 0) bars.push(`M${x} ${to.y(point.imaginary - imaginaryStd)}V${to.y(point.imaginary + imaginaryStd)}`);
    marks.push(markPath(entry.shape as Mark, x, y, size));
  }
  layer.append(
    svg("path", { d: bars.join(""), stroke: colour, class: "bars" }),
    svg("path", { d: marks.join(""), stroke: colour, class: `marks ${entry.shape}` }),
  );
}

function shadeRightHalfPlane(layer: SVGGElement, to: PlaneProjection): void {
  const left = Math.max(to.x(0), to.left);
  if (left >= to.right) return;
  const box = { x: left, y: to.top, width: to.right - left, height: to.bottom - to.top };
  layer.append(svg("rect", { ...box, class: "right-half" }));
}

/** The first detail of each root of the first series; its conjugate has the same, and those of the
 * other series lie close by. */
function paintLabels(layer: SVGGElement, to: PlaneProjection, groups: Group[]): void {
  const points = groups.flatMap((group) => group.points);
  const labels = points
    .filter((point) => point.series === points[0]?.series)
    .filter((point) => point.imaginary >= 0 && point.details.length > 0)
    .map((point) => ({ x: to.x(point.real), y: to.y(point.imaginary), text: point.details[0]?.value ?? "" }))
    .filter(({ x, y }) => x >= to.left && x <= to.right && y >= to.top && y <= to.bottom);
  placeLabels(layer, labels, to);
}

function pickables(block: MapBlock, groups: Group[]): Pickable[] {
  return groups
    .flatMap((group) => group.points)
    .sort((a, b) => Math.hypot(a.real, a.imaginary) - Math.hypot(b.real, b.imaginary))
    .map((point) => ({
      x: point.real,
      y: point.imaginary,
      title: `${point.series}: ${kMarkWords[markOf(point)]}`,
      details: [
        ...point.details,
        { label: block.x.label, value: withStd(point.real, point.real_std, block.x.unit) },
        { label: block.y.label, value: withStd(point.imaginary, point.imaginary_std, block.y.unit) },
      ],
    }));
}

function withStd(value: number, std: number | undefined, unit: string): string {
  if (std === undefined || !(std > 0)) return quantityText(value, unit);
  return `${numberText(value)} ± ${numberText(std, 2)}${unit === "" ? "" : ` ${unit}`}`;
}

function mapTable(block: MapBlock) {
  const details = [...new Set(block.points.flatMap((point) => point.details.map((fact) => fact.label)))];
  const hasStd = block.points.some((point) => point.real_std !== undefined || point.imaginary_std !== undefined);
  const columns: { title: string; unit: string; cell(point: MapPoint): number | string }[] = [
    { title: "series", unit: "", cell: (point) => point.series },
    { title: "root", unit: "", cell: (point) => kMarkWords[markOf(point)] },
    { title: block.x.label, unit: block.x.unit, cell: (point) => point.real },
    { title: block.y.label, unit: block.y.unit, cell: (point) => point.imaginary },
  ];
  if (hasStd) {
    const title = (axis: "x" | "y") => `${block[axis].label}, standard deviation`;
    columns.push(
      { title: title("x"), unit: block.x.unit, cell: (point) => point.real_std ?? NaN },
      { title: title("y"), unit: block.y.unit, cell: (point) => point.imaginary_std ?? NaN },
    );
  }
  for (const label of details) {
    columns.push({
      title: label,
      unit: "",
      cell: (point) => point.details.find((fact) => fact.label === label)?.value ?? "",
    });
  }
  return {
    columns: columns.map(({ title, unit }, i) => ({ title, unit, numeric: i > 1 })),
    rowCount: block.points.length,
    cell: (row: number, column: number) => {
      const point = block.points[row];
      return point ? (columns[column]?.cell(point) ?? "") : "";
    },
  };
}
