import assert from "node:assert/strict";
import { test } from "node:test";

import { opened } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { written } from "./samples/written_page.js";

const diagnosis = written("diagnosis", diagnosisSample(2));

test("paper is light, has all sections and no controls", () =>
  opened(
    diagnosis,
    async (page) => {
      await page.locator("#headline canvas").first().waitFor();
      await page.emulateMedia({ media: "print", colorScheme: "dark" });
      await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
      assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
      for (const control of [".theme", ".contents", ".data-bar", ".slider input", ".help"]) {
        for (const element of await page.locator(control).all()) assert.ok(await element.isHidden(), control);
      }
      for (const id of ["headline", "overlay", "bode", "correlation"]) {
        const copies = page.locator(`#${id} .paper canvas`);
        assert.ok((await copies.count()) > 0, `${id} has pictures`);
        const width = await copies.first().evaluate((canvas) => (canvas as HTMLCanvasElement).width);
        assert.equal(width, 1700, "in the resolution of paper");
        assert.ok(await page.locator(`#${id} .canvas`).first().isHidden());
      }
      for (const id of ["map", "sweep-payload", "residual-torque"]) {
        assert.ok(await page.locator(`#${id} .plane svg`).first().isVisible());
      }
      await page.evaluate(() => dispatchEvent(new Event("afterprint")));
      await page.emulateMedia({ media: "screen", colorScheme: "dark" });
      assert.equal(await page.locator(".paper").count(), 0);
      assert.notEqual(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
    },
    { colorScheme: "dark" },
  ));

test("printing to PDF works from any state", () =>
  opened(diagnosis, async (page) => {
    const pdf = await page.pdf({ format: "A4" });
    assert.ok(pdf.length > 50_000);
    assert.equal(await page.locator(".paper").count(), 0);
  }));
