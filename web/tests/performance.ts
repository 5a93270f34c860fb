/** npm run performance: load time, pictures a second and memory of the built page, in software GL. */
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import type { Browser, Page } from "playwright-core";
import { hasChromium, launch, until } from "./browser";
import { insertReport } from "./encode";
import { sampleReport, sampleRun } from "./sample";

const CASES = [
  { frames: 1101, landmarks: 20000, keyframeEvery: 3.4 },
  { frames: 10000, landmarks: 200000, keyframeEvery: 3.33 },
];

export async function main(): Promise<void> {
  if (!hasChromium()) {
    console.log("Chromium is not installed: nothing is measured.");
    return;
  }
  const folder = mkdtempSync(join(tmpdir(), "placegraph-web-"));
  const page = readFileSync(resolve("dist/report.html"), "utf8");
  const browser = await launch();
  try {
    for (const sizes of CASES) {
      const file = join(folder, `${sizes.frames}.html`);
      writeFileSync(file, insertReport(page, sampleReport([sampleRun(sizes)])));
      await measure(browser, file, sizes.frames);
    }
  } finally {
    await browser.close();
    rmSync(folder, { recursive: true });
  }
}

async function measure(browser: Browser, file: string, frames: number): Promise<void> {
  const page = await browser.newPage({ viewport: { width: 1280, height: 800 } });
  await page.goto(`file://${file}`);
  await until(page, "performance.getEntriesByName('first-picture').length > 0");
  const first = await page.evaluate("performance.getEntriesByName('first-picture')[0].startTime");
  await page.waitForTimeout(2500);
  const orbit = await rate(page, () => drag(page));
  const scrub = await rate(page, () => scrubbing(page));
  const session = await page.context().newCDPSession(page);
  await session.send("HeapProfiler.collectGarbage");
  const heap = (await session.send("Runtime.getHeapUsage")).usedSize;
  const megabytes = (bytes: number): string => (bytes / 1e6).toFixed(1);
  console.log(
    `${frames} frames: file ${megabytes(statSync(file).size)} MB, first picture ${(Number(first) / 1000).toFixed(2)} s, ` +
      `orbit ${orbit.toFixed(0)} pictures/s, scrub ${scrub.toFixed(0)} pictures/s, JavaScript heap ${megabytes(heap)} MB, ` +
      `tab ${await residentMegabytes(browser)} MB`,
  );
  await page.close();
}

/** Animation frames a second while `action` runs: drawing blocks them. */
async function rate(page: Page, action: () => Promise<void>): Promise<number> {
  await page.evaluate(`(() => {
    window.counted = 0; window.countFrom = performance.now();
    const step = () => { window.counted++; window.counter = requestAnimationFrame(step); };
    step();
  })()`);
  await action();
  return Number(
    await page.evaluate(
      "cancelAnimationFrame(window.counter), 1000 * window.counted / (performance.now() - window.countFrom)",
    ),
  );
}

/** 0, 1, 2, ... for some seconds. */
function* during(seconds: number): Generator<number> {
  const end = Date.now() + 1000 * seconds;
  for (let i = 0; Date.now() < end; i++) yield i;
}

async function drag(page: Page): Promise<void> {
  await page.mouse.move(600, 300);
  await page.mouse.down();
  for (const i of during(6)) await page.mouse.move(600 + 3 * (i % 80), 300 + Math.round(40 * Math.sin(i / 8)));
  await page.mouse.up();
}

async function scrubbing(page: Page): Promise<void> {
  const box = await page.locator(".track").boundingBox();
  if (!box) return;
  await page.mouse.move(box.x + 100, box.y + 60);
  await page.mouse.down();
  for (const i of during(6)) await page.mouse.move(box.x + 100 + 8 * (i % 100), box.y + 60);
  await page.mouse.up();
}

/** Resident memory of the largest renderer process. */
async function residentMegabytes(browser: Browser): Promise<string> {
  const session = await browser.newBrowserCDPSession();
  const { processInfo } = await session.send("SystemInfo.getProcessInfo");
  const sizes = processInfo
    .filter((info) => info.type === "renderer")
    .map((info) => {
      const status = readFileSync(`/proc/${info.id}/status`, "utf8");
      return Number(/VmRSS:\s+(\d+)/.exec(status)?.[1] ?? 0) / 1000;
    });
  return Math.max(...sizes).toFixed(0);
}
