import assert from "node:assert/strict";
import { test } from "node:test";

import type { Locator, Page } from "playwright-core";

import { opened, pixelsOf, xAtCursor } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { kSamples, kStep_s } from "./samples/sample_runs.js";
import { written } from "./samples/written_page.js";

const diagnosis = written("diagnosis", diagnosisSample(2));
const kLast_s = (kSamples - 1) * kStep_s;

async function plotOf(page: Page, id: string): Promise<{ block: Locator; plot: Locator; over: Locator }> {
  const block = page.locator(`#${id}`);
  await block.scrollIntoViewIfNeeded();
  await block.locator("canvas").first().waitFor();
  return { block, plot: block.locator(".plot"), over: block.locator(".u-over").first() };
}

/** First and last x in view, by the keys that go there. */
async function rangeInView(page: Page, block: Locator): Promise<[number, number]> {
  await block.locator(".plot").focus();
  await page.keyboard.press("Home");
  const first = await xAtCursor(block);
  await page.keyboard.press("End");
  return [first, await xAtCursor(block)];
}

test("keys move the cursor from sample to sample and the values are said", () =>
  opened(diagnosis, async (page) => {
    const { block, plot } = await plotOf(page, "overlay");
    await plot.focus();
    await page.keyboard.press("Home");
    assert.equal(await xAtCursor(block), 0);
    await page.keyboard.press("ArrowRight");
    assert.equal(await xAtCursor(block), kStep_s);
    await page.keyboard.press("Shift+ArrowRight");
    assert.ok(Math.abs((await xAtCursor(block)) - (kStep_s + kLast_s / 10)) <= 2 * kStep_s);
    await page.keyboard.press("End");
    assert.ok(Math.abs((await xAtCursor(block)) - kLast_s) < 1e-3);
    for (const value of await block.locator(".legend .value").all()) {
      assert.match((await value.textContent()) ?? "", /\d/);
    }
    await page.waitForTimeout(250);
    const said = (await block.locator('[aria-live="polite"]').textContent()) ?? "";
    assert.match(said, /^time 9\.99\d s; measured .* rad; before .*; residual after .* rad$/);
    await page.keyboard.press("Escape");
    assert.equal(await block.locator(".readout").textContent(), "");
  }));

test("plus, minus and Escape zoom at the cursor and reset", () =>
  opened(diagnosis, async (page) => {
    const { block, plot } = await plotOf(page, "overlay");
    await plot.focus();
    await page.keyboard.press("Home");
    for (let i = 0; i < 5; ++i) await page.keyboard.press("+");
    const [first, last] = await rangeInView(page, block);
    assert.equal(first, 0);
    assert.ok(Math.abs(last - kLast_s / 1.5 ** 5) < 0.02, `ends at ${last}`);
    await block.locator(".reset").waitFor();
    await page.keyboard.press("Escape");
    assert.deepEqual(await rangeInView(page, block), [0, Number(kLast_s.toPrecision(4))]);
    assert.ok(await block.locator(".reset").isHidden());
  }));

test("a lens on the whole run shows a part of it first, and is dragged along", () =>
  opened(diagnosis, async (page) => {
    const { block } = await plotOf(page, "headline");
    assert.deepEqual(await rangeInView(page, block), [2, 4]);
    const overview = block.locator(".overview");
    const [whole, lens] = [await overview.boundingBox(), await overview.locator(".lens").boundingBox()];
    assert.ok(whole && lens);
    assert.ok(Math.abs(lens.width / whole.width - 2 / kLast_s) < 0.01, "the lens is as long as the part");
    const y = whole.y + whole.height / 2;
    const second = whole.width / kLast_s;
    await page.mouse.move(lens.x + lens.width / 2, y);
    await page.mouse.down();
    await page.mouse.move(lens.x + lens.width / 2 + 3 * second, y, { steps: 4 });
    await page.mouse.up();
    const [first, last] = await rangeInView(page, block);
    assert.ok(Math.abs(first - 5) < 0.03 && Math.abs(last - 7) < 0.03, `${first} to ${last}`);
    await page.mouse.move(whole.x + 7 * second, y);
    await page.mouse.down();
    await page.mouse.move(whole.x + 9 * second, y, { steps: 4 });
    await page.mouse.up();
    const wider = await rangeInView(page, block);
    assert.ok(Math.abs(wider[0] - 5) < 0.03 && Math.abs(wider[1] - 9) < 0.03, `${wider[0]} to ${wider[1]}`);
    await overview.dblclick();
    assert.deepEqual(await rangeInView(page, block), [0, Number(kLast_s.toPrecision(4))]);
  }));

test("a drag zooms all panels of the block; a double click shows the whole again", () =>
  opened(diagnosis, async (page) => {
    const { block, over } = await plotOf(page, "overlay");
    const box = await over.boundingBox();
    assert.ok(box);
    const y = box.y + box.height / 2;
    await page.mouse.move(box.x + box.width * 0.25, y);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.5, y + 3, { steps: 4 });
    await page.mouse.up();
    const [first, last] = await rangeInView(page, block);
    assert.ok(Math.abs(first - kLast_s / 4) < 0.03 && Math.abs(last - kLast_s / 2) < 0.03, `${first} to ${last}`);
    await over.dblclick();
    assert.deepEqual(await rangeInView(page, block), [0, Number(kLast_s.toPrecision(4))]);
  }));

