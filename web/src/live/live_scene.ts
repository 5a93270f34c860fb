import { Box3, Group, Matrix4, type Object3D, Quaternion, Sphere, Vector3 } from "three";
import { type Rgb, categoryColour } from "../data/colour_scale";
import { el } from "../page/dom";
import type { Theme } from "../page/state";
import { CURSOR } from "../scene/cursor_layer";
import { addFrustum } from "../scene/frusta_layer";
import { ground } from "../scene/grid_layer";
import { legendElement } from "../scene/legend";
import { SegmentList, dispose, thinLines, wideLines } from "../scene/lines";
import { stageColour } from "../scene/loops_layer";
import { poseMatrix } from "../scene/map_frame";
import { Viewport, graphics } from "../scene/viewport";
import { LivePath } from "./live_path";
import { LiveMotion } from "./live_motion";
import { LivePoints } from "./live_points";
import type { LiveRun } from "./live_run";

export type LiveFollow = "all" | "along" | "off";

const OBLIQUE = new Vector3(-0.35, 0.9, 0.75);
const ABOVE = new Vector3(0, 1, 0.0005);
/** Of the refused loops the newest are drawn: all of them would hide the map. */
const REFUSED_SHOWN = 20;
const REFUSED: Rgb = [150, 130, 130];
const TRAJECTORY = categoryColour(0);
/** A new loop is drawn wider for this time. */
const NEW_MS = 2500;
const SOFTWARE_PACE_MS = 200;
const LANDMARKS_MS = 400;

/** The map of a run that goes on. */
export class LiveScene {
  readonly element = el("section", { class: "scene", "aria-label": "Scene" });
  readonly viewport: Viewport;
  onFollow: (follow: LiveFollow) => void = () => undefined;
  private mode: LiveFollow = "all";
  private readonly group = new Group();
  private readonly motion = new LiveMotion();
  private readonly path = new LivePath(TRAJECTORY);
  private readonly points: LivePoints;
  private extras: Group = new Group();
  private grid: Object3D = new Group();
  private fitted = new Sphere(new Vector3(), -1);
  private direction = OBLIQUE;
  private readonly followed = new Vector3();
  private seen = { moves: -1, resets: 0, shifts: 0, component: -1, upright: false };
  private newest = { key: "", since: -Infinity };
  private shownLandmarks = { count: 0, moves: -1, upright: false, at: -Infinity };
  private pending = false;
  private timer = 0;

  constructor(
    page: HTMLElement,
    private readonly run: LiveRun,
    private theme: Theme,
    /** Width over height of the images. */
    private readonly aspect: () => number,
  ) {
    page.append(this.element);
    this.viewport = new Viewport(this.element);
    this.points = new LivePoints(this.viewport);
    this.group.add(this.path.object, this.points.object, this.extras);
    this.viewport.scene.add(this.group, this.grid);
    this.viewport.onQuality = (level) => this.points.setQuality(level);
    this.viewport.controls.addEventListener("start", () => {
      if (this.mode === "all") this.setFollow("off");
    });
    this.element.append(this.legend());
    this.setTheme(theme);
    this.viewport.fit(new Sphere(new Vector3(), 1), OBLIQUE);
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    this.viewport.setBackground(theme === "dark" ? "#0d1117" : "#ffffff");
    this.drawGrid();
  }

  get follow(): LiveFollow {
    return this.mode;
  }

  setFollow(follow: LiveFollow): void {
    this.mode = follow;
    this.onFollow(follow);
    if (follow === "all") this.fit(this.direction);
    if (follow === "along") this.followed.copy(this.viewport.controls.target);
    this.draw();
  }

  fit(direction = OBLIQUE): void {
    this.direction = direction;
    this.fitted.radius = -1;
    this.mode = "all";
    this.onFollow("all");
    this.draw();
  }

  top(): void {
    this.fit(ABOVE);
  }

  /** Shows what the run has now. */
  update(): void {
    const { run, seen } = this;
    if (run.resets !== seen.resets || run.frames.shifts !== seen.shifts || run.component !== seen.component) {
      this.motion.clear();
      seen.upright = false;
    } else if (run.moves !== seen.moves) {
      this.motion.start(run.frames, performance.now());
    }
    Object.assign(seen, {
      moves: run.moves,
      resets: run.resets,
      shifts: run.frames.shifts,
      component: run.component,
    });
    if (!seen.upright) this.stand();
    this.showLandmarks();
    this.draw();
  }

  /** New landmarks are added some times a second. */
  private showLandmarks(): void {
    const { run, shownLandmarks: shown } = this;
    const now = performance.now();
    const same =
      shown.count === run.landmarks.count && shown.moves === run.moves && shown.upright === this.seen.upright;
    if (same || now - shown.at < LANDMARKS_MS) return;
    this.shownLandmarks = { count: run.landmarks.count, moves: run.moves, upright: this.seen.upright, at: now };
    this.points.show(run.landmarks, this.group.quaternion);
  }

  dispose(): void {
    this.pending = true; // nothing is drawn any more
    this.viewport.dispose();
  }

