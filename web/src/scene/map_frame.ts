/** From the map (camera: x right, y down, z forward) to the scene (y up). */
import { Box3, Group, Matrix4, Quaternion, Sphere, Vector3 } from "three";
import type { RunData } from "../data/model";
import { rotationAt } from "../data/quaternion";
import { isPosed } from "../data/run_view";

/** A group in which map coordinates are right; its y axis points up, by -y of the first camera if nothing says so. */
export function mapGroup(run: RunData, component: number | null): Group {
  const group = new Group();
  group.quaternion.copy(uprightRotation(run, component));
  group.updateMatrixWorld(true);
  return group;
}

function uprightRotation(run: RunData, component: number | null): Quaternion {
  const axesToScene = new Quaternion(1, 0, 0, 0); // half a rotation about x: y and z change their signs
  if (run.up !== null) {
    const up = new Vector3(...run.up);
    return up.y < -0.9 ? axesToScene : new Quaternion().setFromUnitVectors(up, new Vector3(0, 1, 0));
  }
  for (let row = 0; row < run.frames.count; row++) {
    if (!isPosed(run, row, component)) continue;
    const [x, y, z, w] = rotationAt(run.frames.pose, row);
    const first = new Quaternion(x, y, z, w).normalize();
    return axesToScene.multiply(first.invert());
  }
  return axesToScene;
}

/** The sphere around all posed frames, in the scene. */
export function trajectorySphere(run: RunData, component: number | null, group: Group): Sphere {
  const box = new Box3();
  const point = new Vector3();
  for (let row = 0; row < run.frames.count; row++) {
    if (!isPosed(run, row, component)) continue;
    box.expandByPoint(point.fromArray(run.frames.pose, 7 * row).applyMatrix4(group.matrixWorld));
  }
  if (box.isEmpty()) return new Sphere(new Vector3(), 1);
  const sphere = box.getBoundingSphere(new Sphere());
  sphere.radius = Math.max(sphere.radius, 1e-3);
  return sphere;
}

/** The matrix of a pose. */
export function poseMatrix(pose: ArrayLike<number>, row: number, target = new Matrix4()): Matrix4 {
  const [x, y, z, w] = rotationAt(pose, row);
  const at = 7 * row;
  return target.compose(
    new Vector3(pose[at], pose[at + 1], pose[at + 2]),
    new Quaternion(x, y, z, w).normalize(),
    new Vector3(1, 1, 1),
  );
}
