import type { Fact } from "../contract.js";
import { html } from "./element.js";

export function factList(facts: Fact[], name: string): HTMLElement {
  const list = html("dl", { class: name });
  for (const fact of facts) {
    list.append(html("div", {}, html("dt", {}, fact.label), html("dd", {}, fact.value)));
  }
  return list;
}
