import { type Browser, chromium } from "playwright-core";

/** Chromium without windows, of the system; CHROMIUM of the environment names another. */
export function launched(): Promise<Browser> {
  return chromium.launch({
    executablePath: process.env["CHROMIUM"] ?? "/usr/bin/chromium-headless-shell",
    args: ["--no-sandbox", "--disable-dev-shm-usage"],
  });
}
