import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { build } from "vite";

const root = join(import.meta.dirname, "../..");
const built = readFileSync(join(root, "dist/report.html"), "utf8");

describe("the built page", () => {
  it("is what its sources build, byte by byte", async () => {
    const folder = mkdtempSync(join(tmpdir(), "placegraph-web-"));
    try {
      await build({
        root,
        configFile: join(root, "vite.config.ts"),
        mode: "production",
        logLevel: "error",
        build: { outDir: folder },
      });
      expect(readFileSync(join(folder, "report.html"), "utf8") === built, "run npm run build").toBe(true);
    } finally {
      rmSync(folder, { recursive: true });
    }
  }, 120000);

  it("holds the marker of the report once, before its script", () => {
    const parts = built.split("<!--placegraph-report-->");
    expect(parts).toHaveLength(2);
    expect(parts[1].trimStart().startsWith('<script type="module" nonce="placegraph-nonce">')).toBe(true);
  });

  it("holds what a server replaces: one nonce, and its policy on a line of its own", () => {
    expect(built.split("placegraph-nonce")).toHaveLength(2);
    const lines = built.split("\n").filter((line) => line.includes("http-equiv"));
    expect(lines).toHaveLength(1);
    expect(lines[0].trim()).toMatch(/^<meta http-equiv="Content-Security-Policy" content="[^"]*">$/);
  });

  it("holds the licences of its packages", () => {
    expect(built).toContain("three.js authors");
    expect(built).toContain("Leon Sorokin");
  });

  it("loads nothing and has a strict policy", () => {
    expect(built).toContain("default-src 'none'");
    expect(built).not.toContain("unsafe");
    expect(built.match(/<script\b/g)).toHaveLength(1);
    expect(built).not.toMatch(/<(script|link|img)[^>]+(src|href)="(?!data:)/);
  });
});
