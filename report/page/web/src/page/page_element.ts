import { blockContent } from "../blocks/block_content.js";
import type { Block, PageDocument, Section } from "../contract.js";
import type { Arrays } from "../document/arrays.js";
import { blockFrame, failedFrame } from "./block_frame.js";
import { contentsElement, followReading } from "./contents.js";
import { html } from "./element.js";
import { helpElement } from "./help.js";
import { themeSwitch } from "./theme.js";
import { verdictElement } from "./verdict.js";

/** The whole page. */
export function pageElement(page: PageDocument, arrays: Arrays): HTMLElement[] {
  const sections = page.sections.map((section) => sectionElement(section, arrays));
  const contents = contentsElement(page.sections);
  followReading(contents, sections);
  const header = html(
    "header",
    { class: "top" },
    html("h1", {}, page.title),
    html("div", { class: "tools" }, page.date === "" ? undefined : html("time", { datetime: page.date }, page.date), themeSwitch()),
  );
  const first = html("section", { class: "first", "aria-label": "Verdict" }, verdictElement(page));
  if (page.headline) first.append(frameOf(page.headline, arrays, 2));
  const rest = html("div", { class: "sections" }, ...sections);
  const footer = html(
    "footer",
    {},
    helpElement(),
    html("p", {}, `Made by ${page.program} with `, html("code", {}, page.command)),
  );
  const skip = html("a", { class: "skip", href: "#verdict" }, "Skip to the verdict");
  return [skip, header, html("main", {}, first, contents, rest), footer];
}

function sectionElement(section: Section, arrays: Arrays): HTMLElement {
  const titleId = `${section.id}-title`;
  const element = html("section", { id: section.id, "aria-labelledby": titleId });
  element.append(html("h2", { id: titleId }, section.title));
  for (const paragraph of section.text) element.append(html("p", {}, paragraph));
  for (const block of section.blocks) element.append(frameOf(block, arrays, 3));
  if (section.text.length === 0 && section.blocks.length === 0) {
    element.append(html("p", { class: "note" }, "No data."));
  }
  return element;
}

function frameOf(block: Block, arrays: Arrays, level: 2 | 3): HTMLElement {
  try {
    return blockFrame(block, blockContent(block, arrays), level);
  } catch (error) {
    return failedFrame(block, level, error);
  }
}
