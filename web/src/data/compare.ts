/** Comparison of two runs of one sequence on the frames that both have posed. */
import { type Alignment, type PosePair, IDENTITY, align, apply } from "./align";
import type { RunData } from "./model";
import { type Vec3, positionAt, rotationAt } from "./quaternion";

/** The frames on which two runs are aligned; "truth": none, both are in the frame of the ground truth. */
export type AlignOn = "beginning" | "whole" | "truth";

export interface Comparison {
  /** Frame ids that both runs have posed in their main components, ascending. */
  ids: number[];
  /** Distance at each of these between the reference and the aligned other run. */
  distance: Float64Array;
  /** Maps positions of the other run to the reference. */
  alignment: Alignment;
  /** Number of frames on which the alignment is computed. */
  alignedOn: number;
  withScale: boolean;
}

export function mainComponent(run: RunData): number {
  const main = run.components.find((component) => component.main) ?? run.components[0];
  return main?.number ?? 0;
}

function posedRows(run: RunData): Map<number, number> {
  const { frames } = run;
  const main = mainComponent(run);
  const rows = new Map<number, number>();
  for (let row = 0; row < frames.count; row++) {
    if (frames.component[row] === main && Number.isFinite(frames.pose[7 * row])) rows.set(frames.id[row], row);
  }
  return rows;
}

/** The beginning: a tenth of the common frames, at least ten of them. */
export function beginningCount(common: number): number {
  return Math.min(common, Math.max(10, Math.round(common / 10)));
}

/** Whether two runs are of one recording, so that their frames can be compared. */
export function comparable(a: RunData, b: RunData): boolean {
  return a.recording === "" || b.recording === "" || a.recording === b.recording;
}

export function bothInTruth(a: RunData, b: RunData): boolean {
  return a.aligned !== null && b.aligned !== null;
}

/** The scale is fitted where a run is not metric: its scale is arbitrary. */
export function compareRuns(reference: RunData, other: RunData, on: AlignOn): Comparison | null {
  if (!comparable(reference, other)) return null;
  const rowsA = posedRows(reference);
  const rowsB = posedRows(other);
  const ids = [...rowsA.keys()].filter((id) => rowsB.has(id)).sort((a, b) => a - b);
  if (ids.length < 3) return null;
  const pairs = ids.map((id): PosePair => {
    const a = rowsA.get(id) ?? 0;
    const b = rowsB.get(id) ?? 0;
    return {
      from: { position: positionAt(other.frames.pose, b), rotation: rotationAt(other.frames.pose, b) },
      to: { position: positionAt(reference.frames.pose, a), rotation: rotationAt(reference.frames.pose, a) },
    };
  });
  const inTruth = on === "truth" && bothInTruth(reference, other);
  const alignedOn = inTruth ? 0 : on === "whole" ? ids.length : beginningCount(ids.length);
  const withScale = !inTruth && (!reference.metric || !other.metric);
  const alignment = inTruth ? IDENTITY : (align(pairs.slice(0, alignedOn), withScale) ?? IDENTITY);
  const distance = Float64Array.from(pairs, (pair) => between(apply(alignment, pair.from.position), pair.to.position));
  return { ids, distance, alignment, alignedOn, withScale };
}

function between(a: Vec3, b: Vec3): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/** The id of the first common frame at which the runs are further apart than `threshold`. */
export function firstParting(comparison: Comparison, threshold: number): number | null {
  const at = comparison.distance.findIndex((distance) => distance > threshold);
  return at < 0 ? null : comparison.ids[at];
}

/** A round threshold for a path: about half a percent of its length, 1, 2 or 5 times a power of 10. */
export function defaultThreshold(pathLength: number): number {
  const target = Math.max(pathLength * 0.005, 1e-6);
  const power = 10 ** Math.floor(Math.log10(target));
  const step = [5, 2, 1].find((factor) => factor * power <= target) ?? 1;
  return Number((step * power).toPrecision(1));
}

export function rms(values: ArrayLike<number>): number {
  let sum = 0;
  for (let i = 0; i < values.length; i++) sum += values[i] * values[i];
  return Math.sqrt(sum / values.length);
}
