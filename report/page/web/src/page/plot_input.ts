/** Gestures and keys that all plots share. Fractions are of the plot's width and height, from its
 * left and its top. */
export interface PlotInput {
  /** By factor about a place; above 1 enlarges. Without a place: about the cursor. */
  zoom(factor: number, at?: { x: number; y: number }): void;
  pan(x: number, y: number): void;
  reset(): void;
  /** Steps of the cursor; coarse: a tenth of the view each. */
  step(steps: number, coarse: boolean, upright: boolean): void;
  toEnd(end: "first" | "last"): void;
}

const kWheelZoom = 0.0022; // of the logarithm of the factor, a pixel
const kLinePixels = 16; // of a wheel that counts lines
const kKeyZoom = 1.5;

/** Keys of a plot that has the focus. */
export function followKeys(plot: HTMLElement, input: PlotInput): void {
  const actions: Record<string, (event: KeyboardEvent) => void> = {
    ArrowLeft: (event) => input.step(-1, event.shiftKey, false),
    ArrowRight: (event) => input.step(1, event.shiftKey, false),
    ArrowUp: (event) => input.step(1, event.shiftKey, true),
    ArrowDown: (event) => input.step(-1, event.shiftKey, true),
    Home: () => input.toEnd("first"),
    End: () => input.toEnd("last"),
    "+": () => input.zoom(kKeyZoom),
    "=": () => input.zoom(kKeyZoom),
    "-": () => input.zoom(1 / kKeyZoom),
    Escape: () => input.reset(),
  };
  plot.addEventListener("keydown", (event) => {
    if (event.target !== plot || event.ctrlKey || event.metaKey || event.altKey) return;
    const action = actions[event.key];
    if (action === undefined) return;
    event.preventDefault();
    action(event);
  });
}

/** Wheel, pinch and double click on the area of a plot. The wheel alone scrolls the page. */
export function followGestures(area: HTMLElement | SVGElement, input: PlotInput): void {
  const place = (x: number, y: number) => {
    const box = area.getBoundingClientRect();
    return { x: (x - box.left) / box.width, y: (y - box.top) / box.height };
  };
  const onWheel = (event: WheelEvent) => {
    const unit = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? kLinePixels : 1;
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      input.zoom(Math.exp(-event.deltaY * unit * kWheelZoom), place(event.clientX, event.clientY));
    } else if (event.shiftKey || Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      event.preventDefault();
      input.pan(((event.shiftKey ? event.deltaX || event.deltaY : event.deltaX) * unit) / area.clientWidth, 0);
    }
  };
  area.addEventListener("wheel", (event) => onWheel(event as WheelEvent), { passive: false });
  area.addEventListener("dblclick", () => input.reset());
  followPinch(area, input, place);
}

type Place = (x: number, y: number) => { x: number; y: number };

function followPinch(area: HTMLElement | SVGElement, input: PlotInput, place: Place): void {
  const touches = new Map<number, PointerEvent>();
  const grip = () => {
    const [a, b] = [...touches.values()];
    if (!a || !b) return undefined;
    return {
      distance: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY),
      middle: place((a.clientX + b.clientX) / 2, (a.clientY + b.clientY) / 2),
    };
  };
  area.addEventListener("pointerdown", (event) => {
    const pointer = event as PointerEvent;
    if (pointer.pointerType === "touch") touches.set(pointer.pointerId, pointer);
  });
  area.addEventListener("pointermove", (event) => {
    const pointer = event as PointerEvent;
    if (!touches.has(pointer.pointerId)) return;
    const before = grip();
    touches.set(pointer.pointerId, pointer);
    const after = grip();
    if (!before || !after || before.distance === 0) return;
    input.zoom(after.distance / before.distance, before.middle);
    input.pan(before.middle.x - after.middle.x, before.middle.y - after.middle.y);
  });
  for (const end of ["pointerup", "pointercancel"]) {
    area.addEventListener(end, (event) => touches.delete((event as PointerEvent).pointerId));
  }
}
