import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { inflateSync } from "node:zlib";
import type { Page } from "playwright-core";
import { describe, expect, it } from "vitest";
import { until } from "../browser";
import { sampleGraph, sampleReport, sampleRun } from "../sample";
import { built, pages } from "./pages";

const { show, raw } = pages();
const SHOTS = join(import.meta.dirname, "screenshots");
mkdirSync(SHOTS, { recursive: true });

const run = sampleRun({ lost: [[300, 320]] });
const report = sampleReport([run]);

function frameOf(page: Page): Promise<string | null> {
  return page.locator(".track").getAttribute("aria-valuenow");
}

describe("a page without a report", () => {
  it("says so in a sentence", async () => {
    const { page } = await raw(built);
    expect(await page.locator("[role=alert]").textContent()).toContain("This page holds no report.");
  });

  it("or with a damaged one says what is wrong", async () => {
    const { page } = await show({ ...report, runs: [{ ...run, sensor: 7 }] });
    expect(await page.locator("[role=alert]").textContent()).toBe(
      "This report cannot be shown. runs[0].sensor is 7; it must be one of mono, stereo, rgbd.",
    );
  });
});

describe("the overview", () => {
  it("holds the verdict, its findings with advice, and the figures with their protocols", async () => {
    const { page } = await show(report);
    const text = (await page.locator(".panel").textContent()) ?? "";
    for (const part of [
      "The run is doubtful.",
      "21 frames are lost",
      "Use a shorter exposure",
      "ATE",
      "se3 alignment, all posed frames, RMSE",
      "loops.min_similarity",
      "0.30",
    ]) {
      expect(text).toContain(part);
    }
    expect(await page.locator(".verdict").textContent()).toBe("doubtful");
    await page.screenshot({ path: join(SHOTS, "dark.png") });
  });

  it("has a light form, by the system and by the button", async () => {
    const { page } = await show(report, { scheme: "light" });
    const colour = (): Promise<string> => page.evaluate("getComputedStyle(document.body).backgroundColor");
    expect(await colour()).toBe("rgb(255, 255, 255)");
    await page.screenshot({ path: join(SHOTS, "light.png") });
    await page.keyboard.press("d");
    expect(await colour()).toBe("rgb(13, 17, 23)");
  });
});

describe("the scene", () => {
  it("is drawn: its picture has many colours and can be saved", async () => {
    const { page } = await show(report);
    const waiting = page.waitForEvent("download");
    await page.keyboard.press("s");
    const download = await waiting;
    expect(download.suggestedFilename()).toBe("block_scene.png");
    expect(coloursOf(await download.path())).toBeGreaterThan(500);
  });

  it("shows and hides layers by key and by check box", async () => {
    const { page } = await show(report);
    const online = page.locator("[data-layer=online]");
    expect(await online.isChecked()).toBe(false);
    await page.keyboard.press("o");
    expect(await online.isChecked()).toBe(true);
    await online.uncheck();
    await page.locator(".legend").getByText("online trajectory").waitFor({ state: "detached" });
  });

  it("shows the image of the pose under the pointer", async () => {
    const { page } = await show(report);
    await page.keyboard.press("v");
    await page.waitForTimeout(600);
    const canvas = await page.locator(".scene canvas").boundingBox();
    if (!canvas) throw new Error("no canvas");
    for (let x = (canvas.width + 280) / 2 - 40; x > 280 && !(await page.locator(".tip").isVisible()); x -= 12) {
      await page.mouse.move(canvas.x + x, canvas.y + canvas.height / 2);
      await page.waitForTimeout(60);
    }
    expect(await page.locator(".tip img").isVisible()).toBe(true);
  });

  it("moves the cursor to the pose that is clicked", async () => {
    const { page } = await show(report);
    await page.keyboard.press("v");
    await page.keyboard.press("m");
    await page.waitForTimeout(600);
    const canvas = await page.locator(".scene canvas").boundingBox();
    if (!canvas) throw new Error("no canvas");
    // From above, a line from the middle of the free part of the picture to its left crosses the far side of the block.
    for (let x = (canvas.width + 280) / 2 - 40; x > 280 && (await frameOf(page)) === "0"; x -= 12) {
      await page.mouse.click(canvas.x + x, canvas.y + canvas.height / 2);
    }
    expect(Number(await frameOf(page))).toBeGreaterThan(0);
  });
});

describe("a browser without WebGL", () => {
  it("shows everything but the scene", async () => {
    const { page } = await show(report, { flat: true });
    expect(await page.locator(".scene").textContent()).toContain("This browser has no WebGL 2");
    await page.keyboard.press("f");
    await page.keyboard.press("ArrowRight");
    expect(await frameOf(page)).toBe("1");
  });
});

