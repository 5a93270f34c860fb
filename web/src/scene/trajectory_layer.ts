import type { Object3D } from "three";
import type { Values } from "../data/column";
import type { Rgb } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { isPosed } from "../data/run_view";
import { SegmentList, thinLines, wideLines } from "./lines";

/** The optimized trajectory; it has gaps where frames are lost and between components. */
export function trajectoryLines(run: RunData, component: number | null, colour: (row: number) => Rgb): Object3D {
  return wideLines(segments(run, run.frames.pose, component, colour), 3.5, 5);
}

export function plainTrajectory(
  run: RunData,
  poses: Values,
  component: number | null,
  colour: Rgb,
  opacity = 1,
): Object3D {
  return thinLines(
    segments(run, poses, component, () => colour),
    opacity,
  );
}

/** Ground truth has poses for lost frames too. */
export function truthLines(truth: Values, colour: Rgb): Object3D {
  const list = new SegmentList();
  for (let i = 0; i + 7 < truth.length; i += 7) {
    if (Number.isFinite(truth[i]) && Number.isFinite(truth[i + 7])) list.add(truth, i, truth, i + 7, colour);
  }
  return thinLines(list);
}

function segments(run: RunData, poses: Values, component: number | null, colour: (row: number) => Rgb): SegmentList {
  const list = new SegmentList();
  const numbers = run.frames.component;
  for (let row = 0; row + 1 < run.frames.count; row++) {
    const there = isPosed(run, row, component) && isPosed(run, row + 1, component) && numbers[row] === numbers[row + 1];
    if (!there || !Number.isFinite(poses[7 * row]) || !Number.isFinite(poses[7 * row + 7])) continue;
    list.add(poses, 7 * row, poses, 7 * row + 7, colour(row), colour(row + 1));
  }
  return list;
}
