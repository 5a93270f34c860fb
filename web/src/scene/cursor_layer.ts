import { BufferAttribute, BufferGeometry, Group, Matrix4, Points, PointsMaterial } from "three";
import { type Rgb, cssColour } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { isPosed } from "../data/run_view";
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

  show(run: RunData, row: number, loop: number, component: number | null, size: number): void {
    for (const child of [...this.object.children]) dispose(child);
    const ends = loop >= 0 ? loopEnds(run, loop, component) : null;
    if (ends !== null) {
      const link = new SegmentList();
      link.add(run.frames.pose, 7 * ends[0], run.frames.pose, 7 * ends[1], QUERY, MATCH);
      this.object.add(wideLines(link, 5), this.camera(run, ends[1], size, MATCH), this.camera(run, ends[0], size, QUERY));
    }
    if (!isPosed(run, row, component)) return;
    this.object.add(this.camera(run, row, 1.5 * size, CURSOR), pointAt(run, row));
  }

  private camera(run: RunData, row: number, size: number, colour: Rgb): ReturnType<typeof wideLines> {
    const list = new SegmentList();
    addFrustum(list, poseMatrix(run.frames.pose, row, new Matrix4()), imageShape(run), 2 * size, colour);
    return wideLines(list, 2.5);
  }
}

function pointAt(run: RunData, row: number): Points {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(run.frames.pose.slice(7 * row, 7 * row + 3)), 3));
  const size = 10 * Math.min(window.devicePixelRatio, 2);
  const material = new PointsMaterial({ color: cssColour(CURSOR), sizeAttenuation: false, size, depthTest: false, transparent: true });
  const points = new Points(geometry, material);
  points.renderOrder = 10;
  return points;
}
