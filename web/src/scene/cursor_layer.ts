import { Group, Matrix4 } from "three";
import type { Rgb } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { isPosed, keyframeAt } from "../data/run_view";
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

  show(run: RunData, row: number, loop: number, component: number | null, size: number, landmarks: boolean): void {
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
    if (landmarks) this.object.add(this.landmarksOf(run, row));
  }

  /** The landmarks that the keyframe under the cursor has made. */
  private landmarksOf(run: RunData, row: number): ReturnType<typeof discs> {
    const keyframe = run.keyframes.id[keyframeAt(run, row)];
    const { count, keyframe: owner, position } = run.landmarks;
    const positions: number[] = [];
    for (let i = 0; i < count; i++) {
      if (owner[i] === keyframe) positions.push(position[3 * i], position[3 * i + 1], position[3 * i + 2]);
    }
    return discs(positions, CURSOR, 3.5);
  }

  private camera(run: RunData, row: number, size: number, colour: Rgb): ReturnType<typeof wideLines> {
    const list = new SegmentList();
    addFrustum(list, poseMatrix(run.frames.pose, row, new Matrix4()), imageShape(run), size, colour);
    return wideLines(list, 2.5, 9);
  }
}
