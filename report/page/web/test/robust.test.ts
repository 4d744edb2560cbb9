import assert from "node:assert/strict";
import { test } from "node:test";

import { opened } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { edgeSample, hostileSample, kHostile } from "./samples/other_documents.js";
import { written, writtenRaw } from "./samples/written_page.js";


test("labels that are HTML are shown as text", () =>
  opened(written("hostile", hostileSample()), async (page) => {
    for (const block of await page.locator("article").all()) await block.scrollIntoViewIfNeeded();
    for (const toggle of await page.getByRole("button", { name: "Table of" }).all()) await toggle.click();
    await page.locator("#m .plot").focus();
    await page.keyboard.press("Home");
    assert.equal(await page.locator(".verdict .sentence").textContent(), kHostile);
    assert.equal(await page.locator("#t td, #t tbody th").first().textContent(), kHostile);
    assert.match((await page.locator("#m .card").textContent()) ?? "", /onerror/);
    assert.equal(await page.locator("#page img, #page script").count(), 0);
    assert.equal(await page.evaluate(() => "hacked" in window), false);
  }));

test("little or no data are shown as such, and damage stays in its block", () =>
  opened(written("edges", edgeSample()), async (page) => {
    for (const block of await page.locator("article").all()) await block.scrollIntoViewIfNeeded();
    await page.waitForTimeout(200);
    assert.equal(await page.locator(".failure").count(), 1);
    await page.locator("#damaged").getByRole("button", { name: "Table of" }).click();
    await page.locator("#damaged").getByText("CSV").click();
    assert.equal(await page.locator("#damaged .failure").count(), 3);
    assert.match((await page.locator("#damaged .failure").first().textContent()) ?? "", /an array ends at byte 1000024/);
    const draws = async (id: string) => page.locator(`#${id} canvas`).evaluate((canvas) => {
      const { data } = (canvas as HTMLCanvasElement).getContext("2d")!.getImageData(0, 0, 1200, 300);
      return data.some((value) => value > 0);
    });
    for (const id of ["one-sample", "one-sample-log", "no-sample", "all-nan", "constant", "with-gaps"]) {
      assert.ok(await draws(id), `${id} has axes`);
      await page.locator(`#${id} .plot`).focus();
      for (const key of ["Home", "ArrowRight", "+", "End", "Shift+ArrowLeft", "-", "Escape"]) await page.keyboard.press(key);
    }
    assert.match((await page.locator("#no-points").textContent()) ?? "", /No poles or zeros/);
    assert.match((await page.locator("#empty").textContent()) ?? "", /No data/);
    assert.ok(((await page.locator("#many-points .marks.pole").getAttribute("d")) ?? "").length > 10_000);
    await page.locator("#many-points .plot").focus();
    await page.keyboard.press("ArrowRight");
    assert.match((await page.locator("#many-points .card").textContent()) ?? "", /0 Hz/);
  }));

const complete = JSON.stringify(diagnosisSample(1).document);
const kMalformed: Record<string, [string, RegExp]> = {
  "without data": ["", /it has no data/],
  "cut off": [complete.slice(0, 1000), /its data are not JSON/],
  "of another schema": [complete.replace("flexarm.page/1", "flexarm.page/2"), /document\.schema is not one of flexarm\.page\/1/],
  "with a member missing": [complete.replace('"verdict"', '"verdicts"'), /document\.verdict is missing/],
  "with an unknown role": [complete.replace('"role":"measured"', '"role":"red"'), /document\.\S+role is not one of measured/],
  "with an unknown kind": [complete.replace('"kind":"table"', '"kind":"cake"'), /blocks\[1\]\.kind is not one of table/],
  "with a text for a number": [complete.replace('"height":2', '"height":"2"'), /\.height is not a number/],
};

for (const [name, [json, message]] of Object.entries(kMalformed)) {
  test(`a document ${name} gives a readable message`, () =>
    opened(writtenRaw(`malformed-${Object.keys(kMalformed).indexOf(name)}`, json, ""), async (page) => {
      const alert = page.getByRole("alert");
      assert.match((await alert.textContent()) ?? "", message);
      assert.match((await alert.textContent()) ?? "", /cannot be shown/);
    }));
}
