import { button } from "./element.js";

type Theme = "light" | "dark";

const listeners: (() => void)[] = [];
const systemIsDark = matchMedia("(prefers-color-scheme: dark)");
let chosen: Theme | undefined;
let printing = false;

function shown(): Theme {
  if (printing) return "light";
  return chosen ?? (systemIsDark.matches ? "dark" : "light");
}

function apply(): void {
  document.documentElement.dataset["theme"] = shown();
  for (const listener of listeners) listener();
}

/** Calls back when colours have changed, for what does not follow the style sheet. */
export function onThemeChange(listener: () => void): void {
  listeners.push(listener);
}

const printers: ((on: boolean) => void)[] = [];

/** Calls back before the page is printed, when its colours are those of paper, and afterwards. */
export function onPaper(printer: (on: boolean) => void): void {
  printers.push(printer);
}

/** Paper is light, whatever the screen is. */
export function setPrinting(on: boolean): void {
  printing = on;
  apply();
  for (const printer of printers) printer(on);
}

/** As the system has it, until the button is used. */
export function themeSwitch(): HTMLButtonElement {
  const toggle = button("Dark", { class: "theme", "aria-pressed": "false" }, () => {
    chosen = shown() === "dark" ? "light" : "dark";
    apply();
  });
  onThemeChange(() => toggle.setAttribute("aria-pressed", String(shown() === "dark")));
  systemIsDark.addEventListener("change", apply);
  apply();
  return toggle;
}

/** The value of a colour of the style sheet, for canvases. */
export function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}
