import { html } from "../page/element.js";

const kPause_ms = 150; // while keys repeat nothing is said

/** Says values at the cursor to those who do not see the plot. */
export class Speech {
  readonly element = html("p", { class: "unseen", role: "status", "aria-live": "polite" });
  private timer = 0;

  say(text: string): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => {
      this.element.textContent = text;
    }, kPause_ms);
  }
}
