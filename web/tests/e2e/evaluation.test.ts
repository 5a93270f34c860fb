import { readFileSync } from "node:fs";
import { describe, expect, it } from "vitest";
import { sampleReport, sampleRun } from "../sample";
import { sampleEstimate, sampleJudged } from "../sample_eval";
import { pages } from "./pages";

const { show } = pages();
const evil = `<img src=x onerror=alert(1)>`;

describe("a page of evaluated trajectories", () => {
  const frames = 300;
  const estimates = [
    sampleEstimate({ name: "straight", frames }),
    sampleEstimate({ name: "bent", frames, partsAt: 150 }),
  ];

  it("has figures, errors by length and no map", async () => {
    const { page } = await show(sampleReport(estimates));
    const text = (await page.locator(".panel").textContent()) ?? "";
    expect(text).toContain("poses aligned to the ground truth: se3");
    expect(text).toContain("Errors by length");
    expect(text).not.toContain("Keyframes");
    expect(text).not.toContain("All options have their defaults");
    expect(await page.locator("[data-layer=landmarks]").count()).toBe(0);
    expect(await page.locator("[data-layer=online]").count()).toBe(0);
  });

  it("says where the estimates part, in the frame of the ground truth", async () => {
    const { page } = await show(sampleReport(estimates));
    await page.locator("#tab-compare").click();
    const text = (await page.locator(".panel").textContent()) ?? "";
    expect(text).toContain("Both are in the frame of the ground truth");
    expect(Number(await page.locator(".parting").getAttribute("data-frame"))).toBeGreaterThan(150);
  });

  it("compares no trajectories of different sequences, but their figures and means", async () => {
    const report = sampleReport([estimates[0], { ...estimates[1], recording: "other" }]);
    report.tables = [{ title: "Averages", protocol: "2 sequences", columns: ["Figure", "Value"], rows: [["ATE", "1 m"]] }];
    const { page } = await show(report);
    expect(await page.locator("[data-layer=others]").count()).toBe(0);
    await page.locator("#tab-compare").click();
    const text = (await page.locator(".panel").textContent()) ?? "";
    expect(text).toContain("No other run is of the same recording");
    expect(text).toContain("Averages");
  });

  it("shows names as text", async () => {
    const named = estimates.map((run) => ({
      ...run,
      name: evil,
      aligned: evil,
      tables: [{ title: evil, protocol: evil, columns: [evil], rows: [[evil]] }],
    }));
    const { page } = await show({ ...sampleReport(named), title: evil, tables: named[0].tables });
    for (const tab of ["overview", "frame", "compare"]) await page.locator(`#tab-${tab}`).click();
    expect(await page.locator("img[src=x]").count()).toBe(0);
    expect(await page.locator(".panel").textContent()).toContain(evil);
  });
});

describe("a page of judged loops", () => {
  it("begins with the table of verdicts and shows the pair that is chosen", async () => {
    const { page } = await show(sampleReport([sampleJudged()]));
    expect(await page.locator("table.loops tbody tr").count()).toBe(3);
    expect(await page.locator("table.loops thead").textContent()).toContain("Verdict");
    await page.locator("table.loops tbody tr").nth(1).click();
    const detail = (await page.locator(".loop-detail").textContent()) ?? "";
    expect(detail).toContain("Wrong: by the ground truth");
    expect(detail).toContain("geometry");
    const legend = page.locator(".legend");
    expect(await legend.textContent()).toContain("loop missed");
  });

  it("without poses has no lost frames", async () => {
    const run = sampleJudged();
    const unposed = { ...run, up: null, aligned: null, components: [], summary: { ...run.summary, posed: 0 } };
    unposed.frames = { ...run.frames, component: { ...run.frames.component } };
    const count = run.summary.frames;
    const none = Buffer.from(Int32Array.from({ length: count }, () => -1).buffer).toString("base64");
    unposed.frames.component.data = none;
    const { page } = await show(sampleReport([unposed]));
    expect(await page.locator(".bands-legend").textContent()).not.toContain("lost");
    expect(await page.locator("table.loops tbody tr").count()).toBe(3);
  });

  it("shows names as text", async () => {
    const run = sampleJudged();
    const loops = run.loops && { ...run.loops, reason: run.loops.reason && { ...run.loops.reason, table: [evil, evil, evil] } };
    const { page } = await show(sampleReport([{ ...run, name: evil, loops }]));
    await page.locator("table.loops tbody tr").first().click();
    expect(await page.locator("img[src=x]").count()).toBe(0);
    expect(await page.locator(".loop-detail").textContent()).toContain(evil);
  });
});

describe("a run with a street map and a georeference", () => {
  const run = sampleRun({ frames: 300, landmarks: 0, street: true, earth: true });

  it("shows both, and saves the track", async () => {
    const { page } = await show(sampleReport([run]));
    expect(await page.locator("[data-layer=street]").isChecked()).toBe(true);
    expect(await page.locator(".legend").textContent()).toContain("building");
    const waiting = page.waitForEvent("download");
    await page.locator("button[title='Save the track as GPX']").click();
    const gpx = readFileSync(await (await waiting).path(), "utf8");
    expect(gpx.match(/<trkpt /g)).toHaveLength(299);
    await page.locator("#tab-pictures").click();
    const titles = await page.locator(".picture h3").allTextContents();
    expect(titles).toEqual(expect.arrayContaining(["Street map", "Track on the earth", "Floor plan"]));
    expect(await page.locator(".picture p.soft").allTextContents()).not.toContain(
      "This picture is no valid SVG, so it cannot be shown.",
    );
  });

  it("shows tracks over the image of a keyframe, and the position of the frame on the earth", async () => {
    const { page } = await show(sampleReport([run]));
    await page.keyboard.press("ArrowRight");
    await page.locator("#tab-frame").click();
    expect(await page.locator(".tracked circle").count()).toBe(10);
    expect(await page.locator(".panel").textContent()).toContain("Latitude, longitude");
  });
});
