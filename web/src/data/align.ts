/** Alignment of one trajectory with another by least squares. */
import { type Quat, type Vec3, axes, rotate } from "./quaternion";

/** Maps a point p to scale * rotation * p + translation. */
export interface Alignment {
  rotation: Quat;
  translation: Vec3;
  scale: number;
}

export interface PosePair {
  from: { position: Vec3; rotation: Quat };
  to: { position: Vec3; rotation: Quat };
}

export const IDENTITY: Alignment = { rotation: [0, 0, 0, 1], translation: [0, 0, 0], scale: 1 };

export function apply(alignment: Alignment, point: Vec3): Vec3 {
  const [x, y, z] = rotate(alignment.rotation, point);
  const { scale: s, translation: t } = alignment;
  return [s * x + t[0], s * y + t[1], s * z + t[2]];
}

/**
 * The motion (a similarity with `withScale`) that maps `from` to `to` (Horn 1987).
 * Orientations count as positions at a hundredth of the extent do: they fix the rotation about a
 * straight path, which positions leave open.
 */
export function align(pairs: PosePair[], withScale: boolean): Alignment | null {
  if (pairs.length === 0) return null;
  const meanFrom = mean(pairs.map((pair) => pair.from.position));
  const meanTo = mean(pairs.map((pair) => pair.to.position));
  const products = new Float64Array(9);
  let squaresFrom = 0;
  let squaresTo = 0;
  for (const { from, to } of pairs) {
    const a = minus(from.position, meanFrom);
    const b = minus(to.position, meanTo);
    addProduct(products, a, b, 1);
    squaresFrom += dot(a, a);
    squaresTo += dot(b, b);
  }
  const scale = withScale && squaresFrom > 0 ? Math.sqrt(squaresTo / squaresFrom) : 1;
  const weight = 1e-4 * (Math.sqrt(squaresFrom * squaresTo) / pairs.length) + 1e-12;
  for (const { from, to } of pairs) {
    const a = axes(from.rotation);
    const b = axes(to.rotation);
    for (let k = 0; k < 3; k++) addProduct(products, a[k], b[k], weight);
  }
  const rotation = rotationOf(products);
  const moved = rotate(rotation, meanFrom);
  return {
    rotation,
    scale,
    translation: [meanTo[0] - scale * moved[0], meanTo[1] - scale * moved[1], meanTo[2] - scale * moved[2]],
  };
}

function mean(points: Vec3[]): Vec3 {
  const sum: Vec3 = [0, 0, 0];
  for (const p of points) for (let k = 0; k < 3; k++) sum[k] += p[k];
  return [sum[0] / points.length, sum[1] / points.length, sum[2] / points.length];
}

function minus(a: Vec3, b: Vec3): Vec3 {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a: Vec3, b: Vec3): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function addProduct(sum: Float64Array, a: Vec3, b: Vec3, weight: number): void {
  for (let i = 0; i < 3; i++) for (let j = 0; j < 3; j++) sum[3 * i + j] += weight * a[i] * b[j];
}

/** The rotation of Horn's method: the eigenvector of the largest eigenvalue of his matrix. */
function rotationOf(s: Float64Array): Quat {
  const [xx, xy, xz, yx, yy, yz, zx, zy, zz] = s;
  const n = [
    [xx + yy + zz, yz - zy, zx - xz, xy - yx],
    [yz - zy, xx - yy - zz, xy + yx, zx + xz],
    [zx - xz, xy + yx, -xx + yy - zz, yz + zy],
    [xy - yx, zx + xz, yz + zy, -xx - yy + zz],
  ];
  const [w, x, y, z] = largestEigenvector(n);
  return [x, y, z, w];
}

/** By Jacobi rotations, for a symmetric 4x4 matrix. */
function largestEigenvector(a: number[][]): number[] {
  const size = a.length;
  const v = a.map((_, i) => a.map((_, j) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < 60; sweep++) {
    let off = 0;
    for (let p = 0; p < size; p++) {
      for (let q = p + 1; q < size; q++) {
        off += a[p][q] * a[p][q];
        if (a[p][q] !== 0) jacobiRotation(a, v, p, q);
      }
    }
    if (off < 1e-300) break;
  }
  let best = 0;
  for (let i = 1; i < size; i++) if (a[i][i] > a[best][best]) best = i;
  return v.map((row) => row[best]);
}

function jacobiRotation(a: number[][], v: number[][], p: number, q: number): void {
  const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const t = (theta >= 0 ? 1 : -1) / (Math.abs(theta) + Math.sqrt(theta * theta + 1));
  const c = 1 / Math.sqrt(t * t + 1);
  const s = t * c;
  for (let k = 0; k < a.length; k++) {
    const kp = a[k][p];
    a[k][p] = c * kp - s * a[k][q];
    a[k][q] = s * kp + c * a[k][q];
  }
  for (let k = 0; k < a.length; k++) {
    const pk = a[p][k];
    a[p][k] = c * pk - s * a[q][k];
    a[q][k] = s * pk + c * a[q][k];
    const kp = v[k][p];
    v[k][p] = c * kp - s * v[k][q];
    v[k][q] = s * kp + c * v[k][q];
  }
}
