import { html } from "../page/element.js";

interface View {
  labels: string[];
}

/** Selectors for one of several views, one for each name in `choices`. The order is that of the
 * program, worst first. */
export function viewChoice(
  blockId: string,
  choices: string[],
  views: View[],
  onChoose: (view: number) => void,
): HTMLElement {
  const element = html("div", { class: "choices" });
  if (views.length < 2) {
    const labels = (views[0]?.labels ?? []).filter((label) => label !== "");
    choices.forEach((choice, i) => {
      if (labels[i] !== undefined) element.append(html("span", { class: "only" }, `${choice}: ${labels[i]}`));
    });
    return element;
  }
  const chosen = [...(views[0]?.labels ?? [])];
  const selects = choices.map((choice, i) => {
    const select = html("select", { id: `${blockId}-choice-${i}` });
    select.addEventListener("change", () => choose(i, select.value));
    element.append(html("label", {}, choice, select));
    return select;
  });
  const fill = () => {
    selects.forEach((select, i) => {
      // Those that exist beside what the selectors before it say.
      const fitting = views.filter((view) => chosen.slice(0, i).every((label, k) => label === view.labels[k]));
      const labels = [...new Set(fitting.map((view) => view.labels[i] ?? ""))];
      select.replaceChildren(...labels.map((label) => html("option", { value: label }, label)));
      select.value = chosen[i] ?? "";
    });
  };
  const choose = (which: number, label: string) => {
    const matches = (view: View) =>
      view.labels[which] === label && view.labels.slice(0, which).every((other, k) => other === chosen[k]);
    const agreement = (view: View) => view.labels.filter((other, k) => other === chosen[k]).length;
    let best = -1;
    views.forEach((view, i) => {
      const bestView = views[best];
      if (matches(view) && (!bestView || agreement(view) > agreement(bestView))) best = i;
    });
    const view = views[best];
    if (!view) return;
    chosen.splice(0, chosen.length, ...view.labels);
    fill();
    onChoose(best);
  };
  fill();
  return element;
}
