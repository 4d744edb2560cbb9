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

/** A page with a word on it. */
export function emptyPage(): string {
  return addressOf("empty", "<!DOCTYPE html><title>empty</title><p>empty");
}

function addressOf(name: string, page: string): string {
  const path = join(folder, `${name}.html`);
  writeFileSync(path, page);
  return `file://${path}`;
}
