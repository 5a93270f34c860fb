/** A run that goes on, as `run --view` serves it. */
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { afterEach, describe, expect, it } from "vitest";
import type { Page } from "playwright-core";
import { smallScene, until } from "../browser";
import { MockServer } from "../mock_server";
import { RunSite } from "../mock_sites";
import { pages } from "./pages";

const { visit } = pages(/Failed to load resource|ERR_INCOMPLETE_CHUNKED_ENCODING/);
const SHOTS = join(import.meta.dirname, "screenshots");
mkdirSync(SHOTS, { recursive: true });

let server: MockServer | null = null;
afterEach(async () => {
  await server?.close();
  server = null;
});

async function follow(site: RunSite): Promise<Page> {
  server = new MockServer(site);
  const { page } = await visit(await server.listen(), { width: 1280, height: 800 });
  return page;
}

const DONE = "Number(document.querySelector('.count')?.textContent.split(' ')[0])";

function doneFrames(page: Page): Promise<number> {
  return page.evaluate(DONE);
}

describe("a run that goes on", () => {
  it("is followed from the first image to its report", async () => {
    const site = new RunSite(100, 45);
    const page = await follow(site);
    await until(page, "document.querySelector('.live-image')?.dataset.frame !== undefined");
    await page.locator(".live-log li", { hasText: "is lost: too few points" }).first().waitFor();
    await page.locator(".stages td", { hasText: "local adjustment" }).waitFor();
    await page.locator(".live-log li", { hasText: "The loop of frames 40 and 11 is accepted" }).waitFor();
    await until(page, "document.querySelector('.live-image').dataset.frame === '44'");
    await page.screenshot({ path: join(SHOTS, "live.png") });
    site.release();
    await page.locator("#tab-overview").waitFor();
    expect(await page.locator(".verdict").textContent()).toBe("good");
    await page.click("#tab-frame");
    await page.locator(".frame-view[data-image='0']").waitFor();
    expect(await page.locator(".edits").count()).toBe(0);
  });

  it("is paused, stepped and resumed by keys", async () => {
    const page = await follow(new RunSite(200, 55));
    await until(page, `${DONE} >= 3`);
    await page.keyboard.press(" ");
    await page.getByRole("button", { name: "Go on" }).waitFor();
    await page.waitForTimeout(300);
    const paused = await doneFrames(page);
    await page.waitForTimeout(600);
    expect(await doneFrames(page)).toBe(paused);
    await page.keyboard.press(".");
    await until(page, `${DONE} === ${paused + 1}`);
    await until(page, `document.querySelector('.live-image').dataset.frame === '${paused}'`);
    await page.keyboard.press(" ");
    await until(page, `${DONE} === 55`);
  });

  it("keeps the camera in the middle of the view, if the user wants it", async () => {
    const site = new RunSite(30, 30);
    const page = await follow(site);
    await until(page, `${DONE} === 30`);
    await page.keyboard.press("h");
    const follows = page.locator(".tools button", { hasText: "Follow" });
    expect(await follows.getAttribute("aria-pressed")).toBe("true");
    const colours = new Set((await smallScene(page)).rgb);
    expect(colours.size).toBeGreaterThan(20);
    await page.keyboard.press("f");
    expect(await follows.getAttribute("aria-pressed")).toBe("false");
  });

  it("is found again after a gap of the connection", async () => {
    const site = new RunSite(30, 30);
    const page = await follow(site);
    await until(page, `${DONE} === 30`);
    site.drop();
    await page.locator(".link.lost").waitFor();
    await page.locator(".link.live").waitFor();
    site.release();
    await page.locator("#tab-overview").waitFor();
  });

  it("begins again", async () => {
    const site = new RunSite(30, 30);
    const page = await follow(site);
    await until(page, `${DONE} === 30`);
    site.reset(5);
    await page.locator(".live-log li", { hasText: "The run has begun again" }).waitFor();
    await until(page, `${DONE} === 5`);
    site.release();
    await page.locator("#tab-overview").waitFor();
  });

  it("says so when the program has ended", async () => {
    const page = await follow(new RunSite(30, 20));
    await until(page, `${DONE} === 20`);
    await server?.close();
    server = null;
    await page.getByText("The connection is lost: the program has ended or is out of reach.").waitFor();
    expect(await page.getByRole("button", { name: "Pause" }).isDisabled()).toBe(true);
  });

  it("has room on a phone", async () => {
    server = new MockServer(new RunSite(30, 45));
    const { page } = await visit(await server.listen(), { width: 390, height: 844, touch: true, scheme: "light" });
    await until(page, `${DONE} === 45`);
    expect(await page.evaluate("document.documentElement.scrollWidth")).toBeLessThanOrEqual(390);
    await page.screenshot({ path: join(SHOTS, "live_phone.png"), fullPage: true });
  });
});
