import { BufferAttribute, BufferGeometry, Points, PointsMaterial, type Quaternion, Vector3 } from "three";
import { robustRange, scaleColour, shareOf } from "../data/colour_scale";
import type { QualityLevel } from "../scene/quality";
import { type Viewport, pixelRatio } from "../scene/viewport";
import type { LandmarkList } from "./landmark_list";

/** More landmarks are thinned evenly. */
const MOST = 200000;
/** A step that has no common divisor with MOST: any first part of the points is a fair sample. */
const STEP = 7919;

/** The landmarks of a run that goes on, coloured by height, with colours that are seen on dark and bright ground. */
export class LivePoints {
  readonly object: Points<BufferGeometry, PointsMaterial>;
  private count = 0;

  constructor(private readonly viewport: Viewport) {
    this.object = new Points(new BufferGeometry(), new PointsMaterial({ vertexColors: true, sizeAttenuation: false }));
    this.object.frustumCulled = false;
    this.setQuality(null);
  }

  show({ position: landmarks, count }: LandmarkList, toScene: Quaternion): void {
    const rows = finiteRows(landmarks, count, Math.max(1, Math.ceil(count / MOST)));
    const up = new Vector3(0, 1, 0).applyQuaternion(toScene.clone().invert());
    const heights = Float32Array.from(rows, (row) => {
      return up.x * landmarks[3 * row] + up.y * landmarks[3 * row + 1] + up.z * landmarks[3 * row + 2];
    });
    const range = robustRange(heights, 0.02, 0.98);
    const positions = new Float32Array(3 * rows.length);
    const colours = new Uint8Array(3 * rows.length);
    rows.forEach((row, i) => {
      for (let k = 0; k < 3; k++) positions[3 * i + k] = landmarks[3 * row + k];
      colours.set(scaleColour("viridis", 0.25 + 0.6 * clamped(shareOf(heights[i], range))), 3 * i);
    });
    this.count = rows.length;
    this.object.geometry.dispose();
    this.object.geometry = new BufferGeometry();
    this.object.geometry.setAttribute("position", new BufferAttribute(positions, 3));
    this.object.geometry.setAttribute("color", new BufferAttribute(colours, 3, true));
    this.setQuality(this.viewport.level);
  }

  /** Draws less while something moves, all with null. */
  setQuality(level: QualityLevel | null): void {
    this.object.geometry.setDrawRange(0, Math.min(this.count, level?.points ?? Infinity));
    this.object.material.size = Math.max(2 * pixelRatio() * (level?.resolution ?? 1), 1);
  }
}

function clamped(share: number): number {
  return Math.min(Math.max(share, 0), 1);
}

/** Every `stride`-th row with a position, in an order in which neighbours are far apart. */
function finiteRows(landmarks: Float32Array, count: number, stride: number): number[] {
  const all: number[] = [];
  for (let row = 0; row < count; row += stride) {
    if (Number.isFinite(landmarks[3 * row])) all.push(row);
  }
  const step = all.length % STEP === 0 ? 1 : STEP;
  return all.map((_, i) => all[(i * step) % all.length]);
}
