import "uplot/dist/uPlot.min.css";
import "./style/colours.css";
import "./style/page.css";
import "./style/blocks.css";
import "./style/plots.css";
import "./style/tables.css";
import "./style/print.css";

import type { PageDocument } from "./contract.js";
import { Arrays } from "./document/arrays.js";
import { MalformedDocument } from "./document/checks.js";
import { pageDocument } from "./document/page_document_check.js";
import { html } from "./page/element.js";
import { pageElement } from "./page/page_element.js";
import { followPrinting } from "./page/printing.js";

function content(id: string): string {
  return document.getElementById(id)?.textContent?.trim() ?? "";
}

function readDocument(): PageDocument {
  const text = content("document");
  if (text === "") throw new MalformedDocument("it has no data");
  let parsed: unknown;
  try {
    parsed = JSON.parse(text);
  } catch {
    throw new MalformedDocument("its data are not JSON");
  }
  return pageDocument(parsed, "document");
}

function show(): void {
  const place = document.getElementById("page");
  if (place === null) return;
  try {
    const page = readDocument();
    document.title = page.title;
    place.replaceChildren(...pageElement(page, new Arrays(content("arrays"))));
    followPrinting();
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    place.replaceChildren(
      html(
        "main",
        { class: "failure", role: "alert" },
        html("h1", {}, "This report cannot be shown"),
        html("p", {}, `The file is incomplete or damaged: ${reason}.`),
        html("p", {}, "Write it again with the option --report of the command that made it."),
      ),
    );
  }
}

show();
