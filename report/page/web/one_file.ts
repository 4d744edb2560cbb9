import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import type { Plugin } from "vite";

/** The page has to work from a file, without a request: script and style are put into the HTML, and
 * a content security policy lets no other script run and nothing be loaded. */
export function oneFile(): Plugin {
  return {
    name: "one-file",
    enforce: "post",
    generateBundle(_options, bundle) {
      let script = "";
      let style = "";
      for (const [name, output] of Object.entries(bundle)) {
        if (name.endsWith(".html")) continue;
        if (output.type === "chunk") script += output.code;
        else if (name.endsWith(".css")) style += text(output.source);
        else throw new Error(`${name} would be a file beside the page`);
        delete bundle[name];
      }
      // The sequences that end a script or change how it is read.
      script = script.trim().replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
      style = style.trim();
      const page = bundle["index.html"];
      if (page?.type !== "asset") throw new Error("no index.html");
      page.source = filled(text(page.source), {
        "<!-- licences -->": `<!--\n${licences()}-->`,
        "<!-- policy -->":
          `<meta http-equiv="Content-Security-Policy" content="default-src 'none'; ` +
          `script-src ${hash(script)}; style-src ${hash(style)}; img-src data:">`,
        "<!-- style -->": `<style>${style}</style>`,
        "<!-- script -->": `<script type="module">${script}</script>`,
      });
    },
  };
}

/** index.html without Vite's own links to script and style, with each mark replaced. */
function filled(html: string, replacements: Record<string, string>): string {
  let page = html
    .replace(/\s*<script type="module"[^>]*src=[^>]*><\/script>/, "")
    .replace(/\s*<link rel="stylesheet"[^>]*>/, "");
  for (const [mark, replacement] of Object.entries(replacements)) {
    if (page.split(mark).length !== 2) throw new Error(`index.html has to have one ${mark}`);
    page = page.replace(mark, () => replacement);
  }
  return page;
}

function licences(): string {
  return `This page contains uPlot, https://github.com/leeoniya/uPlot\n\n${readFileSync(
    new URL("node_modules/uplot/LICENSE", import.meta.url),
    "utf8",
  ).trim()}\n`;
}

function hash(source: string): string {
  return `'sha256-${createHash("sha256").update(source).digest("base64")}'`;
}

function text(source: string | Uint8Array): string {
  return typeof source === "string" ? source : new TextDecoder().decode(source);
}
