/** All layers of the chosen run, built when first seen and rebuilt when what they show changes. */
import { Group, type Object3D, type Sphere, Vector3 } from "three";
import { apply } from "../data/align";
import { compareRuns, comparable, mainComponent } from "../data/compare";
import { type Rgb, robustRange } from "../data/colour_scale";
import { isGood } from "../data/loops";
import type { ReportData, RunData } from "../data/model";
import { keyframeSpacing } from "../data/run_view";
import { positionAt } from "../data/quaternion";
import type { LayerName, State } from "../page/state";
import { type LegendItem, frameColouring, runColour } from "./colouring";
import { CURSOR, CursorLayer } from "./cursor_layer";
import { frustaLines } from "./frusta_layer";
import { cellSize, ground } from "./grid_layer";
import { ImagesLayer } from "./images_layer";
import { LandmarkLayer, sceneHeights } from "./landmark_layer";
import { dispose } from "./lines";
import { loopLines, loopRows, stageColour } from "./loops_layer";
import { mapGroup, poseMatrix, trajectorySphere } from "./map_frame";
import { constraintColour, constraintLines, placePoints } from "./places_layer";
import { planeShapes } from "./planes_layer";
import { streetMesh } from "./street_layer";
import { plainTrajectory, trajectoryLines, truthLines } from "./trajectory_layer";
import type { QualityLevel } from "./quality";
import { type Viewport, pixelRatio } from "./viewport";

const ONLINE: Rgb = [170, 150, 255];
const BEFORE: Rgb = [150, 150, 150];

export class RunScene {
  readonly group: Group;
  readonly root = new Group();
  readonly sphere: Sphere;
  readonly cursor = new CursorLayer();
  private readonly run: RunData;
  private readonly built = new Map<LayerName, Object3D>();
  private landmarks: LandmarkLayer | null = null;
  private images: ImagesLayer | null = null;
  private pointLegend: LegendItem | null = null;
  private cursorIsOld = true;
  private readonly spacing: number;
  private readonly groundHeight: number;

  constructor(
    private readonly report: ReportData,
    private state: Readonly<State>,
    private readonly viewport: Viewport,
  ) {
    this.run = report.runs[state.run];
    this.group = mapGroup(this.run, state.component);
    this.sphere = trajectorySphere(this.run, state.component, this.group);
    this.spacing = keyframeSpacing(this.run, state.component) || this.sphere.radius / 40;
    this.groundHeight = this.findGround();
    this.root.add(this.group);
    this.group.add(this.cursor.object);
    viewport.scene.add(this.root);
    this.update(state);
  }

  /** Size of the frusta: about the distance between keyframes, but to be seen from afar. */
  get frustumSize(): number {
    const size = Math.min(Math.max(this.spacing * 0.7, this.sphere.radius / 120), this.sphere.radius / 12);
    return size * this.state.frustumSize;
  }

  /** Shows what `state` asks for; layers in `changed` are built again. */
  update(state: Readonly<State>, changed: LayerName[] = []): void {
    this.state = state;
    for (const name of changed) this.drop(name);
    for (const [name, visible] of Object.entries(state.layers) as [LayerName, boolean][]) {
      if (visible && !this.built.has(name)) this.add(name);
      const object = this.built.get(name);
      if (object) object.visible = visible;
    }
    this.setQuality(this.viewport.level);
    this.showCursor(state);
  }

  showCursor(state: Readonly<State>): void {
    this.state = state;
    this.cursorIsOld = true;
    this.viewport.request();
  }

  /** The cursor may move several times between two pictures: it is drawn once. */
  beforeDraw(): void {
    if (!this.cursorIsOld) return;
    this.cursorIsOld = false;
    this.cursor.show(this.run, this.state, this.frustumSize);
  }

  /** Draws less while something moves, all with null. */
  setQuality(level: QualityLevel | null): void {
    this.landmarks?.setMost(level?.points ?? Infinity);
    this.landmarks?.setSize(this.state.pointSize, pixelRatio() * (level?.resolution ?? 1));
    for (const name of ["frusta", "images", "planes"] as const) {
      const object = this.built.get(name);
      if (object) object.visible = this.state.layers[name] && (level?.details ?? true);
    }
    if (level === null && this.state.layers.images) void this.images?.update(this.viewport.camera);
  }

  setPointSize(state: Readonly<State>): void {
    this.state = state;
    this.setQuality(this.viewport.level);
    this.viewport.request();
  }

  /** Position in the scene of a frame's optimized pose. */
  framePosition(row: number, target = new Vector3()): Vector3 {
    return target.fromArray(this.run.frames.pose, 7 * row).applyMatrix4(this.group.matrixWorld);
  }

  /** A point that the camera of a frame looks at, in the scene. */
  pointAhead(row: number): Vector3 {
    const distance = Math.max(10 * this.spacing, this.sphere.radius / 20);
    return new Vector3(0, 0, distance)
      .applyMatrix4(poseMatrix(this.run.frames.pose, row))
      .applyMatrix4(this.group.matrixWorld);
  }

  legend(): LegendItem[] {
    const { state, run } = this;
    const items: LegendItem[] = [];
    if (state.layers.trajectory) items.push(frameColouring(run, state.run, state.colourBy).legend);
    if (state.layers.landmarks && run.landmarks.count > 0 && this.pointLegend) items.push(this.pointLegend);
    items.push(...this.lineLegend());
    if (state.layers.street && run.streetMap)
      items.push({
        kind: "category",
        title: "Street map",
        entries: run.streetMap.classes.map(({ name, rgb }) => ({ text: name, colour: rgb })),
      });
    if (state.layers.grid) {
      const cell = `${cellSize(this.sphere.radius)} ${run.metric ? "m" : "map units"}`;
      items.push({ kind: "category", title: `Grid cells of ${cell}`, entries: [] });
    }
    return items;
  }

