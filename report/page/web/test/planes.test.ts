import assert from "node:assert/strict";
import { test } from "node:test";

import type { Locator, Page } from "playwright-core";

import { opened } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { mapPoints } from "./samples/sample_roots.js";
import { written } from "./samples/written_page.js";

const diagnosis = written("diagnosis", diagnosisSample(2));

async function shown(page: Page, id: string): Promise<Locator> {
  const block = page.locator(`#${id}`);
  await block.scrollIntoViewIfNeeded();
  await block.locator("svg .frame").first().waitFor();
  return block;
}

const tickTexts = (block: Locator) => block.locator(".plane .ticks").first().textContent();

test("the map has a mark for each root; zeros in the right half plane differ in shape", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "map");
    const marks = (shape: string) =>
      block.locator(`.plane .marks.${shape}`).evaluateAll((paths) =>
        paths.reduce((sum, path) => sum + (path.getAttribute("d")?.match(/M/g)?.length ?? 0), 0),
      );
    const points = mapPoints();
    const count = (mark: string, isRight: boolean) =>
      points.filter((point) => point.mark === mark && point.non_minimum_phase === isRight).length;
    assert.equal(await marks("pole"), 2 * count("pole", false)); // two strokes a cross
    assert.equal(await marks("zero"), count("zero", false));
    assert.equal(await marks("non_minimum_phase_zero"), count("zero", true));
  }));

test("labels of the map cover neither each other nor a mark", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "map");
    const boxes = await block.locator(".point-label").evaluateAll((labels) =>
      labels.map((label) => {
        const { left, right, top, bottom } = label.getBoundingClientRect();
        return { left, right, top: top + 2, bottom: bottom - 2 };
      }),
    );
    assert.ok(boxes.length >= 5);
    boxes.forEach((a, i) =>
      boxes.slice(i + 1).forEach((b) =>
        assert.ok(a.right <= b.left || b.right <= a.left || a.bottom <= b.top || b.bottom <= a.top),
      ),
    );
  }));

test("arrows go through the roots and show their details", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "map");
    await block.locator(".plot").focus();
    await page.keyboard.press("Home");
    const card = block.locator(".card");
    assert.match((await card.textContent()) ?? "", /measured: zero.*2\.830 Hz.*hub angle/);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("End");
    assert.match((await card.textContent()) ?? "", /58\.53 Hz/);
    await page.waitForTimeout(250);
    assert.match((await block.locator("[aria-live]").textContent()) ?? "", /simulated: pole, 28 of 28; frequency 58\.53 Hz/);
    await page.keyboard.press("Escape");
    assert.ok(await card.isHidden());
  }));

test("the pointer shows details of the nearest root", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "map");
    const diamond = await block.locator(".plane .marks.non_minimum_phase_zero").first().boundingBox();
    assert.ok(diamond);
    await page.mouse.move(diamond.x + 6, diamond.y + diamond.height / 2);
    assert.match((await block.locator(".card").textContent()) ?? "", /non-minimum-phase zero.*tip acceleration/);
  }));

test("a map is zoomed by keys and by drags, and is logarithmic on request", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "map");
    const logarithmic = await tickTexts(block);
    await block.locator(".plot").focus();
    await page.keyboard.press("+");
    assert.notEqual(await tickTexts(block), logarithmic);
    await page.keyboard.press("Escape");
    assert.equal(await tickTexts(block), logarithmic);
    const frame = await block.locator(".plane .frame").boundingBox();
    assert.ok(frame);
    await page.mouse.move(frame.x + 40, frame.y + 30);
    await page.mouse.down();
    await page.mouse.move(frame.x + 300, frame.y + 200, { steps: 3 });
    await page.mouse.up();
    assert.notEqual(await tickTexts(block), logarithmic);
    await block.getByRole("button", { name: "Whole range" }).click();
    assert.equal(await tickTexts(block), logarithmic);
    await block.getByRole("button", { name: "Logarithmic" }).click();
    await block.locator(".plane .marks").first().waitFor();
    assert.notEqual(await tickTexts(block), logarithmic);
  }));

test("the slider moves the poles in both planes, by keys, too", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "sweep-payload");
    const places = () => block.locator('[data-track="pole 2"]').evaluateAll((marks) => marks.map((mark) => mark.getAttribute("d")));
    const ahead = () => block.locator(".way:not(.ahead)").first().getAttribute("d");
    const [sBefore, fBefore] = await places();
    const trail = await ahead();
    const slider = block.getByRole("slider");
    await slider.focus();
    for (let i = 0; i < 30; ++i) await page.keyboard.press("ArrowRight");
    const [sAfter, fAfter] = await places();
    assert.notEqual(sAfter, sBefore);
    assert.notEqual(fAfter, fBefore);
    assert.ok(((await ahead()) ?? "").length > (trail ?? "").length, "the trail grows");
    assert.equal(await block.locator("output").textContent(), "0.15 kg");
    assert.equal(await slider.getAttribute("aria-valuetext"), "0.15 kg");
    assert.match((await block.locator(".event").textContent()) ?? "", /as heavy as the beam/);
    await page.keyboard.press("End");
    assert.equal(await block.locator("output").textContent(), "0.5 kg");
    await block.getByRole("button", { name: /as heavy as the beam/ }).click();
    assert.equal(await block.locator("output").textContent(), "0.15 kg");
    const frame = await block.locator(".plane .frame").nth(1).boundingBox();
    assert.ok(frame);
    await page.mouse.click(frame.x + frame.width / 2, frame.y + 20);
    assert.match((await block.locator("output").textContent()) ?? "", /^0\.2[45]\d* kg$/);
  }));

test("a scatter shows its points and the law through them", () =>
  opened(diagnosis, async (page) => {
    const block = await shown(page, "residual-torque");
    const dots = await block.locator(".dots").getAttribute("d");
    assert.ok((dots?.match(/M/g)?.length ?? 0) > 300);
    assert.equal(await block.locator("path.curve").count(), 1);
    await block.getByRole("button", { name: "residual hub torque", exact: true }).click();
    assert.equal(await block.locator(".dots").count(), 0);
    await block.getByLabel("run").selectOption("run 1");
    await block.locator("path.curve").waitFor();
  }));

test("the ranking marks what is identified and opens its details", () =>
  opened(diagnosis, async (page) => {
    const block = page.locator("#ranking");
    await block.scrollIntoViewIfNeeded();
    const first = block.locator("li").first();
    assert.match((await first.textContent()) ?? "", /coulomb_friction.*identified.*0\.99/);
    assert.equal(await block.locator(".chosen").count(), 1);
    await first.locator("summary").click();
    assert.ok(await first.getByText("explained share").isVisible());
    const widths = await block.locator(".share").evaluateAll((bars) => bars.map((bar) => Number(bar.getAttribute("width"))));
    assert.deepEqual(widths.map((width) => width.toFixed(2)), ["99.00", "0.90", "0.03"]);
  }));