describe("the time line", () => {
  it("moves the cursor and the frame panel while it is scrubbed", async () => {
    const { page } = await show(report);
    await page.click("#tab-frame");
    const box = await page.locator(".track").boundingBox();
    if (!box) throw new Error("no time line");
    await page.mouse.move(box.x + box.width / 4, box.y + 20);
    await page.mouse.down();
    await page.waitForTimeout(100);
    const first = await frameOf(page);
    await page.mouse.move(box.x + box.width / 2, box.y + 20);
    await page.mouse.up();
    const second = await frameOf(page);
    expect(Number(second)).toBeGreaterThan(Number(first));
    await page.getByRole("heading", { name: `Frame ${second}`, exact: true }).waitFor();
  });

  it("follows the keys and plays", async () => {
    const { page } = await show(report);
    await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Shift+ArrowRight");
    expect(await frameOf(page)).toBe("11");
    await page.keyboard.press("End");
    expect(await frameOf(page)).toBe("1100");
    await page.keyboard.press("Home");
    await page.keyboard.press("]");
    expect(await frameOf(page)).toBe("3");
    await page.keyboard.press(" ");
    await until(page, "Number(document.querySelector('.track').getAttribute('aria-valuenow')) > 10");
    await page.keyboard.press(" ");
    const paused = await frameOf(page);
    await page.waitForTimeout(300);
    expect(await frameOf(page)).toBe(paused);
    await page.keyboard.press("?");
    expect(await page.locator("dialog").isVisible()).toBe(true);
    await page.keyboard.press("Escape");
    expect(await page.locator("dialog").isVisible()).toBe(false);
  });

  it("explains a lost frame", async () => {
    const { page } = await show(report);
    await page.click("#tab-frame");
    await page.keyboard.press("Home");
    for (let i = 0; i < 31; i++) await page.keyboard.press("Shift+ArrowRight");
    await page.getByText("The frame is lost: too few points agree with the motion.").waitFor();
  });

  it("is saved as SVG", async () => {
    const { page } = await show(report);
    const waiting = page.waitForEvent("download");
    await page.locator(".controls").getByRole("button", { name: "SVG" }).click();
    const svg = readFileSync(await (await waiting).path(), "utf8");
    expect(svg).toContain("Position error [m]");
  });
});

describe("the pictures", () => {
  it("are saved as SVG and as PNG", async () => {
    const { page } = await show(report);
    await page.click("#tab-pictures");
    const picture = page.locator(".picture").first();
    for (const [kind, begin] of [
      ["SVG", "<svg"],
      ["PNG", "\u0089PNG"],
    ]) {
      const waiting = page.waitForEvent("download");
      await picture.getByRole("button", { name: kind }).click();
      const file = readFileSync(await (await waiting).path());
      expect(file.toString("latin1", 0, begin.length)).toBe(begin);
    }
  });
});

describe("the loops", () => {
  it("show their reason and move the cursor when they are clicked", async () => {
    const { page } = await show(report);
    await page.click("#tab-loops");
    await page.getByRole("button", { name: "Stage" }).click();
    const row = page.locator("tr[data-loop]").first();
    await row.filter({ hasText: "retrieval" }).waitFor(); // the table is drawn in the next frame
    const query = await row.locator("td").first().textContent();
    const stage = await row.locator("td").nth(2).textContent();
    expect(stage).toBe("retrieval");
    await row.click();
    await page.getByText("Refused: the images are not similar enough.").waitFor();
    expect(await frameOf(page)).toBe(query);
    // The image of a frame that is no keyframe is not in the report.
    expect(await page.locator(".pair img").count()).toBe(1);
  });

  it("are stepped through by key", async () => {
    const { page } = await show(report);
    await page.keyboard.press(".");
    const first = await frameOf(page);
    await page.keyboard.press(".");
    const second = await frameOf(page);
    expect(Number(second)).toBeGreaterThan(Number(first));
    await page.keyboard.press(",");
    expect(await frameOf(page)).toBe(first);
    expect(await page.locator("tr[aria-current=true]").count()).toBe(1);
  });

  it("are filtered by stage", async () => {
    const { page } = await show(report);
    await page.click("#tab-loops");
    const count = await page.locator("tr[data-loop]").count();
    await page
      .locator(".filters")
      .getByText(/^accepted/)
      .click();
    await until(page, `document.querySelectorAll("tr[data-loop]").length < ${count}`);
    expect(await page.locator("tr[data-loop] td:text-is('accepted')").count()).toBe(0);
  });
});

