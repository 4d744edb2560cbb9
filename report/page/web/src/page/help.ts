import { html } from "./element.js";

const kKeys: [string, string][] = [
  ["←  →", "cursor to the next sample; with Shift by a tenth of the view"],
  ["Home  End", "cursor to the first or last sample in view"],
  ["+  −", "zoom at the cursor"],
  ["Esc", "the whole range again"],
];

const kGestures: [string, string][] = [
  ["drag", "zoom to the range; upright drags zoom the vertical axis"],
  ["Ctrl + wheel, pinch", "zoom at the pointer; Shift + wheel moves the range"],
  ["double click", "the whole range again"],
  ["legend", "shows values at the cursor; a click hides or shows a curve"],
];

/** How plots are used. */
export function helpElement(): HTMLElement {
  const list = html("dl", { class: "keys" });
  for (const [keys, action] of [...kKeys, ...kGestures]) {
    list.append(html("div", {}, html("dt", {}, html("kbd", {}, keys)), html("dd", {}, action)));
  }
  return html("details", { class: "help" }, html("summary", {}, "Keys and gestures of the plots"), list);
}
