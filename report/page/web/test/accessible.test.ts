import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";

import type { Page } from "playwright-core";

import { opened } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { edgeSample } from "./samples/other_documents.js";
import { written } from "./samples/written_page.js";

const addresses = {
  diagnosis: written("diagnosis", diagnosisSample(2)),
  edges: written("edges", edgeSample()),
};
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

interface Violation {
  id: string;
  nodes: { html: string; failureSummary?: string }[];
}

/** Draws all, opens a table and the details, and asks axe-core. */
async function violations(page: Page): Promise<string[]> {
  for (const block of await page.locator("article").all()) await block.scrollIntoViewIfNeeded();
  // All are made alike; one of thousands of cells would take minutes.
  const toggle = page.getByRole("button", { name: "Table of Pole-zero map" });
  if ((await toggle.count()) > 0) await toggle.click();
  await page.locator("details:not([open])").evaluateAll((all) => all.forEach((one) => one.setAttribute("open", "")));
  const plot = page.locator(".plot").first();
  if ((await plot.count()) > 0) {
    await plot.focus();
    await page.keyboard.press("Home");
  }
  await page.evaluate(axe);
  const found = await page.evaluate(async () => {
    const { axe } = window as unknown as { axe: { run(): Promise<{ violations: Violation[] }> } };
    return (await axe.run()).violations;
  });
  return found.map(({ id, nodes }) => `${id}: ${nodes.map((node) => `${node.html} ${node.failureSummary ?? ""}`).join("\n")}`);
}

for (const [colorScheme, width] of [["light", 1280], ["dark", 390]] as const) {
  test(`axe-core finds nothing, ${colorScheme}, ${width} px wide`, () =>
    opened(addresses.diagnosis, async (page) => assert.deepEqual(await violations(page), []), {
      colorScheme,
      viewport: { width, height: 844 },
    }));
}

test("axe-core finds nothing where data are missing or damaged", () =>
  opened(addresses.edges, async (page) => assert.deepEqual(await violations(page), [])));

test("the page does not scroll sideways at 390 px, tables open or not", () =>
  opened(
    addresses.diagnosis,
    async (page) => {
      for (const block of await page.locator("article").all()) await block.scrollIntoViewIfNeeded();
      const width = () => page.evaluate(() => document.documentElement.scrollWidth);
      assert.ok((await width()) <= 390);
      for (const toggle of await page.getByRole("button", { name: "Table of" }).all()) await toggle.click();
      assert.ok((await width()) <= 390);
    },
    { viewport: { width: 390, height: 844 } },
  ));

test("colours follow the system and the switch, plots as well", () =>
  opened(
    addresses.diagnosis,
    async (page) => {
      await page.locator("#headline canvas").first().waitFor();
      const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
      const picture = () => page.locator("#headline canvas").first().evaluate((canvas) => (canvas as HTMLCanvasElement).toDataURL());
      const [darkGround, darkPicture] = [await ground(), await picture()];
      const toggle = page.getByRole("button", { name: "Dark" });
      assert.equal(await toggle.getAttribute("aria-pressed"), "true");
      await toggle.click();
      assert.equal(await ground(), "rgb(255, 255, 255)");
      await page.waitForTimeout(100);
      assert.notEqual(await picture(), darkPicture);
      await toggle.click();
      assert.equal(await ground(), darkGround);
    },
    { colorScheme: "dark" },
  ));

test("focus goes by Tab through controls and plots, and shows", () =>
  opened(addresses.diagnosis, async (page) => {
    const visited = new Set<string>();
    for (let i = 0; i < 40; ++i) {
      await page.keyboard.press("Tab");
      const { name, outline } = await page.evaluate(() => {
        const element = document.activeElement as HTMLElement;
        return { name: element.className || element.tagName, outline: getComputedStyle(element).outlineStyle };
      });
      visited.add(name);
      assert.notEqual(outline, "none", `${name} shows its focus`);
    }
    for (const name of ["skip", "theme", "plot", "SELECT", "A"]) assert.ok(visited.has(name), `${name} is reached`);
  }));

test("nothing moves for those who want it so", () =>
  opened(
    addresses.diagnosis,
    async (page) =>
      assert.equal(await page.evaluate(() => getComputedStyle(document.documentElement).scrollBehavior), "auto"),
    { reducedMotion: "reduce" },
  ));
