import { type Matrix4, type Object3D, Vector3 } from "three";
import type { Rgb } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { frameRowOfKeyframe, isPosed } from "../data/run_view";
import { SegmentList, thinLines } from "./lines";
import { poseMatrix } from "./map_frame";

/** Half the width, half the height and the centre of the image at depth 1. */
export interface ImageShape {
  halfWidth: number;
  halfHeight: number;
  x: number;
  y: number;
}

export function imageShape(run: RunData): ImageShape {
  const { camera } = run;
  if (camera === null) return { halfWidth: 0.6, halfHeight: 0.4, x: 0, y: 0 };
  return {
    halfWidth: camera.width / (2 * camera.fx),
    halfHeight: camera.height / (2 * camera.fy),
    x: (camera.width / 2 - camera.cx) / camera.fx,
    y: (camera.height / 2 - camera.cy) / camera.fy,
  };
}

/** Adds the pyramid of one camera: its four edges, its image and a mark at the upper side. */
export function addFrustum(list: SegmentList, pose: Matrix4, shape: ImageShape, size: number, colour: Rgb): void {
  const at = (x: number, y: number, z: number): number[] =>
    new Vector3(x, y, z).multiplyScalar(size).applyMatrix4(pose).toArray();
  const { halfWidth: w, halfHeight: h, x, y } = shape;
  const apex = at(0, 0, 0);
  const corners = [at(x - w, y - h, 1), at(x + w, y - h, 1), at(x + w, y + h, 1), at(x - w, y + h, 1)];
  corners.forEach((corner, i) => {
    list.add(apex, 0, corner, 0, colour);
    list.add(corner, 0, corners[(i + 1) % 4], 0, colour);
  });
  const up = at(x, y - 1.4 * h, 1);
  list.add(corners[0], 0, up, 0, colour);
  list.add(corners[1], 0, up, 0, colour);
}

export function frustaLines(run: RunData, component: number | null, size: number, colour: Rgb): Object3D {
  const list = new SegmentList();
  const shape = imageShape(run);
  for (let k = 0; k < run.keyframes.count; k++) {
    const row = frameRowOfKeyframe(run, k);
    if (row >= 0 && isPosed(run, row, component))
      addFrustum(list, poseMatrix(run.frames.pose, row), shape, size, colour);
  }
  return thinLines(list, 0.55);
}
