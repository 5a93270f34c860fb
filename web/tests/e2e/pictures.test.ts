/**
 * The 3D picture is what it was: small pictures of means are compared with those of tests/e2e/pictures. After a
 * change that is meant, UPDATE_PICTURES=1 writes them again.
 */
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import type { Page } from "playwright-core";
import { smallScene } from "../browser";
import { type Picture, decodePng, encodePng } from "../png";
import { sampleGraph, sampleReport, sampleRun } from "../sample";
import { pages } from "./pages";

const { show } = pages();
const FOLDER = join(import.meta.dirname, "pictures");
const SIZE = { width: 1000, height: 700 };

/** Mean and largest difference of the cells, of 255. */
function difference(a: Picture, b: Picture): { mean: number; largest: number } {
  let sum = 0;
  let largest = 0;
  for (let i = 0; i < a.rgb.length; i++) {
    const apart = Math.abs(a.rgb[i] - b.rgb[i]);
    sum += apart;
    largest = Math.max(largest, apart);
  }
  return { mean: sum / a.rgb.length, largest };
}

async function expectPicture(page: Page, name: string): Promise<void> {
  const picture = await smallScene(page);
  const file = join(FOLDER, `${name}.png`);
  if (process.env["UPDATE_PICTURES"] !== undefined) {
    mkdirSync(FOLDER, { recursive: true });
    writeFileSync(file, encodePng(picture));
  }
  const { mean, largest } = difference(picture, decodePng(readFileSync(file)));
  expect(mean, `${name}: mean difference`).toBeLessThan(2.5);
  expect(largest, `${name}: largest difference`).toBeLessThan(80);
}

describe("the picture of the scene", () => {
  it("of a run, by error, from above, and with other layers", async () => {
    const { page } = await show(sampleReport([sampleRun({ frames: 400, landmarks: 4000 })]), SIZE);
    await expectPicture(page, "run");
    await page.keyboard.press("v");
    for (const layer of ["m", "n", "i"]) await page.keyboard.press(layer);
    for (const layer of ["o", "r", "c", "p"]) await page.keyboard.press(layer);
    await expectPicture(page, "layers");
  });

  it("of a pose graph before and after, on light ground", async () => {
    const { page } = await show(sampleReport([], [sampleGraph()]), { ...SIZE, scheme: "light" });
    await page.getByRole("combobox", { name: "Shape of the graph" }).selectOption("both");
    await expectPicture(page, "graph");
  });

  it("differs where something is missing", async () => {
    const { page } = await show(sampleReport([sampleRun({ frames: 400, landmarks: 4000 })]), SIZE);
    await page.keyboard.press("j");
    await page.keyboard.press("m");
    const without = await smallScene(page);
    expect(difference(without, decodePng(readFileSync(join(FOLDER, "run.png")))).mean).toBeGreaterThan(2.5);
  });
});