  /** The y axis of the scene points against y of the first camera, which points down. */
  private stand(): void {
    const { frames } = this.run;
    for (let row = 0; row < frames.count; row++) {
      if (!this.isShown(row)) continue;
      const [x, y, z, w] = frames.pose.subarray(7 * row + 3, 7 * row + 7);
      this.group.quaternion.set(1, 0, 0, 0).multiply(new Quaternion(x, y, z, w).normalize().invert());
      this.group.updateMatrixWorld(true);
      this.seen.upright = true;
      return;
    }
  }

  private isShown(row: number): boolean {
    const { frames } = this.run;
    return frames.isPosed(row) && frames.component(row) === this.seen.component;
  }

  private draw(): void {
    const { frames } = this.run;
    const first = this.motion.step(frames, performance.now());
    if (first < frames.count || frames.count === 0) {
      this.path.update(this.motion.shown, frames.count, first, (row) => this.isShown(row) && this.isShown(row + 1));
    }
    this.aim();
    this.drawExtras();
    if (this.motion.moving) this.viewport.move();
    else this.requestSoon();
    const unfinished = this.motion.moving || performance.now() - this.newest.since < NEW_MS;
    if (!unfinished || this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  /** New frames are drawn in full; graphics in software get some time for each picture. */
  private requestSoon(): void {
    if (this.timer !== 0) return;
    const wait = graphics() === "software" ? SOFTWARE_PACE_MS : 0;
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      this.viewport.request();
    }, wait);
  }

  /** Loops and the current camera. */
  private drawExtras(): void {
    dispose(this.extras);
    this.extras = new Group();
    this.group.add(this.extras);
    const accepted = new SegmentList();
    const refused = new SegmentList();
    const fresh = new SegmentList();
    let old = this.run.refused - REFUSED_SHOWN;
    for (const [key, loop] of this.run.loops) {
      if (!loop.accepted && old-- > 0) continue;
      const a = this.run.frames.row(loop.query);
      const b = this.run.frames.row(loop.match);
      if (a < 0 || b < 0 || !this.isShown(a) || !this.isShown(b)) continue;
      const isNew = key === this.newest.key && performance.now() - this.newest.since < NEW_MS;
      const list = !loop.accepted ? refused : isNew ? fresh : accepted;
      list.add(this.motion.shown, 3 * a, this.motion.shown, 3 * b, loop.accepted ? stageColour("accepted") : REFUSED);
    }
    this.extras.add(thinLines(refused, 0.45), wideLines(accepted, 2.5, 4), wideLines(fresh, 7, 6));
    const row = this.currentRow();
    if (row < 0) return;
    const camera = new SegmentList();
    const halfWidth = 0.6;
    const shape = { halfWidth, halfHeight: halfWidth / this.aspect(), x: 0, y: 0 };
    addFrustum(camera, this.matrixOf(row), shape, Math.max(this.fitted.radius, 1e-3) / 9, CURSOR);
    this.extras.add(wideLines(camera, 2.5, 9));
  }

  /** A loop has come: an accepted one is drawn wider for a while. */
  noteLoop(key: string): void {
    this.newest = { key, since: performance.now() };
  }

  private matrixOf(row: number): Matrix4 {
    const matrix = poseMatrix(this.run.frames.pose, row);
    return matrix.setPosition(new Vector3().fromArray(this.motion.shown, 3 * row));
  }

  /** Row of the newest frame with a pose. */
  private currentRow(): number {
    for (let row = this.motion.count - 1; row >= 0; row--) {
      if (this.isShown(row) && Number.isFinite(this.motion.shown[3 * row])) return row;
    }
    return -1;
  }

  /** Moves the view as the user has chosen. */
  private aim(): void {
    const row = this.currentRow();
    if (row < 0) return;
    if (this.mode === "along") {
      const position = new Vector3().fromArray(this.motion.shown, 3 * row).applyMatrix4(this.group.matrixWorld);
      this.viewport.shift(position.clone().sub(this.followed));
      this.followed.copy(position);
    }
    const sphere = this.sphere();
    const gap = sphere.center.distanceTo(this.fitted.center) + sphere.radius;
    if (gap <= this.fitted.radius && this.fitted.radius < 2 * sphere.radius) return;
    if (this.mode === "off" && this.fitted.radius > 0) return;
    // Some room to grow, so that the view does not change with each frame.
    this.fitted = new Sphere(sphere.center.clone(), 1.3 * sphere.radius);
    this.drawGrid();
    if (this.mode === "all") this.viewport.fit(this.fitted, this.direction);
  }

  private sphere(): Sphere {
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

  private drawGrid(): void {
    dispose(this.grid);
    const { center, radius } = this.fitted;
    this.grid =
      radius > 0 ? ground(radius, center.y - 0.15 * radius, center.x, center.z, this.theme === "dark") : new Group();
    this.viewport.scene.add(this.grid);
  }

  private legend(): HTMLElement {
    const entries = [
      { text: "trajectory", colour: TRAJECTORY },
      { text: "camera of the newest frame", colour: CURSOR },
      { text: "loop accepted", colour: stageColour("accepted") },
      { text: `loop refused, the last ${REFUSED_SHOWN}`, colour: REFUSED },
    ];
    return legendElement([{ kind: "category", title: "", entries }]);
  }
}
