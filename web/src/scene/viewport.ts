import {
  ColorManagement,
  LinearSRGBColorSpace,
  PerspectiveCamera,
  Scene,
  type Sphere,
  type Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Quality, type QualityLevel, isSoftware } from "./quality";

const STILL_AFTER_MS = 200;

/**
 * The canvas, the camera and its controls. Pictures are drawn on demand only: `request` draws one
 * in the next animation frame. While the camera or the cursor moves, less is drawn if the graphics
 * are slow; when they are still, all is.
 */
export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(50, 1, 0.1, 1000);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  /** Called when a movement begins, slows down or ends; null: draw everything. */
  onQuality: (level: QualityLevel | null) => void = () => undefined;
  /** Called before a picture is drawn. */
  beforeDraw: () => void = () => undefined;
  private readonly renderer: WebGLRenderer;
  private readonly quality: Quality;
  private readonly observer: ResizeObserver;
  private disposed = false;
  private inset = 0;
  private moving = false;
  private held = false;
  private watching = false;
  private drawn = 0;
  private pending = false;
  private stillTimer = 0;
  /** What the camera was fitted to, until the user moves it. */
  private fitted: { sphere: Sphere; direction: Vector3 } | null = null;

  constructor(private readonly parent: HTMLElement) {
    // Materials are unlit: colours pass from the tables to the screen unchanged.
    ColorManagement.enabled = false;
    const software = graphics() === "software";
    this.quality = new Quality(software);
    this.renderer = new WebGLRenderer({ antialias: !software });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    // To ask for errors makes the page wait until each shader is compiled.
    this.renderer.debug.checkShaderErrors = false;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The map in three dimensions");
    parent.append(this.canvas);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.move());
    this.controls.addEventListener("start", () => {
      this.fitted = null;
      this.hold(true);
    });
    this.controls.addEventListener("end", () => this.hold(false));
    this.observer = new ResizeObserver(() => this.resize());
    this.observer.observe(parent);
    this.resize();
  }

  /** Frees the graphics; nothing is drawn any more. */
  dispose(): void {
    window.clearTimeout(this.stillTimer);
    this.disposed = true;
    this.observer.disconnect();
    this.controls.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
    this.canvas.remove();
  }

  get level(): QualityLevel | null {
    return this.moving ? this.quality.level : null;
  }

  request(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  /** Draws a picture of a movement: less until nothing has moved for a while. */
  move(): void {
    if (!this.moving) {
      this.moving = true;
      this.applyQuality();
      this.quality.begin();
      if (!this.watching) requestAnimationFrame((now) => this.watchSpeed(now));
      this.watching = true;
    }
    window.clearTimeout(this.stillTimer);
    if (this.held) return void this.request();
    this.stillTimer = window.setTimeout(() => {
      this.moving = false;
      this.applyQuality();
      this.request();
    }, STILL_AFTER_MS);
    this.request();
  }

  /** While the user holds the camera or the cursor, a pause is no end of the movement. */
  hold(held: boolean): void {
    this.held = held;
    if (this.moving) this.move();
  }

  /** Pixels at the left that something covers: the view is centred in the rest. */
  setInset(pixels: number): void {
    if (pixels === this.inset) return;
    this.inset = pixels;
    this.resize();
  }

  setBackground(css: string): void {
    this.renderer.setClearColor(css, 1);
    this.request();
  }

  /** Looks at a sphere from `direction` (y is up), so that all of it is seen. */
  fit(sphere: Sphere, direction: Vector3): void {
    const radius = Math.max(sphere.radius, 1e-3);
    const free = Math.max(this.parent.clientWidth - this.inset, 1) / Math.max(this.parent.clientHeight, 1);
    const half = Math.min(this.camera.fov, this.camera.fov * free) / 2;
    const distance = radius / Math.sin((half * Math.PI) / 180);
    this.camera.near = radius / 500;
    this.camera.far = radius * 60;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction.clone().normalize(), distance);
    this.fitted = { sphere, direction };
    this.controls.update();
    this.move();
  }

  /** Moves the camera and its target by the same amount. */
  shift(by: Vector3): void {
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.fitted = null;
    this.controls.update();
    this.move();
  }

  lookFrom(position: Vector3, target: Vector3): void {
    this.fitted = null;
    this.camera.position.copy(position);
    this.controls.target.copy(target);
    this.controls.update();
    this.move();
  }

  /** Draws all now and returns the canvas, whose content is valid until this task ends. */
  drawNow(): HTMLCanvasElement {
    window.clearTimeout(this.stillTimer);
    this.moving = false;
    this.applyQuality();
    this.draw();
    return this.canvas;
  }

  /** Follows the animation frames while something moves, whether or not they draw. */
  private watchSpeed(now: number): void {
    this.watching = this.moving && !this.disposed;
    if (!this.watching) return;
    if (this.quality.note(now)) this.applyQuality();
    requestAnimationFrame((next) => this.watchSpeed(next));
  }

  private draw(): void {
    if (this.disposed) return;
    this.beforeDraw();
    this.renderer.render(this.scene, this.camera);
    if (this.drawn++ === 0) performance.mark("first-picture");
  }

  private applyQuality(): void {
    this.setRatio();
    this.onQuality(this.level);
  }

  /** Every change of the size waits for the graphics: none is made without need. */
  private setRatio(): void {
    const ratio = pixelRatio() * (this.level?.resolution ?? 1);
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
  }

  private resize(): void {
    const width = Math.max(this.parent.clientWidth, 1);
    const height = Math.max(this.parent.clientHeight, 1);
    this.setRatio();
    this.renderer.setSize(width, height, false);
    this.camera.setViewOffset(width, height, -this.inset / 2, 0, width, height);
    if (this.fitted) this.fit(this.fitted.sphere, this.fitted.direction);
    this.request();
  }
}

/** Pixels drawn for each pixel of the page. */
export function pixelRatio(): number {
  return Math.min(window.devicePixelRatio, 2);
}

type Graphics = "hardware" | "software" | "none";
let known: Graphics | null = null;

/** What draws WebGL 2 in this browser, if anything does. */
export function graphics(): Graphics {
  known ??= findGraphics();
  return known;
}

function findGraphics(): Graphics {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (gl === null) return "none";
  const software = isSoftware(gl);
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return software ? "software" : "hardware";
}
