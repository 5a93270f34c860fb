/** The program itself, where the environment names it: PLACEGRAPH=build/release/placegraph npm run test:e2e -- program */
import { type ChildProcess, spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { afterAll, afterEach, beforeAll, describe, expect, it } from "vitest";
import type { Page } from "playwright-core";
import { until } from "../browser";
import { pages } from "./pages";

const program = process.env["PLACEGRAPH"];
if (program === undefined) console.log("Skipped: the tests of the program need its path in PLACEGRAPH.");

const { visit } = pages(/Failed to load resource.*(404|409)/);
const folder = mkdtempSync(join(tmpdir(), "placegraph-program-"));
const SEQUENCE = join(folder, "town");
const OUT = join(folder, "town-run");
const SIZE = { width: 1280, height: 800 };
const children: ChildProcess[] = [];

/** Starts the program and waits for the address of its page. */
function address(...args: string[]): Promise<string> {
  const child = spawn(resolve(program ?? ""), args, { stdio: ["ignore", "pipe", "pipe"] });
  children.push(child);
  return new Promise((found, failed) => {
    let text = "";
    const read = (part: Buffer): void => {
      text += String(part);
      const url = /http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\//.exec(text)?.[0];
      if (url !== undefined) found(url);
    };
    child.stdout.on("data", read);
    child.stderr.on("data", read);
    child.on("exit", () => failed(new Error(`no address: ${text}`)));
  });
}

async function frameShown(page: Page): Promise<void> {
  await page.click("#tab-frame");
  await page.locator(".frame-view[data-image='0']").waitFor();
  expect(await page.locator(".frame-view figcaption").textContent()).toMatch(/^Frame 0, \d+ × \d+ pixels, \d+ points/);
}

describe.skipIf(program === undefined)("the program", () => {
  beforeAll(() => {
    const { status } = spawnSync(
      resolve(program ?? ""),
      ["synth", "sequence", "town-loop", "--frames", "60", "--out", SEQUENCE, "--size", "620x188"],
      { stdio: "ignore" },
    );
    expect(status).toBe(0);
  }, 300000);

  afterEach(async () => {
    for (const child of children.splice(0)) {
      child.kill("SIGINT");
      if (child.exitCode === null) await new Promise((ended) => child.on("exit", ended));
    }
  });
  afterAll(() => rmSync(folder, { recursive: true }));

  it("shows a run from its first image to its report", async () => {
    rmSync(OUT, { recursive: true, force: true }); // of a first try
    const { page } = await visit(await address("run", SEQUENCE, "--out", OUT, "--view"), SIZE);
    const done = "Number(document.querySelector('.count').textContent.split(' ')[0])";
    const goOn = page.getByRole("button", { name: "Go on" });
    // A quick run ends before it is paused.
    await page.locator(".live").getByRole("button", { name: "Pause" }).click({ timeout: 2000 }).catch(() => undefined);
    await goOn.or(page.locator("#tab-overview")).first().waitFor();
    if (await goOn.isVisible()) {
      await until(page, "document.querySelector('.live-image')?.dataset.frame !== undefined");
      await page.waitForTimeout(500);
      const before = Number(await page.evaluate(done));
      await page.keyboard.press(".");
      if (before < 60) await until(page, `${done} === ${before + 1}`);
      await page.keyboard.press(" ");
    }
    await page.locator("#tab-overview").waitFor({ timeout: 120000 });
    await frameShown(page);
    await page.close(); // it looks for the program, which ends now
  }, 300000);

  it("shows its map with full images, and edits loops", async () => {
    expect(existsSync(join(OUT, "map.db"))).toBe(true);
    const { page } = await visit(await address("view", OUT), SIZE);
    await frameShown(page);
    await page.click("#tab-loops");
    await page.getByText("Mend the map").click();
    await page.getByRole("button", { name: "Pick frame 0" }).click();
    await page.keyboard.press("End");
    await page.getByRole("button", { name: "Add the loop 0 – 59" }).click();
    // The ends of the drive show different places, so the program says why there is no loop.
    await page.locator(".edits [role=alert]").waitFor({ timeout: 60000 });
    await page.getByRole("button", { name: "Optimize", exact: true }).click();
    await page.locator(".edit-list li", { hasText: "optimized" }).waitFor({ timeout: 60000 });
    await page.getByRole("textbox", { name: "Name of the new map" }).fill("mended");
    await page.getByRole("button", { name: "Save as a new map" }).click();
    await page.locator(".edits [role=status]", { hasText: "mended.db" }).waitFor({ timeout: 60000 });
    expect(existsSync(join(OUT, "mended.db"))).toBe(true);
    await page.close();
  }, 300000);
});
