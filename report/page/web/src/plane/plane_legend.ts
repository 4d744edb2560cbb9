import type { Role } from "../contract.js";
import { colourName, kRoleStyles } from "../curves/role_style.js";
import { button, html, svg } from "../page/element.js";
import { type Mark, markPath } from "./marks.js";

export interface Entry {
  name: string;
  role: Role;
  shape: Mark | "line" | "points";
}

/** What is in a plane; a click hides or shows it. */
export function planeLegend(entries: Entry[], hidden: Set<string>, onToggle: () => void): HTMLElement {
  const element = html("div", { class: "legend" });
  for (const { name, role, shape } of entries) {
    const entry = button("", { "aria-pressed": String(!hidden.has(name)), title: "Hide or show" }, () => {
      if (!hidden.delete(name)) hidden.add(name);
      entry.setAttribute("aria-pressed", String(!hidden.has(name)));
      onToggle();
    });
    entry.append(shapeSwatch(role, shape), html("span", { class: "name" }, name));
    element.append(entry);
  }
  return element;
}

function shapeSwatch(role: Role, shape: Entry["shape"]): SVGElement {
  const stroke = `var(--${colourName(role)})`;
  const isMark = shape !== "line" && shape !== "points";
  const size = isMark ? 14 : 26;
  const picture = svg("svg", { class: "swatch", viewBox: `0 0 ${size} 14`, width: size, height: 14, "aria-hidden": "true" });
  const style = kRoleStyles[role];
  if (shape === "points") {
    for (const [x, y] of [[5, 8], [13, 4], [21, 9]] as const) picture.append(svg("circle", { cx: x, cy: y, r: 2, fill: stroke }));
  } else {
    const d = isMark ? markPath(shape, 7, 7, 4) : "M0 7H26";
    const dash = isMark || style.dash.length === 0 ? undefined : style.dash.join(" ");
    picture.append(svg("path", { d, stroke, fill: "none", "stroke-width": isMark ? 1.6 : style.width, "stroke-dasharray": dash }));
  }
  return picture;
}
