import { html } from "./element.js";

/** What says that something cannot be shown. */
export function failure(error: unknown): HTMLElement {
  const reason = error instanceof Error ? error.message : String(error);
  return html("p", { class: "failure", role: "alert" }, `This cannot be shown: ${reason}.`);
}

/** Runs `show`; damaged data are said in the place, in which the last message stood, and the rest of
 * the page stays. Whether it went well. */
export function attempted(place: HTMLElement, show: () => void): boolean {
  place.querySelector(":scope > .failure")?.remove();
  try {
    show();
    return true;
  } catch (error) {
    place.append(failure(error));
    return false;
  }
}
