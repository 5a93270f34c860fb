import { Box3, Group, Matrix4, Quaternion, Sphere, Vector3 } from "three";
import { type Rgb, categoryColour } from "../data/colour_scale";
import { CURSOR } from "../scene/cursor_layer";
import { addFrustum } from "../scene/frusta_layer";
import { SegmentList, dispose, thinLines, wideLines } from "../scene/lines";
import { stageColour } from "../scene/loops_layer";
import { poseMatrix } from "../scene/map_frame";
import type { Viewport } from "../scene/viewport";
import { LiveMotion } from "./live_motion";
import { LivePath } from "./live_path";
import { LivePoints } from "./live_points";
import type { LiveRun } from "./live_run";

/** Of the refused loops the newest are drawn: all of them would hide the map. */
export const REFUSED_SHOWN = 20;
export const REFUSED: Rgb = [150, 130, 130];
export const TRAJECTORY = categoryColour(0);
/** A new loop is drawn wider for this time. */
const NEW_MS = 2500;
const LANDMARKS_MS = 400;

/** Trajectory, landmarks, loops and the newest camera of a run that goes on, in the scene. */
export class LiveMap {
  readonly group = new Group();
  readonly points: LivePoints;
  private readonly motion = new LiveMotion();
  private readonly path = new LivePath(TRAJECTORY);
  private extras = new Group();
  private seen = { moves: -1, began: 0, shifts: 0, component: -1, upright: false };
  private newest = { key: "", since: -Infinity };
  private shownLandmarks = { count: 0, moves: -1, upright: false, at: -Infinity };

  constructor(
    viewport: Viewport,
    private readonly run: LiveRun,
    /** Width over height of the images. */
    private readonly aspect: () => number,
  ) {
    this.points = new LivePoints(viewport);
    this.group.add(this.path.object, this.points.object, this.extras);
  }

  /** Whether the map moves to new poses. */
  get moving(): boolean {
    return this.motion.moving;
  }

  /** Whether the next picture differs though nothing comes from the run. */
  get changing(): boolean {
    return this.motion.moving || performance.now() - this.newest.since < NEW_MS;
  }

  /** An accepted loop has come: it is drawn wider for a while. */
  noteLoop(key: string): void {
    this.newest = { key, since: performance.now() };
  }

  /** Takes what the run has now. */
  update(): void {
    const { run, seen } = this;
    const { moves, began, component } = run;
    const { shifts } = run.frames;
    if (began !== seen.began || shifts !== seen.shifts || component !== seen.component) {
      this.motion.clear();
      seen.upright = false;
    } else if (moves !== seen.moves) {
      this.motion.start(run.frames, performance.now());
    }
    this.seen = { moves, began, shifts, component, upright: seen.upright || this.stand(component) };
    this.showLandmarks();
  }

  /** Builds what has changed; `size` is that of the camera. */
  draw(size: number): void {
    const { frames } = this.run;
    const first = this.motion.step(frames, performance.now());
    if (first < frames.count || frames.count === 0) {
      this.path.update(this.motion.shown, frames.count, first, (row) => this.isShown(row) && this.isShown(row + 1));
    }
    dispose(this.extras);
    this.extras = new Group();
    this.group.add(this.extras);
    this.addLoops();
    this.addCamera(size);
  }

  /** Position in the scene of the newest frame with a pose. */
  newestPosition(): Vector3 | null {
    const row = this.newestRow();
    return row < 0 ? null : new Vector3().fromArray(this.motion.shown, 3 * row).applyMatrix4(this.group.matrixWorld);
  }

  /** The sphere around the trajectory, in the scene. */
  sphere(): Sphere {
    const box = new Box3();
    const point = new Vector3();
    for (let row = 0; row < this.motion.count; row++) {
      if (!this.isShown(row)) continue;
      box.expandByPoint(point.fromArray(this.motion.shown, 3 * row).applyMatrix4(this.group.matrixWorld));
    }
    const sphere = box.getBoundingSphere(new Sphere());
    sphere.radius = Math.max(sphere.radius, 1e-3);
    return sphere;
  }

  /** The y axis of the scene points against y of the first camera, which points down; false without any. */
  private stand(component: number): boolean {
    const { frames } = this.run;
    for (let row = 0; row < frames.count; row++) {
      if (!frames.isPosed(row) || frames.component(row) !== component) continue;
      const [x, y, z, w] = frames.pose.subarray(7 * row + 3, 7 * row + 7);
      this.group.quaternion.set(1, 0, 0, 0).multiply(new Quaternion(x, y, z, w).normalize().invert());
      this.group.updateMatrixWorld(true);
      return true;
    }
    return false;
  }

  /** New landmarks are added some times a second, more seldom where there are many. */
  private showLandmarks(): void {
    const { landmarks, moves } = this.run;
    const { shownLandmarks: shown } = this;
    const { upright } = this.seen;
    const now = performance.now();
    if (shown.count === landmarks.count && shown.moves === moves && shown.upright === upright) return;
    if (now - shown.at < Math.max(LANDMARKS_MS, landmarks.count / 100)) return;
    this.shownLandmarks = { count: landmarks.count, moves, upright, at: now };
    this.points.show(landmarks, this.group.quaternion);
  }

  private isShown(row: number): boolean {
    const { frames } = this.run;
    return (
      frames.isPosed(row) &&
      frames.component(row) === this.seen.component &&
      Number.isFinite(this.motion.shown[3 * row])
    );
  }

  private newestRow(): number {
    for (let row = this.motion.count - 1; row >= 0; row--) if (this.isShown(row)) return row;
    return -1;
  }

  private addLoops(): void {
    const { frames, loops } = this.run;
    const accepted = new SegmentList();
    const refused = new SegmentList();
    const fresh = new SegmentList();
    let old = this.run.refused - REFUSED_SHOWN;
    for (const [key, loop] of loops) {
      if (!loop.accepted && old-- > 0) continue;
      const a = frames.row(loop.query);
      const b = frames.row(loop.match);
      if (a < 0 || b < 0 || !this.isShown(a) || !this.isShown(b)) continue;
      const isNew = key === this.newest.key && performance.now() - this.newest.since < NEW_MS;
      const list = !loop.accepted ? refused : isNew ? fresh : accepted;
      list.add(this.motion.shown, 3 * a, this.motion.shown, 3 * b, loop.accepted ? stageColour("accepted") : REFUSED);
    }
    this.extras.add(thinLines(refused, 0.45), wideLines(accepted, 2.5, 4), wideLines(fresh, 7, 6));
  }

  private addCamera(size: number): void {
    const row = this.newestRow();
    if (row < 0) return;
    const list = new SegmentList();
    const shape = { halfWidth: 0.6, halfHeight: 0.6 / this.aspect(), x: 0, y: 0 };
    const pose = poseMatrix(this.run.frames.pose, row, new Matrix4());
    addFrustum(list, pose.setPosition(new Vector3().fromArray(this.motion.shown, 3 * row)), shape, size, CURSOR);
    this.extras.add(wideLines(list, 2.5, 9));
  }
}
