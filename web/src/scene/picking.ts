/** What is under the pointer: frames by their position on the screen, loops by their lines. */
import { Matrix4 } from "three";
import type { RunData } from "../data/model";
import { isPosed } from "../data/run_view";
import { loopEnds } from "./loops_layer";

export interface Screen {
  width: number;
  height: number;
  /** From the map to clip coordinates. */
  matrix: Matrix4;
}

export function nearestFrame(
  run: RunData,
  component: number | null,
  screen: Screen,
  x: number,
  y: number,
  radius: number,
): number {
  let best = -1;
  let bestDistance = radius;
  for (let row = 0; row < run.frames.count; row++) {
    if (!isPosed(run, row, component)) continue;
    const p = onScreen(run, row, screen);
    if (p === null) continue;
    const distance = Math.hypot(p[0] - x, p[1] - y);
    if (distance < bestDistance) {
      best = row;
      bestDistance = distance;
    }
  }
  return best;
}

export function nearestLoop(
  run: RunData,
  component: number | null,
  rows: number[],
  screen: Screen,
  x: number,
  y: number,
  radius: number,
): number {
  let best = -1;
  let bestDistance = radius;
  for (const loop of rows) {
    const ends = loopEnds(run, loop, component);
    if (ends === null) continue;
    const a = onScreen(run, ends[0], screen);
    const b = onScreen(run, ends[1], screen);
    if (a === null || b === null) continue;
    const distance = toSegment(x, y, a, b);
    if (distance < bestDistance) {
      best = loop;
      bestDistance = distance;
    }
  }
  return best;
}

/** Of the landmarks in `rows`. */
export function nearestLandmark(
  run: RunData,
  rows: Int32Array,
  screen: Screen,
  x: number,
  y: number,
  radius: number,
): number {
  let best = -1;
  let bestDistance = radius;
  for (const row of rows) {
    const p = row < 0 ? null : pointOnScreen(run.landmarks.position, 3 * row, screen);
    if (p === null) continue;
    const distance = Math.hypot(p[0] - x, p[1] - y);
    if (!(distance < bestDistance)) continue;
    best = row;
    bestDistance = distance;
  }
  return best;
}

function onScreen(run: RunData, row: number, screen: Screen): [number, number] | null {
  return pointOnScreen(run.frames.pose, 7 * row, screen);
}

function pointOnScreen(
  values: ArrayLike<number>,
  at: number,
  { width, height, matrix }: Screen,
): [number, number] | null {
  const [x, y, z] = [values[at], values[at + 1], values[at + 2]];
  const e = matrix.elements;
  const w = e[3] * x + e[7] * y + e[11] * z + e[15];
  if (w <= 0) return null;
  const u = (e[0] * x + e[4] * y + e[8] * z + e[12]) / w;
  const v = (e[1] * x + e[5] * y + e[9] * z + e[13]) / w;
  return [((u + 1) / 2) * width, ((1 - v) / 2) * height];
}

export function toSegment(x: number, y: number, [ax, ay]: [number, number], [bx, by]: [number, number]): number {
  const [dx, dy] = [bx - ax, by - ay];
  const length = dx * dx + dy * dy;
  const share = length === 0 ? 0 : Math.min(1, Math.max(0, ((x - ax) * dx + (y - ay) * dy) / length));
  return Math.hypot(ax + share * dx - x, ay + share * dy - y);
}