  dispose(): void {
    this.images?.dispose();
    dispose(this.root);
  }

  private lineLegend(): LegendItem[] {
    const { state, run, report } = this;
    const entries: { text: string; colour: Rgb }[] = [];
    const withLandmarks = state.layers.landmarks && run.landmarks.count > 0;
    entries.push({ text: `frame under the cursor${withLandmarks ? ", its landmarks" : ""}`, colour: CURSOR });
    if (state.layers.truth && run.frames.truth) entries.push({ text: "ground truth", colour: this.truthColour() });
    if (state.layers.online && run.frames.online) entries.push({ text: "online trajectory", colour: ONLINE });
    if (state.layers.before && run.before) entries.push({ text: "before the last edit", colour: BEFORE });
    if (state.layers.others) {
      report.runs.forEach((other, i) => {
        if (i !== state.run && comparable(run, other)) entries.push({ text: other.name, colour: runColour(i) });
      });
    }
    for (const stage of run.loops.stage.table) {
      if (!state.layers[isGood(stage) ? "loops" : "refused"]) continue;
      const text = run.loops.judged || isGood(stage) ? `loop ${stage}` : `loop refused: ${stage}`;
      entries.push({ text, colour: stageColour(stage) });
    }
    if (state.layers.constraints) {
      for (const source of run.constraints.source.table) {
        entries.push({ text: `constraint: ${source}`, colour: constraintColour(run, source) });
      }
    }
    return entries.length > 0 ? [{ kind: "category", title: "", entries }] : [];
  }

  private drop(name: LayerName): void {
    const object = this.built.get(name);
    if (!object) return;
    if (name === "images") this.images?.dispose();
    dispose(object);
    this.built.delete(name);
  }

  private add(name: LayerName): void {
    const object = this.build(name);
    if (object === null) return;
    this.built.set(name, object);
    (name === "grid" ? this.root : this.group).add(object);
  }

  private build(name: LayerName): Object3D | null {
    const { run, state } = this;
    const { component } = state;
    switch (name) {
      case "trajectory":
        return trajectoryLines(run, component, frameColouring(run, state.run, state.colourBy).colour);
      case "truth":
        return run.frames.truth ? truthLines(run.frames.truth, this.truthColour()) : null;
      case "online":
        return run.frames.online ? plainTrajectory(run, run.frames.online, component, ONLINE) : null;
      case "before":
        return run.before ? plainTrajectory(run, run.before, component, BEFORE, 0.7) : null;
      case "frusta":
        return frustaLines(run, component, this.frustumSize, state.theme === "dark" ? [150, 175, 200] : [90, 115, 140]);
      case "images":
        return this.buildImages();
      case "landmarks":
        return this.buildLandmarks();
      case "places":
        return placePoints(run, component);
      case "constraints":
        return constraintLines(run, component);
      case "loops":
      case "refused":
        return loopLines(run, component, loopRows(run, state.loopFilter, name === "loops"), name === "loops");
      case "planes":
        return planeShapes(run);
      case "street":
        return run.streetMap ? streetMesh(run.streetMap, () => this.viewport.request()) : null;
      case "others":
        return this.buildOthers();
      case "grid":
        return ground(
          this.sphere.radius,
          this.groundHeight,
          this.sphere.center.x,
          this.sphere.center.z,
          state.theme === "dark",
        );
    }
  }

  private buildImages(): Object3D {
    this.images = new ImagesLayer(this.run, this.state.component, this.frustumSize, this.group, () =>
      this.viewport.request(),
    );
    void this.images.update(this.viewport.camera);
    return this.images.object;
  }

  private buildLandmarks(): Object3D {
    this.landmarks = new LandmarkLayer(this.run, this.state.component, this.group);
    this.pointLegend = this.landmarks.setColour(this.state.pointColour);
    return this.landmarks.points;
  }

  private buildOthers(): Object3D {
    const others = new Group();
    this.report.runs.forEach((other, i) => {
      if (i === this.state.run) return;
      const comparison = compareRuns(this.run, other, this.state.alignOn);
      if (comparison === null) return;
      const poses = Float64Array.from(other.frames.pose);
      for (let row = 0; row < other.frames.count; row++)
        poses.set(apply(comparison.alignment, positionAt(poses, row)), 7 * row);
      // Only the main component is aligned: the others have frames of their own.
      others.add(plainTrajectory(other, poses, mainComponent(other), runColour(i)));
    });
    return others;
  }

  private truthColour(): Rgb {
    return this.state.theme === "dark" ? [235, 235, 235] : [20, 20, 20];
  }

  /** Height of the ground: that of the lowest landmarks, of the trajectory without any. */
  private findGround(): number {
    if (this.run.landmarks.count >= 100) {
      const [low] = robustRange(sceneHeights(this.run, this.group), 0.03, 0.97);
      if (Math.abs(low - this.sphere.center.y) < 2 * this.sphere.radius) return low;
    }
    let lowest = Infinity;
    for (let row = 0; row < this.run.frames.count; row++) {
      const { y } = this.framePosition(row);
      if (y < lowest) lowest = y;
    }
    return Number.isFinite(lowest) ? lowest : 0;
  }
}
