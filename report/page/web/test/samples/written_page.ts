import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

import type { Sample } from "./diagnosis_document.js";

const folder = mkdtempSync(join(tmpdir(), "flexarm-page-"));

/** The page that was built, PAGE of the environment. */
export function builtPage(): string {
  const path = process.env["PAGE"];
  if (path === undefined) throw new Error("PAGE has to name the built page.html");
  return readFileSync(path, "utf8");
}

/** Fills the page as the program does; gives the address of the file. */
export function written(name: string, sample: Sample): string {
  return writtenRaw(name, JSON.stringify(sample.document).replaceAll("<", "\\u003c"), sample.arrays.base64());
}

export function writtenRaw(name: string, json: string, base64: string): string {
  const page = builtPage()
    .replace('id="document"></script>', () => `id="document">${json}</script>`)
    .replace('id="arrays"></script>', () => `id="arrays">${base64}</script>`);
  return addressOf(name, page);
}

/**
 * A page that draws twelve curves of 4,000 samples, as many as the first screen of a diagnosis, and no
 * more. Its headline has three canvases, by which a test sees that it is drawn, as that of a diagnosis.
 */
export function barePage(): string {
  const canvases = '<canvas width="960" height="150"></canvas>'.repeat(3);
  return addressOf(
    "bare",
    `<!DOCTYPE html><title>bare</title><div id="headline">${canvases}</div><div>${canvases}</div>
<script>(${drawCurves})()</script>`,
  );
}

/** Runs in the page: two curves on each canvas. */
function drawCurves(): void {
  const samples = 4000;
  for (const canvas of document.querySelectorAll("canvas")) {
    const pen = canvas.getContext("2d")!;
    pen.lineWidth = 1.5;
    for (let k = 0; k < 2; ++k) {
      pen.beginPath();
      for (let i = 0; i < samples; ++i) {
        const level = 0.5 + 0.45 * Math.sin(0.05 * i + k);
        pen.lineTo((i * canvas.width) / samples, level * canvas.height);
      }
      pen.stroke();
    }
  }
}

function addressOf(name: string, page: string): string {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, page);
  return `file://${path}`;
}
