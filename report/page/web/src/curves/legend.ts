import { numberText, quantityText } from "../axes/number_text.js";
import type { CurvesPanel } from "../contract.js";
import { withUnit } from "../document/data_table.js";
import { button, html, svg } from "../page/element.js";
import type { Curve, Reading } from "./curve.js";
import { colourName, kRoleStyles } from "./role_style.js";

/** The quantity of a panel and its curves; a click hides or shows a curve. */
export class Legend {
  readonly element: HTMLElement;
  private readonly values = new Map<Curve, HTMLElement>();

  constructor(panel: CurvesPanel, curves: Curve[], hidden: Set<string>, onToggle: () => void) {
    this.element = html(
      "div",
      { class: "legend" },
      html("span", { class: "quantity" }, withUnit(panel.y.label, panel.y.unit)),
    );
    for (const curve of curves) {
      const { label, role, draw } = curve.series;
      const value = html("span", { class: "value" });
      this.values.set(curve, value);
      const entry = button("", { "aria-pressed": String(!hidden.has(label)), title: "Hide or show" }, () => {
        if (!hidden.delete(label)) hidden.add(label);
        entry.setAttribute("aria-pressed", String(!hidden.has(label)));
        onToggle();
      });
      entry.append(swatch(role, draw), html("span", { class: "name" }, label), value);
      this.element.append(entry);
    }
    const named = new Set<string>();
    for (const level of panel.levels) {
      if (level.label === "" || named.has(level.label)) continue;
      named.add(level.label);
      this.element.append(
        html("span", { class: "entry" }, swatch(level.role, "level"), html("span", { class: "name" }, level.label)),
      );
    }
  }

  /** The value of each curve at the cursor. */
  show(readings: Map<Curve, Reading | undefined>): void {
    for (const [curve, element] of this.values) element.textContent = readingText(readings.get(curve), "");
  }
}

export function readingText(reading: Reading | undefined, unit: string): string {
  if (reading === undefined || Number.isNaN(reading.y)) return "";
  if (reading.greatest !== undefined) {
    return `${numberText(reading.y)} … ${quantityText(reading.greatest, unit)}`;
  }
  const std = reading.std !== undefined && reading.std > 0 ? ` ± ${numberText(reading.std, 2)}` : "";
  return unit === "" ? numberText(reading.y) + std : `${numberText(reading.y)}${std} ${unit}`;
}

/** A sample of a stroke; its shape, too, says what is drawn. */
export function swatch(role: Curve["series"]["role"], draw: "line" | "stems" | "points" | "level"): SVGElement {
  const style = kRoleStyles[role];
  const line = { stroke: `var(--${colourName(role)})`, "stroke-width": style.width, fill: "none" };
  const picture = svg("svg", { class: "swatch", viewBox: "0 0 26 12", width: 26, height: 12, "aria-hidden": "true" });
  const dot = (x: number, y: number) => svg("circle", { cx: x, cy: y, r: 2.4, fill: line.stroke });
  if (draw === "points") picture.append(dot(5, 8), dot(13, 4), dot(21, 7));
  else if (draw === "stems") {
    picture.append(svg("path", { ...line, "stroke-width": 1.5, d: "M5 11V5M13 11V2M21 11V7" }), dot(5, 5), dot(13, 3), dot(21, 7));
  } else {
    const dash = draw === "level" ? "6 4" : style.dash.join(" ");
    picture.append(svg("path", { ...line, "stroke-dasharray": dash === "" ? undefined : dash, d: "M0 6H26" }));
  }
  return picture;
}
