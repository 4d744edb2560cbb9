import type { PageDocument, Verdict } from "../contract.js";
import { html, svg } from "./element.js";
import { factList } from "./facts.js";

/** Signs that differ in shape: tick, half disc, cross, bar. */
const kSigns: Record<Verdict["status"], string> = {
  good: "M6 12.5l4 4 8-9",
  partial: "M12 5a7 7 0 0 0 0 14z",
  bad: "M7 7l10 10M17 7L7 17",
  neutral: "M7 12h10",
};

/** The first screen without its picture: what came out, and the numbers beside it. */
export function verdictElement(page: PageDocument): HTMLElement {
  const { verdict } = page;
  const sign = svg(
    "svg",
    { viewBox: "0 0 24 24", class: "sign", "aria-hidden": "true" },
    svg("circle", { cx: 12, cy: 12, r: 11 }),
    svg("path", { d: kSigns[verdict.status], class: verdict.status === "partial" ? "area" : "stroke" }),
  );
  return html(
    "div",
    { class: `verdict ${verdict.status}`, id: "verdict" },
    html("p", { class: "word" }, sign, verdict.word),
    html("p", { class: "sentence" }, verdict.sentence),
    page.results.length > 0 ? factList(page.results, "results") : undefined,
    page.facts.length > 0 ? factList(page.facts, "facts") : undefined,
    page.next_step === "" ? undefined : html("p", { class: "next" }, html("strong", {}, "Next step: "), page.next_step),
  );
}
