import { Group, type Object3D, Sphere, Vector3 } from "three";
import { el } from "../page/dom";
import type { Theme } from "../page/state";
import { CURSOR } from "../scene/cursor_layer";
import { ground } from "../scene/grid_layer";
import { legendElement } from "../scene/legend";
import { dispose } from "../scene/lines";
import { stageColour } from "../scene/loops_layer";
import { Viewport, graphics } from "../scene/viewport";
import { LiveMap, REFUSED, REFUSED_SHOWN, TRAJECTORY } from "./live_map";
import type { LiveRun } from "./live_run";

/** The view keeps all of the map in sight, or the newest camera in its middle, or stays where it is. */
export type LiveFollow = "all" | "along" | "off";

const OBLIQUE = new Vector3(-0.35, 0.9, 0.75);
const ABOVE = new Vector3(0, 1, 0.0005);
const SOFTWARE_PACE_MS = 200;
const SLOW_MS = 60;

/** The three-dimensional view of a run that goes on. */
export class LiveScene {
  readonly element = el("section", { class: "scene", "aria-label": "Scene" });
  readonly viewport: Viewport;
  readonly map: LiveMap;
  onFollow: (follow: LiveFollow) => void = () => undefined;
  private mode: LiveFollow = "all";
  private grid: Object3D = new Group();
  private fitted = new Sphere(new Vector3(), -1);
  private direction = OBLIQUE;
  private readonly followed = new Vector3();
  private pending = false;
  private timer = 0;
  /** Time that the last picture took [ms]. */
  private cost = 0;

  constructor(
    page: HTMLElement,
    run: LiveRun,
    private theme: Theme,
    aspect: () => number,
  ) {
    page.append(this.element);
    this.viewport = new Viewport(this.element);
    this.map = new LiveMap(this.viewport, run, aspect);
    this.viewport.scene.add(this.map.group, this.grid);
    this.viewport.onQuality = (level) => this.map.points.setQuality(level);
    this.viewport.controls.addEventListener("start", () => {
      if (this.mode === "all") this.setFollow("off");
    });
    this.element.append(legend());
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
    if (follow === "along") this.followed.copy(this.viewport.controls.target);
    this.draw();
  }

  fit(direction = OBLIQUE): void {
    this.direction = direction;
    this.fitted.radius = -1;
    this.setFollow("all");
  }

  top(): void {
    this.fit(ABOVE);
  }

  /** Shows what the run has now. */
  update(): void {
    this.map.update();
    this.draw();
  }

  dispose(): void {
    this.pending = true; // nothing is drawn any more
    window.clearTimeout(this.timer);
    this.viewport.dispose();
  }

  private draw(): void {
    this.map.draw(Math.max(this.fitted.radius, 1e-3) / 9);
    if (this.aim()) this.map.draw(this.fitted.radius / 9);
    if (this.map.moving) this.viewport.move();
    else this.requestSoon();
    if (!this.map.changing || this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  /** New frames are drawn in full; slow graphics rest between two pictures, so that the page stays alive. */
  private requestSoon(): void {
    if (this.timer !== 0) return;
    const wait = Math.max(graphics() === "software" ? SOFTWARE_PACE_MS : 0, this.cost > SLOW_MS ? 2 * this.cost : 0);
    this.timer = window.setTimeout(() => {
      this.timer = 0;
      this.viewport.request();
      const begin = performance.now();
      requestAnimationFrame(() => requestAnimationFrame(() => (this.cost = performance.now() - begin)));
    }, wait);
  }

  /** Moves the view as the user has chosen; returns whether the size of the map is another than before. */
  private aim(): boolean {
    const position = this.map.newestPosition();
    if (position === null) return false;
    if (this.mode === "along") {
      this.viewport.shift(position.clone().sub(this.followed));
      this.followed.copy(position);
    }
    const sphere = this.map.sphere();
    const gap = sphere.center.distanceTo(this.fitted.center) + sphere.radius;
    if (gap <= this.fitted.radius && this.fitted.radius < 2 * sphere.radius) return false;
    // Some room to grow, so that the view does not change with each frame.
    this.fitted = new Sphere(sphere.center.clone(), 1.3 * sphere.radius);
    this.drawGrid();
    if (this.mode === "all") this.viewport.fit(this.fitted, this.direction);
    return true;
  }

  private drawGrid(): void {
    dispose(this.grid);
    const { center, radius } = this.fitted;
    const dark = this.theme === "dark";
    this.grid = radius > 0 ? ground(radius, center.y - 0.15 * radius, center.x, center.z, dark) : new Group();
    this.viewport.scene.add(this.grid);
  }
}

function legend(): HTMLElement {
  const entries = [
    { text: "trajectory", colour: TRAJECTORY },
    { text: "camera of the newest frame", colour: CURSOR },
    { text: "loop accepted", colour: stageColour("accepted") },
    { text: `loop refused, the last ${REFUSED_SHOWN}`, colour: REFUSED },
  ];
  return legendElement([{ kind: "category", title: "", entries }]);
}
