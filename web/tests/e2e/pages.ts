import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { afterAll, afterEach, beforeAll, expect } from "vitest";
import type { Browser } from "playwright-core";
import { type PageOptions, type Watched, launch, open } from "../browser";
import { insertReport } from "../encode";

const built = readFileSync(join(import.meta.dirname, "../../dist/report.html"), "utf8");

/** Opens pages; after each test, none of them may have written to the console or opened a dialog, but for what matches `expected`. */
export function pages(expected: RegExp | null = null): {
  show: (report: unknown, options?: PageOptions) => Promise<Watched>;
  raw: (html: string) => Promise<Watched>;
  visit: (url: string, options?: PageOptions) => Promise<Watched>;
} {
  const folder = mkdtempSync(join(tmpdir(), "placegraph-web-"));
  const opened: Watched[] = [];
  let browser: Browser;
  let files = 0;
  beforeAll(async () => {
    browser = await launch();
  });
  afterEach(async () => {
    for (const { page, messages } of opened.splice(0)) {
      await page.close();
      expect(messages.filter((text) => !expected?.test(text))).toEqual([]);
    }
  });
  afterAll(async () => {
    await browser.close();
    rmSync(folder, { recursive: true });
  });
  const visit = async (url: string, options?: PageOptions): Promise<Watched> => {
    const watched = await open(browser, url, options);
    opened.push(watched);
    return watched;
  };
  const raw = (html: string, options?: PageOptions): Promise<Watched> => {
    const file = join(folder, `${files++}.html`);
    writeFileSync(file, html);
    return visit(`file://${file}`, options);
  };
  return { raw, visit, show: (report, options) => raw(insertReport(built, report), options) };
}

export { built };
