/** Inliers of the frames so far, lost frames as bands, accepted loops as triangles. */
import { type Rgb, categoryColour, cssColour } from "../data/colour_scale";
import { el } from "../page/dom";
import { stageColour } from "../scene/loops_layer";
import type { LiveRun } from "./live_run";

const HEIGHT = 96;
const BAND = 12;
const LOST: Rgb = [213, 94, 0];

export class LiveChart {
  readonly canvas = el("canvas", { class: "live-chart", role: "img", "aria-label": "Inliers of the frames" });
  readonly element = el(
    "div",
    {},
    this.canvas,
    el(
      "div",
      { class: "bands-legend" },
      entry("inliers", categoryColour(0)),
      entry("lost", LOST),
      entry("loop accepted", stageColour("accepted")),
    ),
  );

  draw(run: LiveRun): void {
    const ratio = Math.min(window.devicePixelRatio, 2);
    const width = Math.max(this.canvas.clientWidth, 1);
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = HEIGHT * ratio;
    const context = this.canvas.getContext("2d");
    if (!context) return;
    context.scale(ratio, ratio);
    const across = Math.max(run.total, run.frames.count, 2) - 1;
    const x = (row: number): number => (row / across) * (width - 50) + 44;
    this.drawInliers(context, run, x);
    drawLost(context, run, x);
    drawLoops(context, run, x);
  }

  private drawInliers(context: CanvasRenderingContext2D, run: LiveRun, x: (row: number) => number): void {
    const { frames } = run;
    let most = 10;
    for (let row = 0; row < frames.count; row++) if (frames.inliers(row) > most) most = frames.inliers(row);
    const bottom = HEIGHT - BAND - 4;
    const y = (value: number): number => bottom - (value / most) * (bottom - 12);
    context.fillStyle = getComputedStyle(this.canvas).color;
    context.font = "11px system-ui, sans-serif";
    context.textAlign = "right";
    context.fillText(String(Math.round(most)), 38, y(most) + 4);
    context.fillText("0", 38, bottom);
    context.strokeStyle = cssColour(categoryColour(0));
    context.lineWidth = 1.5;
    context.beginPath();
    let drawing = false;
    for (let row = 0; row < frames.count; row++) {
      const value = frames.inliers(row);
      if (!Number.isFinite(value)) drawing = false;
      else if (drawing) context.lineTo(x(row), y(value));
      else context.moveTo(x(row), y(value));
      drawing = Number.isFinite(value);
    }
    context.stroke();
  }
}

function drawLost(context: CanvasRenderingContext2D, run: LiveRun, x: (row: number) => number): void {
  const { frames } = run;
  let first = 0;
  while (first < frames.count && !frames.isPosed(first)) first++;
  /** Component of a frame; -1: lost; -2: neither, as before the map begins. */
  const kind = (row: number): number => {
    if (frames.isPosed(row)) return frames.component(row);
    return frames.state(row) === "initializing" || row < first ? -2 : -1;
  };
  for (let begin = 0, end = 0; begin < frames.count; begin = end) {
    while (end < frames.count && kind(end) === kind(begin)) end++;
    const lost = kind(begin) === -1;
    if (kind(begin) === -2) continue;
    context.fillStyle = cssColour(lost ? LOST : categoryColour(kind(begin)), lost ? 1 : 0.6);
    // Lost frames have the full height, so that they are known without their colour.
    if (lost) context.fillRect(x(begin), HEIGHT - BAND, Math.max(x(end) - x(begin), 1), BAND - 1);
    else context.fillRect(x(begin), HEIGHT - BAND + 3, x(end) - x(begin), BAND - 7);
  }
}

function drawLoops(context: CanvasRenderingContext2D, run: LiveRun, x: (row: number) => number): void {
  context.fillStyle = cssColour(stageColour("accepted"));
  for (const loop of run.loops.values()) {
    const row = run.frames.row(loop.query);
    if (!loop.accepted || row < 0) continue;
    context.beginPath();
    context.moveTo(x(row), 1);
    context.lineTo(x(row) - 4, 9);
    context.lineTo(x(row) + 4, 9);
    context.fill();
  }
}

function entry(text: string, colour: Rgb): HTMLElement {
  const mark = el("span", { class: "mark" });
  mark.style.background = cssColour(colour);
  return el("span", { class: "entry" }, mark, text);
}
