/** Questions about the frames, keyframes and components of a run that several views ask. */
import type { RunData } from "./model";
import { positionAt } from "./quaternion";

/** Whether a frame has a pose in `component` (null: in any). */
export function isPosed(run: RunData, row: number, component: number | null): boolean {
  const { frames } = run;
  const number = frames.component[row];
  return number >= 0 && (component === null || number === component) && Number.isFinite(frames.pose[7 * row]);
}

/** Row of the frame of a keyframe, or -1. */
export function frameRowOfKeyframe(run: RunData, keyframeRow: number): number {
  return run.frames.rowOf.get(run.keyframes.frame[keyframeRow]) ?? -1;
}

/** Row of the keyframe that a frame is, or -1. */
export function keyframeOf(run: RunData, row: number): number {
  const keyframe = run.keyframes.rowOf.get(run.frames.keyframe[row]) ?? -1;
  return keyframe >= 0 && run.keyframes.frame[keyframe] === run.frames.id[row] ? keyframe : -1;
}

/** Row of the last keyframe at or before a frame; the first keyframe for frames before it; -1 without keyframes. */
export function keyframeAt(run: RunData, row: number): number {
  const frameId = run.frames.id[row];
  const { frame, count, byFrame } = run.keyframes;
  let low = 0;
  let high = count - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (frame[byFrame[middle]] <= frameId) low = middle;
    else high = middle - 1;
  }
  return count === 0 ? -1 : byFrame[low];
}

/** The component of the frame of each keyframe id. */
export function componentOfKeyframe(run: RunData): Map<number, number> {
  const result = new Map<number, number>();
  for (let k = 0; k < run.keyframes.count; k++) {
    const row = frameRowOfKeyframe(run, k);
    result.set(run.keyframes.id[k], row >= 0 ? run.frames.component[row] : -1);
  }
  return result;
}

/** Median distance between neighbouring posed keyframes; a measure for sizes in the scene. */
export function keyframeSpacing(run: RunData, component: number | null): number {
  const distances: number[] = [];
  let before = -1;
  for (const k of run.keyframes.byFrame) {
    const row = frameRowOfKeyframe(run, k);
    if (row < 0 || !isPosed(run, row, component)) continue;
    if (before >= 0) {
      const a = positionAt(run.frames.pose, before);
      const b = positionAt(run.frames.pose, row);
      distances.push(Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
    before = row;
  }
  distances.sort((a, b) => a - b);
  return distances[distances.length >> 1] ?? 0;
}
