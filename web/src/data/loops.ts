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
/** Of loops that were compared with ground truth. */
export const VERDICTS = ["right", "wrong", "missed"] as const;

const STAGE_WORDS: Record<string, string> = {
  retrieval: "Refused: the images are not similar enough.",
  reach: "Refused: by odometry the two keyframes are too far apart for any loop between them.",
  geometry: "Refused: no relative pose agrees with the features.",
  drift: "Refused: the relative pose differs from odometry by more than its drift.",
  covariance: "Refused: the relative pose contradicts that of the map, given its covariance.",
  support: "Refused: no second loop agrees with it.",
  manual: "Refused: by hand.",
  accepted: "Accepted: the loop is a constraint of the map.",
  right: "Right: by the ground truth both images show the same place.",
  wrong: "Wrong: by the ground truth the two images do not show the same place.",
  missed: "Missed: by the ground truth both images show the same place, but no loop was found for the query.",
};

export interface LoopFilter {
  /** Names of stages that are shown. */
  stages: ReadonlySet<string>;
  minProbability: number;
}

export type LoopColumn = "query" | "match" | "stage" | "reason" | NumberColumn;
export type NumberColumn = "probability" | "similarity" | "inliers" | "lines" | "rank";

export interface LoopOrder {
  column: LoopColumn;
  descending: boolean;
}

export function stageOf(loops: LoopTable, row: number): string {
  return label(loops.stage, row) ?? "unknown";
}

/** Whether a loop is one of those that a run or a recognizer is right to have. */
export function isGood(stage: string): boolean {
  return stage === "accepted" || stage === "right";
}

/** A value of a loop; NaN where it is unknown. */
export function loopValue(loops: LoopTable, column: NumberColumn, row: number): number {
  return loops[column]?.[row] ?? NaN;
}

/** The values by which loops are filtered: probabilities, or the scores of a recognizer without any. */
export function certainty(loops: LoopTable): "probability" | "similarity" {
  return loops.probability === null ? "similarity" : "probability";
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
  const stages: readonly string[] = [...STAGES, ...VERDICTS];
  const index = stages.indexOf(stage);
  return index < 0 ? stages.length : index;
}

export function passes(loops: LoopTable, row: number, filter: LoopFilter): boolean {
  if (!filter.stages.has(stageOf(loops, row))) return false;
  // A loop that was missed has no probability; one that is unknown passes only where none is asked for.
  if (stageOf(loops, row) === "missed") return true;
  return filter.minProbability <= 0 || loopValue(loops, certainty(loops), row) >= filter.minProbability;
}

export function filterLoops(loops: LoopTable, filter: LoopFilter): number[] {
  const rows: number[] = [];
  for (let row = 0; row < loops.count; row++) if (passes(loops, row, filter)) rows.push(row);
  return rows;
}

/** `rows` in order; unknown values come last in both directions. */
export function sortLoops(loops: LoopTable, rows: number[], order: LoopOrder): number[] {
  const key = keyOf(loops, order.column);
  const sign = order.descending ? -1 : 1;
  return [...rows].sort((a, b) => {
    const x = key(a);
    const y = key(b);
    if (Number.isNaN(x) || Number.isNaN(y)) return Number(Number.isNaN(x)) - Number(Number.isNaN(y)) || a - b;
    return x === y ? a - b : sign * (x - y);
  });
}

function keyOf(loops: LoopTable, column: LoopColumn): (row: number) => number {
  switch (column) {
    case "stage":
      return (row) => rank(stageOf(loops, row));
    case "reason":
      return (row) => loops.reason?.index[row] ?? NaN;
    case "query":
    case "match":
      return (row) => loops[column][row];
    default:
      return (row) => loopValue(loops, column, row);
  }
}

/** Rows of loops that start or end at a frame: accepted ones first, then by probability. */
export function loopsAt(loops: LoopTable, frame: number): number[] {
  const rows: number[] = [];
  for (let row = 0; row < loops.count; row++) {
    if (loops.query[row] === frame || loops.match[row] === frame) rows.push(row);
  }
  const size = (row: number): number => {
    const probability = loopValue(loops, "probability", row);
    return (stageOf(loops, row) === "accepted" ? 2 : 0) + (Number.isNaN(probability) ? -1 : probability);
  };
  return rows.sort((a, b) => size(b) - size(a) || a - b);
}
