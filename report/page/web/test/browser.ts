import { type Browser, chromium } from "playwright-core";

/** The system's Chromium; CHROMIUM of the environment names another. */
export function launched(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-dev-shm-usage"],
  });
}
