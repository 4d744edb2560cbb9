import assert from "node:assert/strict";
import { after } from "node:test";

import type { Browser, BrowserContext, BrowserContextOptions, Locator, Page } from "playwright-core";

import { launched } from "./browser.js";

let browser: Browser | undefined;
let shared: BrowserContext | undefined; // of the tests without options of their own

after(async () => {
  await browser?.close();
});

/** Opens a page of its own. Any error on its console, or request besides the file, fails the test. */
export async function opened(
  address: string,
  check: (page: Page) => Promise<void>,
  options?: BrowserContextOptions,
  script?: () => void,
): Promise<void> {
  const isAlone = options !== undefined;
  const context = isAlone ? await newContext(options) : (shared ??= await newContext({}));
  const page = await context.newPage();
  page.setDefaultTimeout(10_000);
  const complaints: string[] = [];
  page.on("console", (message) => {
    if (["error", "warning"].includes(message.type())) complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  page.on("request", (request) => {
    if (request.url() !== address && !request.url().startsWith("blob:")) complaints.push(`request of ${request.url()}`);
  });
  if (script) await page.addInitScript(script);
  try {
    await page.goto(address);
    await check(page);
    assert.deepEqual(complaints, []);
  } finally {
    await (isAlone ? context.close() : page.close());
  }
}

async function newContext(options: BrowserContextOptions): Promise<BrowserContext> {
  browser ??= await launched();
  return browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
}

/** A block in view and drawn: drawing moves what is below and renews its links. */
export async function drawn(page: Page, id: string): Promise<Locator> {
  const block = page.locator(`#${id}`);
  await block.scrollIntoViewIfNeeded();
  await block.locator(':scope > [style*="min-height"]').waitFor({ state: "detached" });
  return block;
}

/** Number of pixels of a block's canvases with about this colour of the style sheet. */
export function pixelsOf(block: Locator, colourName: string): Promise<number> {
  return block.evaluate((element, name) => {
    const probe = document.createElement("span");
    probe.style.color = `var(--${name})`;
    document.body.append(probe);
    const wanted = (getComputedStyle(probe).color.match(/\d+/g) ?? []).map(Number);
    probe.remove();
    let count = 0;
    for (const canvas of element.querySelectorAll("canvas")) {
      const { width, height } = canvas;
      const copy = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
      copy?.drawImage(canvas, 0, 0);
      const data = copy?.getImageData(0, 0, width, height).data ?? [];
      for (let i = 0; i < data.length; i += 4) {
        const near = [0, 1, 2].every((k) => Math.abs((data[i + k] ?? 0) - (wanted[k] ?? 0)) < 12);
        if (near && (data[i + 3] ?? 0) > 200) ++count;
      }
    }
    return count;
  }, colourName);
}

/** Text of a block's readout once the plot has been moved. */
export async function xAtCursor(block: Locator): Promise<number> {
  const text = (await block.locator(".readout").textContent()) ?? "";
  return Number(/[-−]?[\d.]+(e[-−]?\d+)?/.exec(text)?.[0]?.replaceAll("−", "-"));
}
