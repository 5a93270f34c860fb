/** Loop candidates as rows of a table: words, filters and order. */
import type { LoopTable } from "./model";
import { label } from "./model";

export const STAGES = [
  "retrieval",
  "reach",
  "geometry",
  "drift",
  "covariance",
  "support",
  "manual",
  "accepted",
] as const;

const STAGE_WORDS: Record<string, string> = {
  retrieval: "Refused: the images are not similar enough.",
  reach: "Refused: by odometry the two keyframes are too far apart for any loop between them.",
  geometry: "Refused: no relative pose agrees with the features.",
  drift: "Refused: the relative pose differs from odometry by more than its drift.",
  covariance: "Refused: the relative pose contradicts that of the map, given its covariance.",
  support: "Refused: no second loop agrees with it.",
  manual: "Refused: by hand.",
  accepted: "Accepted: the loop is a constraint of the map.",
};

export interface LoopFilter {
  /** Names of stages that are shown. */
  stages: ReadonlySet<string>;
  minProbability: number;
}

export type LoopColumn = "query" | "match" | "stage" | "probability" | "similarity" | "inliers" | "lines";

export interface LoopOrder {
  column: LoopColumn;
  descending: boolean;
}

export function stageOf(loops: LoopTable, row: number): string {
  return label(loops.stage, row) ?? "unknown";
}

/** What a stage means, as a sentence. */
export function stageSentence(stage: string): string {
  return STAGE_WORDS[stage] ?? `Decided by the test "${stage}".`;
}

/** The stages of a run with the number of loops each, in the order of the tests. */
export function stageCounts(loops: LoopTable): [string, number][] {
  const counts = new Map<string, number>();
  for (let row = 0; row < loops.count; row++) {
    const stage = stageOf(loops, row);
    counts.set(stage, (counts.get(stage) ?? 0) + 1);
  }
  return [...counts].sort((a, b) => rank(a[0]) - rank(b[0]));
}

function rank(stage: string): number {
  const index = (STAGES as readonly string[]).indexOf(stage);
  return index < 0 ? STAGES.length : index;
}

export function passes(loops: LoopTable, row: number, filter: LoopFilter): boolean {
  if (!filter.stages.has(stageOf(loops, row))) return false;
  // A probability that is unknown passes only where none is asked for.
  return filter.minProbability <= 0 || loops.probability[row] >= filter.minProbability;
}

export function filterLoops(loops: LoopTable, filter: LoopFilter): number[] {
  const rows: number[] = [];
  for (let row = 0; row < loops.count; row++) if (passes(loops, row, filter)) rows.push(row);
  return rows;
}

/** `rows` in order; unknown values come last in both directions. */
export function sortLoops(loops: LoopTable, rows: number[], order: LoopOrder): number[] {
  const key = (row: number): number =>
    order.column === "stage" ? rank(stageOf(loops, row)) : loops[order.column][row];
  const sign = order.descending ? -1 : 1;
  return [...rows].sort((a, b) => {
    const x = key(a);
    const y = key(b);
    if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y)) || a - b;
    return x === y ? a - b : sign * (x - y);
  });
}

/** Rows of loops that start or end at a frame: accepted ones first, then by probability. */
export function loopsAt(loops: LoopTable, frame: number): number[] {
  const rows: number[] = [];
  for (let row = 0; row < loops.count; row++) {
    if (loops.query[row] === frame || loops.match[row] === frame) rows.push(row);
  }
  const size = (row: number): number =>
    (stageOf(loops, row) === "accepted" ? 2 : 0) + (Number.isNaN(loops.probability[row]) ? -1 : loops.probability[row]);
  return rows.sort((a, b) => size(b) - size(a) || a - b);
}
