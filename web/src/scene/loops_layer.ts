import type { Object3D } from "three";
import { type Rgb, UNKNOWN_COLOUR, categoryColour } from "../data/colour_scale";
import { STAGES, filterLoops, isGood, stageOf, type LoopFilter } from "../data/loops";
import type { RunData } from "../data/model";
import { isPosed } from "../data/run_view";
import { SegmentList, thinLines, wideLines } from "./lines";

/** Bluish green for accepted and right loops, vermilion for wrong ones, other colours for the tests that refuse. */
export function stageColour(stage: string): Rgb {
  if (isGood(stage)) return categoryColour(2);
  if (stage === "wrong") return [213, 94, 0];
  if (stage === "missed") return categoryColour(1);
  const others = [6, 3, 1, 4, 5, 0];
  const index = (STAGES as readonly string[]).indexOf(stage);
  return index < 0 ? UNKNOWN_COLOUR : categoryColour(others[index % others.length]);
}

/** Rows of the frames of a loop; nothing if one of them has no pose in `component`. */
export function loopEnds(run: RunData, loop: number, component: number | null): [number, number] | null {
  const a = run.frames.rowOf.get(run.loops.query[loop]);
  const b = run.frames.rowOf.get(run.loops.match[loop]);
  if (a === undefined || b === undefined) return null;
  return isPosed(run, a, component) && isPosed(run, b, component) ? [a, b] : null;
}

export function loopRows(run: RunData, filter: LoopFilter, accepted: boolean): number[] {
  return filterLoops(run.loops, filter).filter((row) => isGood(stageOf(run.loops, row)) === accepted);
}

export function loopLines(run: RunData, component: number | null, rows: number[], accepted: boolean): Object3D {
  const list = new SegmentList();
  for (const row of rows) {
    const ends = loopEnds(run, row, component);
    if (ends === null) continue;
    list.add(run.frames.pose, 7 * ends[0], run.frames.pose, 7 * ends[1], stageColour(stageOf(run.loops, row)));
  }
  return accepted || run.loops.judged ? wideLines(list, 2, 4) : thinLines(list, 0.6);
}
