import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

import type { Page } from "playwright-core";

import { drawn, opened } from "./opened.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { channels, kSamples, kStep_s } from "./samples/sample_runs.js";
import { written } from "./samples/written_page.js";

const sample = diagnosisSample(2);
const diagnosis = written("diagnosis", sample);

async function csvOf(page: Page, id: string, label = "CSV"): Promise<{ name: string; rows: string[][] }> {
  const link = (await drawn(page, id)).getByText(label, { exact: true });
  const [download] = await Promise.all([page.waitForEvent("download"), link.click()]);
  const text = readFileSync(await download.path(), "utf8");
  assert.ok(text.endsWith("\r\n"));
  return { name: download.suggestedFilename(), rows: text.trimEnd().split("\r\n").map(fields) };
}

/** Fields of a line, of which some are in quotes. */
function fields(line: string): string[] {
  return [...line.matchAll(/(?:^|,)(?:"((?:[^"]|"")*)"|([^,]*))/g)].map((match) => match[1]?.replaceAll('""', '"') ?? match[2] ?? "");
}

test("the CSV file of a view has its samples", () =>
  opened(diagnosis, async (page) => {
    const { name, rows } = await csvOf(page, "overlay");
    const overlay = sample.document.sections[0]?.blocks[0];
    assert.ok(overlay?.kind === "curves");
    const [run, sensor] = overlay.views[0]!.labels;
    assert.equal(name, `overlay-${run}-${sensor}.csv`.replaceAll(" ", "-"));
    assert.equal(rows.length, kSamples + 1);
    assert.equal(rows[0]?.[0], "time [s]");
    assert.equal(rows[0]?.length, 6);
    const channel = channels(2).find((one) => one.run === run && one.sensor === sensor)!;
    const span = Math.max(...channel.measured) - Math.min(...channel.measured);
    for (const i of [0, 1000, 3999]) {
      const row = rows[i + 1]!.map(Number);
      assert.equal(row[0], Number((i * kStep_s).toPrecision(12)));
      assert.ok(Math.abs(row[1]! - channel.measured[i]!) < span / 60_000, "to half a step of 16 bits");
    }
  }));

test("the CSV file of all views names the view of each row", () =>
  opened(diagnosis, async (page) => {
    const { name, rows } = await csvOf(page, "overlay", "CSV of all views");
    assert.equal(name, "overlay-all.csv");
    assert.deepEqual(rows[0]?.slice(0, 3), ["run", "sensor", "time [s]"]);
    assert.equal(rows.length, 4 * kSamples + 1);
    assert.equal(new Set(rows.slice(1).map((row) => `${row[0]} ${row[1]}`)).size, 4);
  }));

test("frequencies of several grids are one column; gaps are empty cells", () =>
  opened(diagnosis, async (page) => {
    const { name, rows } = await csvOf(page, "bode");
    assert.equal(name, "bode.csv");
    const frequencies = rows.slice(1).map((row) => Number(row[0]));
    assert.ok(frequencies.every((f, i) => i === 0 || f > frequencies[i - 1]!));
    assert.deepEqual(rows[0]?.slice(0, 2), ["frequency [Hz]", "magnitude, measured [rad/(N m)]"]);
    assert.ok(rows.some((row) => row[1] === "" && row.some((cell, i) => i > 0 && cell !== "")));
  }));

test("each kind of block has its CSV file", () =>
  opened(diagnosis, async (page) => {
    const expected: Record<string, [string, number]> = {
      fits: ["run", 5],
      map: ["series", 29],
      "sweep-payload": ["payload mass [kg]", 102],
      ranking: ["name", 4],
    };
    for (const [id, [title, count]] of Object.entries(expected)) {
      const { name, rows } = await csvOf(page, id);
      assert.equal(name, `${id}.csv`);
      assert.equal(rows[0]?.[0], title);
      assert.equal(rows.length, count);
    }
  }));

test("the table behind a plot shows its data, thinned where they are many", () =>
  opened(diagnosis, async (page) => {
    const block = page.locator("#overlay");
    await block.scrollIntoViewIfNeeded();
    const toggle = block.getByRole("button", { name: "Table of" });
    assert.equal(await block.locator("table").count(), 0);
    await toggle.click();
    assert.equal(await toggle.getAttribute("aria-expanded"), "true");
    assert.equal(await block.locator("tbody tr").count(), 200);
    assert.match((await block.locator(".data-table .note").textContent()) ?? "", /Every 20th of 4000 rows/);
    assert.equal(await block.locator("thead th").first().textContent(), "time [s]");
    await block.getByLabel("sensor").selectOption("tip acceleration");
    assert.match((await block.locator("thead th").nth(1).textContent()) ?? "", /^tip acceleration/);
    await toggle.click();
    assert.ok(await block.locator(".data-table").isHidden());
  }));

test("tables are sorted by the heads of their columns, numbers by value", () =>
  opened(diagnosis, async (page) => {
    const block = page.locator("#fits");
    const column = () => block.locator("tbody tr > :nth-child(3)").allTextContents();
    const head = block.getByRole("button", { name: "NRMSE before" });
    await head.click();
    const ascending = (await column()).map(Number);
    assert.deepEqual(ascending, [...ascending].sort((a, b) => a - b));
    assert.equal(await block.locator('th[aria-sort="ascending"]').count(), 1);
    await head.click();
    assert.deepEqual((await column()).map(Number), [...ascending].reverse());
    const alignment = await block.locator("td.number").first().evaluate((cell) => getComputedStyle(cell).textAlign);
    assert.equal(alignment, "right");
  }));
