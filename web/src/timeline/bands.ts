/** Coloured bands below the graph: lost frames and components, environments, markers of loops. */
import { type Rgb, categoryColour, cssColour } from "../data/colour_scale";
import { filterLoops, isGood, stageOf, stageCounts, type LoopFilter } from "../data/loops";
import type { RunData } from "../data/model";
import { label } from "../data/model";
import { stageColour } from "../scene/loops_layer";
import { el } from "../page/dom";
import type { Axis } from "./axis";

const ROW = 12;
const LOST: Rgb = [213, 94, 0];

export class Bands {
  readonly canvas = el("canvas", { class: "bands" });

  draw(run: RunData, axis: Axis, range: [number, number], width: number, filter: LoopFilter, selected: number): void {
    const ratio = Math.min(window.devicePixelRatio, 2);
    const rows = 2 + (run.frames.environment ? 1 : 0);
    this.canvas.width = Math.max(1, Math.round(width * ratio));
    this.canvas.height = rows * ROW * ratio;
    this.canvas.style.height = `${rows * ROW}px`;
    const context = this.canvas.getContext("2d");
    if (!context) return;
    context.scale(ratio, ratio);
    const numbers = run.components.map((component) => component.number);
    drawSpans(context, run, axis, range, width, 0, (row) => {
      const component = run.frames.component[row];
      if (run.summary.posed === 0) return "transparent";
      return component < 0 ? null : cssColour(categoryColour(numbers.indexOf(component)), 0.75);
    });
    const { environment } = run.frames;
    if (environment) {
      drawSpans(context, run, axis, range, width, ROW, (row) =>
        label(environment, row) === null ? "transparent" : cssColour(categoryColour(environment.index[row] + 3), 0.75),
      );
    }
    drawLoops(context, run, axis, range, width, (rows - 1) * ROW, filter, selected);
  }
}

/** A row of spans in which `colour` is the same; null is drawn as lost. */
function drawSpans(
  context: CanvasRenderingContext2D,
  run: RunData,
  axis: Axis,
  range: [number, number],
  width: number,
  y: number,
  colour: (row: number) => string | null,
): void {
  const { count } = run.frames;
  let start = 0;
  for (let row = 1; row <= count; row++) {
    if (row < count && colour(row) === colour(start)) continue;
    const left = axis.pixel(axis.values[start], range, width);
    const right = axis.pixel(axis.values[Math.min(row, count - 1)], range, width);
    const fill = colour(start);
    context.fillStyle = fill ?? cssColour(LOST);
    // Lost frames have the full height, so that they are known without their colour.
    context.fillRect(left, fill === null ? y : y + 3, Math.max(right - left, 1), fill === null ? ROW - 1 : ROW - 6);
    start = row;
  }
}

function drawLoops(
  context: CanvasRenderingContext2D,
  run: RunData,
  axis: Axis,
  range: [number, number],
  width: number,
  y: number,
  filter: LoopFilter,
  selected: number,
): void {
  const rank = (loop: number): number => (loop === selected ? 2 : isGood(stageOf(run.loops, loop)) ? 1 : 0);
  for (const loop of filterLoops(run.loops, filter).sort((a, b) => rank(a) - rank(b))) {
    const row = run.frames.rowOf.get(run.loops.query[loop]);
    if (row === undefined) continue;
    const stage = stageOf(run.loops, loop);
    const accepted = isGood(stage) || run.loops.judged;
    const x = axis.pixel(axis.values[row], range, width);
    const half = loop === selected ? 6 : accepted ? 4 : 2.5;
    context.fillStyle = cssColour(stageColour(stage), accepted ? 1 : 0.6);
    context.beginPath();
    context.moveTo(x, y + 1);
    context.lineTo(x - half, y + ROW - 2);
    context.lineTo(x + half, y + ROW - 2);
    context.closePath();
    if (accepted || loop === selected) context.fill();
    else {
      context.strokeStyle = context.fillStyle;
      context.stroke();
    }
  }
}

export function bandsLegend(run: RunData): HTMLElement {
  const box = el("div", { class: "bands-legend" });
  const add = (text: string, colour: string): void => {
    const mark = el("span", { class: "mark" });
    mark.style.background = colour;
    box.append(el("span", { class: "entry" }, mark, text));
  };
  if (run.summary.posed > 0 && run.summary.posed < run.summary.frames) add("lost", cssColour(LOST));
  run.components.forEach((component, i) =>
    add(run.components.length > 1 ? `component ${component.number}` : "with a pose", cssColour(categoryColour(i))),
  );
  run.frames.environment?.table.forEach((name, i) => add(name, cssColour(categoryColour(i + 3))));
  if (run.loops.judged) {
    for (const [stage] of stageCounts(run.loops)) add(`loop ${stage}`, cssColour(stageColour(stage)));
  } else if (stageCounts(run.loops).some(([stage]) => isGood(stage))) {
    add("loop accepted (open triangle: refused)", cssColour(stageColour("accepted")));
  } else if (run.loops.count > 0) add("loop refused", cssColour(stageColour(stageCounts(run.loops)[0][0])));
  return box;
}
