import type { Section } from "../contract.js";
import { html } from "./element.js";

/** The list of the sections; the one that is read is marked. */
export function contentsElement(sections: Section[]): HTMLElement {
  const links = new Map(
    sections.map((section) => [section.id, html("a", { href: `#${section.id}` }, section.title)]),
  );
  const list = html("ol", {}, ...[...links.values()].map((link) => html("li", {}, link)));
  // On a narrow screen it stands between the verdict and the sections.
  const isOpen = matchMedia("(min-width: 861px)").matches;
  const details = html("details", { open: isOpen }, html("summary", {}, "Contents"), list);
  return html("nav", { class: "contents", "aria-label": "Contents" }, details);
}

/** Marks the link of the section at the top of the window. */
export function followReading(contents: HTMLElement, sections: HTMLElement[]): void {
  const inView = new Set<Element>();
  const observer = new IntersectionObserver(
    (entries) => {
      for (const entry of entries) {
        if (entry.isIntersecting) inView.add(entry.target);
        else inView.delete(entry.target);
      }
      const current = sections.find((section) => inView.has(section));
      for (const link of contents.querySelectorAll("a")) {
        const isCurrent = link.hash === `#${current?.id}`;
        if (isCurrent) link.setAttribute("aria-current", "true");
        else link.removeAttribute("aria-current");
      }
    },
    { rootMargin: "0px 0px -60% 0px" },
  );
  for (const section of sections) observer.observe(section);
}
