import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import type { Plugin } from "vite";

/** placegraph replaces this by the script element with the report. */
export const MARKER = "<!--placegraph-report-->";

/** The server of the program replaces this by a nonce of its own, and removes the policy of the page. */
export const NONCE = "placegraph-nonce";

function policy(script: string, style: string): string {
  const hash = (text: string): string => `'sha256-${createHash("sha256").update(text, "utf8").digest("base64")}'`;
  return [
    "default-src 'none'",
    `script-src ${hash(script)}`,
    `style-src ${hash(style)}`,
    "img-src data: blob: 'self'",
    "connect-src 'self'",
    "base-uri 'none'",
    "form-action 'none'",
  ].join("; ");
}

/** Text of a script that may stand between <script> and </script>. */
function embeddable(script: string): string {
  return script.replace(/<\/(script)/gi, "<\\/$1").replace(/<!--/g, "<\\!--");
}

/** The licences of the packages in the page, which ask to be kept with every copy. */
function licences(): string {
  const texts = ["three", "uplot"].map((name) => {
    const text = readFileSync(join(import.meta.dirname, "node_modules", name, "LICENSE"), "utf8");
    return `${name}\n${text.replace(/\r/g, "").replace(/--+/g, "-").trim()}`;
  });
  return `<!-- This page contains:\n\n${texts.join("\n\n")}\n-->`;
}

/** Puts scripts and styles into the page, after the marker, and adds the content security policy. */
export function singleFile(): Plugin {
  return {
    name: "single-file",
    apply: "build",
    enforce: "post",
    generateBundle(_options, bundle): void {
      let script = "";
      let style = "";
      for (const [name, item] of Object.entries(bundle)) {
        if (item.type === "chunk") script += item.code;
        else if (name.endsWith(".css")) style += String(item.source);
        else continue;
        delete bundle[name];
      }
      script = `\n${embeddable(script.trim())}\n`;
      style = `\n${style.trim()}\n`;
      const page = bundle["report.html"];
      if (page?.type !== "asset") throw new Error("report.html is not among the outputs");
      const html = String(page.source)
        .replace(/\s*<script type="module"[^>]*><\/script>/, "")
        .replace(/\s*<link rel="stylesheet"[^>]*>/, "");
      if (html.split(MARKER).length !== 2) throw new Error(`report.html must hold ${MARKER} once`);
      for (const text of [MARKER, NONCE]) if (script.includes(text)) throw new Error(`a script holds ${text}`);
      page.source = html
        .replace(
          "<head>",
          () => `<head>\n  <meta http-equiv="Content-Security-Policy" content="${policy(script, style)}">`,
        )
        .replace("</body>", () => `${licences()}\n</body>`)
        .replace("</head>", () => `  <style>${style}</style>\n</head>`)
        .replace(MARKER, () => `${MARKER}\n  <script type="module" nonce="${NONCE}">${script}</script>`);
    },
  };
}
