import { svg } from "../page/element.js";

interface Box {
  left: number;
  right: number;
  top: number;
  bottom: number;
}

const kLeast = 6; // px; less is a click

/** Calls back with the rectangle that the mouse has drawn, in fractions of the picture. */
export function followDrag(picture: SVGSVGElement, onBox: (box: Box) => void): void {
  let start: PointerEvent | undefined;
  let mark: SVGRectElement | undefined;
  const rectangle = (from: PointerEvent, to: PointerEvent) => {
    const box = picture.getBoundingClientRect();
    return {
      left: Math.min(from.clientX, to.clientX) - box.left,
      right: Math.max(from.clientX, to.clientX) - box.left,
      top: Math.min(from.clientY, to.clientY) - box.top,
      bottom: Math.max(from.clientY, to.clientY) - box.top,
      width: box.width,
      height: box.height,
    };
  };
  picture.addEventListener("pointerdown", (event) => {
    if (event.pointerType === "touch" || event.button !== 0) return;
    start = event;
    picture.setPointerCapture(event.pointerId);
  });
  picture.addEventListener("pointermove", (event) => {
    if (!start) return;
    const { left, right, top, bottom } = rectangle(start, event);
    mark ??= svg("rect", { class: "selection" });
    mark.setAttribute("x", String(left));
    mark.setAttribute("y", String(top));
    mark.setAttribute("width", String(right - left));
    mark.setAttribute("height", String(bottom - top));
    picture.append(mark);
  });
  picture.addEventListener("pointerup", (event) => {
    const from = start;
    start = undefined;
    mark?.remove();
    mark = undefined;
    if (!from) return;
    const { left, right, top, bottom, width, height } = rectangle(from, event);
    if (right - left < kLeast || bottom - top < kLeast) return;
    onBox({ left: left / width, right: right / width, top: top / height, bottom: bottom / height });
  });
  picture.addEventListener("pointercancel", () => {
    start = undefined;
    mark?.remove();
    mark = undefined;
  });
}
