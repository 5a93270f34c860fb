import { BufferAttribute, BufferGeometry, Points, PointsMaterial, Vector3, type Group } from "three";
import { robustRange, scaleColour, shareOf } from "../data/colour_scale";
import type { RunData } from "../data/model";
import { lengthUnit } from "../data/series";
import { componentOfKeyframe } from "../data/run_view";
import type { PointColour } from "../page/state";
import { type LegendItem, heightLegend, scaleLegend } from "./colouring";

/** The landmarks in a shuffled order: any first part of them is a fair sample of all. */
export class LandmarkLayer {
  readonly points: Points<BufferGeometry, PointsMaterial>;
  readonly count: number;
  private readonly rows: Uint32Array;

  constructor(
    private readonly run: RunData,
    component: number | null,
    private readonly group: Group,
  ) {
    this.rows = shuffled(visibleRows(run, component));
    this.count = this.rows.length;
    const { position } = run.landmarks;
    const positions = new Float32Array(3 * this.count);
    this.rows.forEach((row, i) => {
      for (let k = 0; k < 3; k++) positions[3 * i + k] = position[3 * row + k];
    });
    const geometry = new BufferGeometry();
    geometry.setAttribute("position", new BufferAttribute(positions, 3));
    geometry.setAttribute("color", new BufferAttribute(new Uint8Array(3 * this.count), 3, true));
    this.points = new Points(geometry, new PointsMaterial({ vertexColors: true, sizeAttenuation: false, size: 2 }));
    this.points.frustumCulled = false;
  }

  /** Draws at most `most` of the points. */
  setMost(most: number): void {
    this.points.geometry.setDrawRange(0, Math.min(this.count, most));
  }

  /** `ratio` is the number of pixels drawn for each pixel of the page. */
  setSize(pixels: number, ratio: number): void {
    this.points.material.size = Math.max(pixels * ratio, 1);
  }

  /** Colours the points; returns what the legend says, nothing for their own colours. */
  setColour(by: PointColour): LegendItem | null {
    const attribute = this.points.geometry.getAttribute("color");
    const bytes = attribute.array as Uint8Array;
    const { colour, sigma } = this.run.landmarks;
    let legend: LegendItem | null = null;
    if (by === "own" && colour !== null) {
      this.rows.forEach((row, i) => {
        for (let k = 0; k < 3; k++) bytes[3 * i + k] = colour[3 * row + k];
      });
    } else if (by === "uncertainty" && sigma !== null) {
      const range = robustRange(sigma);
      this.paint(bytes, (row) => shareOf(sigma[row], range));
      legend = scaleLegend("Uncertainty of landmarks (1 sigma)", "cividis", range, lengthUnit(this.run), true);
    } else {
      legend = this.paintHeights(bytes);
    }
    attribute.needsUpdate = true;
    return legend;
  }

  private paintHeights(bytes: Uint8Array): LegendItem {
    const heights = sceneHeights(this.run, this.group);
    const [low, high] = robustRange(heights, 0.02, 0.98);
    this.paint(bytes, (row) => shareOf(heights[row], [low, high]));
    return heightLegend(this.run, [0, high - low]);
  }

  private paint(bytes: Uint8Array, share: (row: number) => number): void {
    this.rows.forEach((row, i) => {
      const [r, g, b] = scaleColour("cividis", share(row));
      bytes[3 * i] = r;
      bytes[3 * i + 1] = g;
      bytes[3 * i + 2] = b;
    });
  }
}

/** Heights of all landmarks in the scene, whose y axis points up. */
export function sceneHeights(run: RunData, group: Group): Float32Array {
  const { position, count } = run.landmarks;
  const up = new Vector3(0, 1, 0).applyQuaternion(group.quaternion.clone().invert());
  const heights = new Float32Array(count);
  for (let i = 0; i < count; i++) {
    heights[i] = up.x * position[3 * i] + up.y * position[3 * i + 1] + up.z * position[3 * i + 2];
  }
  return heights;
}

function visibleRows(run: RunData, component: number | null): Uint32Array {
  const { count, keyframe, position } = run.landmarks;
  const componentOf = component === null ? null : componentOfKeyframe(run);
  const rows = new Uint32Array(count);
  let used = 0;
  for (let row = 0; row < count; row++) {
    const there = componentOf === null || componentOf.get(keyframe[row]) === component;
    if (there && Number.isFinite(position[3 * row])) rows[used++] = row;
  }
  return rows.subarray(0, used);
}

function shuffled(rows: Uint32Array): Uint32Array {
  let state = 12345;
  for (let i = rows.length - 1; i > 0; i--) {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    const j = Math.floor((state / 4294967296) * (i + 1));
    const kept = rows[i];
    rows[i] = rows[j];
    rows[j] = kept;
  }
  return rows;
}