describe("two runs", () => {
  it("are compared, and the first frame where they part is right", async () => {
    const options = { frames: 400, landmarks: 500 };
    const two = sampleReport([
      sampleRun({ ...options, name: "a", partsAt: 100000 }),
      sampleRun({ ...options, name: "b", partsAt: 200 }),
    ]);
    const { page } = await show(two);
    await page.click("#tab-compare");
    const threshold = page.getByRole("spinbutton");
    await threshold.fill("0.5");
    await threshold.press("Enter");
    // b bends away by 4 cm a frame from frame 200 on.
    await page.locator(".parting[data-frame='212']").waitFor();
    expect(await page.locator(".parting").textContent()).toContain("They part at frame 212 (0:21.2)");
    await page.getByRole("button", { name: "Go to frame 212" }).click();
    expect(await frameOf(page)).toBe("212");
    await page.screenshot({ path: join(SHOTS, "two_runs.png") });
    await page.getByRole("combobox", { name: "Run", exact: true }).selectOption({ label: "b" });
    expect(await frameOf(page)).toBe("212");
  });
});

describe("a pose graph", () => {
  it("is shown without any run, with its worst edge first", async () => {
    const { page } = await show(sampleReport([], [sampleGraph()]));
    const cells = await page.locator("table.loops tbody tr").first().locator("td").allTextContents();
    expect(cells.slice(0, 3)).toEqual(["10", "780", "loop"]);
    await page.getByRole("combobox", { name: "Shape of the graph" }).selectOption("both");
    await page.locator("table.loops tbody tr").first().click();
    await page.waitForTimeout(500);
    await page.screenshot({ path: join(SHOTS, "graph.png") });
  });
});

describe("a run without any pose", () => {
  it("is shown without a fault", async () => {
    const none = sampleRun({ frames: 50, landmarks: 0, lost: [[0, 49]], loops: false });
    const { page } = await show(sampleReport([none]));
    await page.click("#tab-frame");
    await page.getByText("The frame is lost").waitFor();
    const empty = sampleRun({ frames: 0, landmarks: 0, loops: false, truth: false });
    const second = await show(sampleReport([empty]));
    await second.page.click("#tab-frame");
    await second.page.getByText("This run has no frames.").waitFor();
    await second.page.keyboard.press("ArrowRight");
  });
});

describe("hostile texts", () => {
  it("do nothing", async () => {
    const evil = '<img src=x onerror="alert(1)"></script><script>alert(2)</script>';
    const hostile = {
      ...run,
      name: evil,
      folder: evil,
      notes: [evil],
      options: [{ name: evil, value: evil, default_value: evil }],
      figures: [{ name: evil, value: 1, unit: evil, protocol: evil }],
      judgement: {
        verdict: "failed",
        metric: false,
        why_metric: evil,
        expected_drift_m: null,
        findings: [{ cause: evil, text: evil, advice: evil }],
      },
      frames: { ...run.frames, reason: { ...run.frames.reason, table: [evil] } },
      keyframes: { ...run.keyframes, thumbnails: run.keyframes.thumbnails.map(() => "javascript:alert(3)") },
      loops: run.loops && { ...run.loops, stage: { ...run.loops.stage, table: run.loops.stage.table.map(() => evil) } },
      tables: [{ title: evil, protocol: evil, columns: [evil], rows: [[evil]] }],
      recording: evil,
      pictures: [
        {
          title: evil,
          caption: evil,
          svg: `<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9" onload="alert(4)"><script>alert(5)</script></svg>`,
        },
      ],
    };
    const { page } = await show({ ...sampleReport([]), title: evil, runs: [hostile] });
    for (const tab of ["frame", "loops", "pictures", "overview"]) {
      await page.click(`#tab-${tab}`);
      await page.waitForTimeout(100);
      expect(await page.locator("img[src=x], .panel script").count()).toBe(0);
    }
    expect(await page.locator(".panel h2").textContent()).toBe(evil);
  });
});

describe("on a phone", () => {
  it("nothing is wider than the screen", async () => {
    const { page } = await show(sampleReport([run, sampleRun({ seed: 2, name: "a rather long name of a run" })]), {
      width: 390,
      height: 844,
      touch: true,
    });
    for (const tab of ["overview", "frame", "loops", "compare", "pictures"]) {
      await page.click(`#tab-${tab}`);
      const width = await page.evaluate("document.documentElement.scrollWidth");
      expect(width).toBeLessThanOrEqual(390);
    }
    await page.screenshot({ path: join(SHOTS, "phone.png"), fullPage: true });
  });
});

/** Different colours in a PNG of 8 bit without interlace, by its unfiltered bytes; a measure of content. */
function coloursOf(path: string): number {
  const file = readFileSync(path);
  const parts: Buffer[] = [];
  for (let at = 8; at < file.length;) {
    const length = file.readUInt32BE(at);
    if (file.toString("latin1", at + 4, at + 8) === "IDAT") parts.push(file.subarray(at + 8, at + 8 + length));
    at += 12 + length;
  }
  const raw = inflateSync(Buffer.concat(parts));
  const seen = new Set<number>();
  for (let i = 1; i + 3 < raw.length; i += 4) seen.add(raw.readUIntBE(i, 3));
  return seen.size;
}
