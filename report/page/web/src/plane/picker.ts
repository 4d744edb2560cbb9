import type { Fact } from "../contract.js";
import { html, svg } from "../page/element.js";
import { factList } from "../page/facts.js";
import type { Plane, PlaneProjection } from "./plane.js";

/** A point of a plane that can be picked by pointer or keys. */
export interface Pickable {
  x: number;
  y: number;
  title: string;
  details: Fact[];
}

const kReach = 24; // px from the pointer

/** Marks the point at the pointer, or the one that the arrow keys have come to, and shows its details
 * beside it. */
export class Picker {
  private readonly card = html("div", { class: "card", hidden: true });
  private points: Pickable[] = [];
  private picked = -1;
  private layer: SVGGElement | undefined;
  private to: PlaneProjection | undefined;

  constructor(
    private readonly plane: Plane,
    private readonly speak: (text: string) => void,
  ) {
    plane.element.append(this.card);
    plane.element.addEventListener("pointermove", (event) => this.pickAt(event.clientX, event.clientY));
    plane.element.addEventListener("pointerdown", (event) => this.pickAt(event.clientX, event.clientY));
    plane.element.addEventListener("pointerleave", (event) => {
      if (event.pointerType !== "touch") this.clear();
    });
  }

  /** The points in the order in which keys go through them. */
  setPoints(points: Pickable[]): void {
    this.points = points;
    this.clear();
  }

  /** After the plane has been drawn anew. */
  showOn(layer: SVGGElement, to: PlaneProjection): void {
    this.layer = layer;
    this.to = to;
    this.show();
  }

  step(steps: number): void {
    if (this.points.length === 0) return;
    const from = this.picked < 0 ? (steps > 0 ? -1 : this.points.length) : this.picked;
    this.pick(Math.max(0, Math.min(this.points.length - 1, from + steps)));
  }

  toEnd(end: "first" | "last"): void {
    if (this.points.length > 0) this.pick(end === "first" ? 0 : this.points.length - 1);
  }

  clear(): void {
    this.picked = -1;
    this.show();
  }

  private pick(i: number): void {
    this.picked = i;
    this.show();
    const point = this.points[i];
    if (!point) return;
    const details = point.details.map((fact) => `${fact.label} ${fact.value}`);
    this.speak([`${point.title}, ${i + 1} of ${this.points.length}`, ...details].join("; "));
  }

  private pickAt(clientX: number, clientY: number): void {
    const { to } = this;
    if (!to) return;
    const box = this.plane.element.getBoundingClientRect();
    const [x, y] = [clientX - box.left, clientY - box.top];
    let nearest = -1;
    let distance = kReach;
    this.points.forEach((point, i) => {
      const d = Math.hypot(to.x(point.x) - x, to.y(point.y) - y);
      if (d < distance) {
        distance = d;
        nearest = i;
      }
    });
    if (nearest === this.picked) return;
    this.picked = nearest;
    this.show();
  }

  private show(): void {
    const { layer, to, card } = this;
    layer?.querySelector(".picked")?.remove();
    const point = this.points[this.picked];
    card.hidden = !point;
    if (!point || !layer || !to) return;
    const [x, y] = [to.x(point.x), to.y(point.y)];
    layer.append(svg("circle", { cx: x, cy: y, r: 11, class: "picked" }));
    card.replaceChildren(html("p", {}, point.title), factList(point.details, "card-facts"));
    const width = this.plane.element.clientWidth;
    // To the side with more room.
    card.style.left = x < width / 2 ? `${x + 16}px` : "auto";
    card.style.right = x < width / 2 ? "auto" : `${width - x + 16}px`;
    card.style.top = `${Math.max(0, Math.min(y - 20, to.bottom - card.offsetHeight))}px`;
  }
}
