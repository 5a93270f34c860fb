/** Rotations as unit quaternions (x, y, z, w) and vectors, as plain tuples. */

export type Vec3 = [number, number, number];
export type Quat = [number, number, number, number];

export function rotate([x, y, z, w]: Quat, [a, b, c]: Vec3): Vec3 {
  const tx = 2 * (y * c - z * b);
  const ty = 2 * (z * a - x * c);
  const tz = 2 * (x * b - y * a);
  return [a + w * tx + y * tz - z * ty, b + w * ty + z * tx - x * tz, c + w * tz + x * ty - y * tx];
}

export function multiply([ax, ay, az, aw]: Quat, [bx, by, bz, bw]: Quat): Quat {
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

/** The three columns of the rotation matrix. */
export function axes(q: Quat): [Vec3, Vec3, Vec3] {
  return [rotate(q, [1, 0, 0]), rotate(q, [0, 1, 0]), rotate(q, [0, 0, 1])];
}

export function positionAt(pose: ArrayLike<number>, row: number): Vec3 {
  return [pose[7 * row], pose[7 * row + 1], pose[7 * row + 2]];
}

export function rotationAt(pose: ArrayLike<number>, row: number): Quat {
  return [pose[7 * row + 3], pose[7 * row + 4], pose[7 * row + 5], pose[7 * row + 6]];
}
