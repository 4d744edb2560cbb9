import "uplot/dist/uPlot.min.css";
import "./style/colours.css";
import "./style/page.css";
import "./style/blocks.css";
import "./style/print.css";

import type { PageDocument } from "./contract";
import { Arrays } from "./document/arrays";
import { MalformedDocument } from "./document/checks";
import { pageDocument } from "./document/page_document_check";
import { html } from "./page/element";
import { pageElement } from "./page/page_element";
import { followPrinting } from "./page/printing";

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