test("an upright drag zooms the vertical axis of its panel", () =>
  opened(diagnosis, async (page) => {
    const { block, over } = await plotOf(page, "overlay");
    const picture = (panel: number) => block.locator("canvas").nth(panel).evaluate((canvas) => (canvas as HTMLCanvasElement).toDataURL());
    const [first, second] = [await picture(0), await picture(1)];
    const box = await over.boundingBox();
    assert.ok(box);
    await page.mouse.move(box.x + 100, box.y + 0.3 * box.height);
    await page.mouse.down();
    await page.mouse.move(box.x + 103, box.y + 0.7 * box.height, { steps: 4 });
    await page.mouse.up();
    await block.locator(".reset").waitFor();
    assert.notEqual(await picture(0), first);
    assert.equal(await picture(1), second);
    assert.deepEqual(await rangeInView(page, block), [0, Number(kLast_s.toPrecision(4))]);
    await block.locator(".reset").click();
    await page.waitForTimeout(100);
    assert.equal(await picture(0), first);
  }));

test("the wheel zooms with Ctrl about the pointer, and scrolls the page without", () =>
  opened(diagnosis, async (page) => {
    const { block, over } = await plotOf(page, "overlay");
    await over.hover();
    await page.mouse.wheel(0, 40);
    await page.waitForTimeout(200);
    assert.ok(await block.locator(".reset").isHidden());
    await over.hover();
    await page.keyboard.down("Control");
    await page.mouse.wheel(0, -400);
    await page.keyboard.up("Control");
    await block.locator(".reset").waitFor();
    const [first, last] = await rangeInView(page, block);
    assert.ok(Math.abs((first + last) / 2 - kLast_s / 2) < 0.2, `${first} to ${last}`);
    assert.ok(last - first < 0.6 * kLast_s);
  }));

test("two fingers zoom", () =>
  opened(
    diagnosis,
    async (page) => {
      const { block, over } = await plotOf(page, "overlay");
      const box = await over.boundingBox();
      assert.ok(box);
      const session = await page.context().newCDPSession(page);
      const y = box.y + box.height / 2;
      const middle = box.x + box.width / 2;
      const touch = (type: "touchStart" | "touchMove" | "touchEnd", apart: number) =>
        session.send("Input.dispatchTouchEvent", {
          type,
          touchPoints: type === "touchEnd" ? [] : [{ x: middle - apart, y, id: 1 }, { x: middle + apart, y, id: 2 }],
        });
      await touch("touchStart", 30);
      for (const apart of [40, 60, 80, 100]) await touch("touchMove", apart);
      await touch("touchEnd", 0);
      await block.locator(".reset").waitFor();
      const [first, last] = await rangeInView(page, block);
      assert.ok(last - first < 0.6 * kLast_s, `${first} to ${last}`);
    },
    { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true },
  ));

test("the pointer shows values at one x in all panels", () =>
  opened(diagnosis, async (page) => {
    const { block, over } = await plotOf(page, "overlay");
    const box = await over.boundingBox();
    assert.ok(box);
    await page.mouse.move(box.x + box.width / 2, box.y + 20);
    assert.ok(Math.abs((await xAtCursor(block)) - kLast_s / 2) < 0.03);
    const lefts = await block.locator(".u-cursor-x").evaluateAll((lines) => lines.map((line) => line.getBoundingClientRect().left));
    assert.equal(lefts.length, 3);
    assert.ok(Math.max(...lefts) - Math.min(...lefts) < 1.5);
    assert.equal(await block.locator(".cursor-dot").count(), 5);
    await page.mouse.move(5, 5);
    assert.equal(await block.locator(".readout").textContent(), "");
  }));

test("the legend hides and shows a curve", () =>
  opened(diagnosis, async (page) => {
    const { block } = await plotOf(page, "overlay");
    assert.ok((await pixelsOf(block, "role-before")) > 100);
    for (const name of ["before", "residual before"]) {
      const entry = block.getByRole("button", { name, exact: true });
      await entry.click();
      assert.equal(await entry.getAttribute("aria-pressed"), "false");
    }
    await page.waitForTimeout(100);
    assert.equal(await pixelsOf(block, "role-before"), 0);
    await block.getByRole("button", { name: "before", exact: true }).click();
    await page.waitForTimeout(100);
    assert.ok((await pixelsOf(block, "role-before")) > 100);
  }));

test("selectors show another view, worst first, and keep the zoom", () =>
  opened(diagnosis, async (page) => {
    const { block, plot } = await plotOf(page, "overlay");
    const facts = block.locator(".inline-facts");
    const first = await facts.textContent();
    const [run, sensor] = [block.getByLabel("run"), block.getByLabel("sensor")];
    assert.equal(await sensor.inputValue(), "hub angle");
    await plot.focus();
    await page.keyboard.press("Home");
    await page.keyboard.press("+");
    await sensor.selectOption("tip acceleration");
    assert.match((await block.locator(".quantity").first().textContent()) ?? "", /^tip acceleration \[m\/s²\]/);
    assert.notEqual(await facts.textContent(), first);
    assert.ok((await pixelsOf(block, "role-before")) > 100);
    const [, last] = await rangeInView(page, block);
    assert.ok(last < 0.7 * kLast_s, "the range is kept");
    await run.selectOption("run 1");
    assert.equal(await sensor.inputValue(), "tip acceleration");
  }));

test("a band that was not measured is a gap", () =>
  opened(diagnosis, async (page) => {
    const { block, plot } = await plotOf(page, "bode");
    await plot.focus();
    await page.keyboard.press("Home");
    const measured = block.locator(".legend button", { hasText: "measured" }).first().locator(".value");
    assert.match((await measured.textContent()) ?? "", /±/);
    let sawGap = false;
    for (let i = 0; i < 240 && !sawGap; ++i) {
      await page.keyboard.press("ArrowRight");
      sawGap = (await measured.textContent()) === "";
    }
    assert.ok(sawGap);
    const x = await xAtCursor(block);
    assert.ok(x >= 44 && x <= 48, `gap at ${x} Hz`);
  }));
