/** Pictures of every section, for a person to look at: node screenshots.js FOLDER [REPORT.html]. */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { launched } from "./browser.js";
import { diagnosisSample } from "./samples/diagnosis_document.js";
import { written } from "./samples/written_page.js";

const [folder = "screenshots", report] = process.argv.slice(2);
mkdirSync(folder, { recursive: true });
const address = report === undefined ? written("diagnosis", diagnosisSample()) : pathToFileURL(report).href;
const browser = await launched();
for (const colorScheme of ["light", "dark"] as const) {
  for (const width of [1280, 390]) {
    const page = await browser.newPage({ colorScheme, viewport: { width, height: width > 500 ? 900 : 844 } });
    await page.goto(address);
    await page.waitForTimeout(300);
    const name = (part: string) => join(folder, `${part}-${width}-${colorScheme}.png`);
    await page.screenshot({ path: name("0-first") });
    const sections = await page.locator(".first, .sections > section").all();
    for (const [i, section] of sections.entries()) {
      await section.scrollIntoViewIfNeeded();
      await page.waitForTimeout(150);
      for (const block of await section.locator("article").all()) {
        await block.scrollIntoViewIfNeeded();
        await page.waitForTimeout(60);
      }
      await section.screenshot({ path: name(`${i}-${(await section.getAttribute("id")) ?? "verdict"}`) });
    }
    if (colorScheme === "dark" && width > 500) await page.pdf({ path: join(folder, "print.pdf"), format: "A4", printBackground: false });
    await page.close();
  }
}
await browser.close();
