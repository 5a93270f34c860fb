import { Group, Matrix4 } from "three";
import type { Rgb } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { isPosed, keyframeAt } from "../data/run_view";
import type { State } from "../page/state";
import { discs } from "./discs";
import { addFrustum, imageShape } from "./frusta_layer";
import { SegmentList, dispose, wideLines } from "./lines";
import { loopEnds } from "./loops_layer";
import { poseMatrix } from "./map_frame";

export const CURSOR: Rgb = [255, 64, 129];
export const QUERY: Rgb = [230, 159, 0];
export const MATCH: Rgb = [86, 180, 233];

/** The camera of the frame under the cursor and, if a loop is selected, its two cameras. */
export class CursorLayer {
  readonly object = new Group();

  show(run: RunData, { row, loop, component, layers, observed, landmark }: Readonly<State>, size: number): void {
    for (const child of [...this.object.children]) dispose(child);
    const ends = loop >= 0 ? loopEnds(run, loop, component) : null;
    if (ends !== null) {
      const link = new SegmentList();
      link.add(run.frames.pose, 7 * ends[0], run.frames.pose, 7 * ends[1], QUERY, MATCH);
      this.object.add(
        wideLines(link, 5, 8),
        this.camera(run, ends[1], 1.5 * size, MATCH),
        this.camera(run, ends[0], 1.5 * size, QUERY),
      );
    }
    if (!isPosed(run, row, component)) return;
    const point = discs(run.frames.pose.slice(7 * row, 7 * row + 3), CURSOR, 11);
    point.material.depthTest = false;
    point.renderOrder = 10;
    this.object.add(this.camera(run, row, 1.7 * size, CURSOR), point);
    if (layers.landmarks) this.object.add(observed ? pointsOf(run, observed, 3.5) : this.landmarksOf(run, row));
    if (landmark < 0) return;
    const mark = pointsOf(run, [landmark], 14);
    mark.material.depthTest = false;
    mark.renderOrder = 11;
    const ray = new SegmentList();
    ray.add(run.frames.pose, 7 * row, run.landmarks.position, 3 * landmark, CURSOR);
    this.object.add(mark, wideLines(ray, 1.5, 10));
  }

  /** The landmarks that the keyframe under the cursor has made. */
  private landmarksOf(run: RunData, row: number): ReturnType<typeof discs> {
    const keyframe = run.keyframes.id[keyframeAt(run, row)];
    const { count, keyframe: owner } = run.landmarks;
    const rows: number[] = [];
    for (let i = 0; i < count; i++) if (owner[i] === keyframe) rows.push(i);
    return pointsOf(run, rows, 3.5);
  }

  private camera(run: RunData, row: number, size: number, colour: Rgb): ReturnType<typeof wideLines> {
    const list = new SegmentList();
    addFrustum(list, poseMatrix(run.frames.pose, row, new Matrix4()), imageShape(run), size, colour);
    return wideLines(list, 2.5, 9);
  }
}

/** Landmarks as discs. */
function pointsOf(run: RunData, rows: ArrayLike<number>, pixels: number): ReturnType<typeof discs> {
  const { position, count } = run.landmarks;
  const positions: number[] = [];
  for (let i = 0; i < rows.length; i++) {
    const at = 3 * rows[i];
    if (at >= 0 && at < 3 * count) positions.push(position[at], position[at + 1], position[at + 2]);
  }
  return discs(positions, CURSOR, pixels);
}
