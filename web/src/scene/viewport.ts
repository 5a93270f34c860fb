import { ColorManagement, LinearSRGBColorSpace, PerspectiveCamera, Scene, Sphere, Vector3, WebGLRenderer } from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const STILL_AFTER_MS = 160;

/**
 * The canvas, the camera and its controls. Pictures are drawn on demand only: `request` draws one
 * in the next animation frame. While the camera moves, `moving` is true and layers draw less.
 */
export class Viewport {
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(50, 1, 0.1, 1000);
  readonly controls: OrbitControls;
  readonly canvas: HTMLCanvasElement;
  moving = false;
  /** Called when the camera begins or ends to move. */
  onMoving: (moving: boolean) => void = () => undefined;
  /** Called before a picture is drawn. */
  beforeDraw: () => void = () => undefined;
  /** Number of pictures drawn so far. */
  drawn = 0;
  private readonly renderer: WebGLRenderer;
  private pending = false;
  private stillTimer = 0;

  constructor(private readonly parent: HTMLElement) {
    // Materials are unlit: colours pass from the tables to the screen unchanged.
    ColorManagement.enabled = false;
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: "high-performance" });
    this.renderer.outputColorSpace = LinearSRGBColorSpace;
    this.canvas = this.renderer.domElement;
    this.canvas.tabIndex = 0;
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "The map in three dimensions");
    parent.append(this.canvas);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.zoomToCursor = true;
    this.controls.addEventListener("change", () => this.cameraMoved());
    new ResizeObserver(() => this.resize()).observe(parent);
    this.resize();
  }

  request(): void {
    if (this.pending) return;
    this.pending = true;
    requestAnimationFrame(() => {
      this.pending = false;
      this.draw();
    });
  }

  setBackground(css: string): void {
    this.renderer.setClearColor(css, 1);
    this.request();
  }

  /** Looks at a sphere from `direction` (y is up), so that all of it is seen. */
  fit(sphere: Sphere, direction: Vector3): void {
    const radius = Math.max(sphere.radius, 1e-3);
    const half = Math.min(this.camera.fov, this.camera.fov * this.camera.aspect) / 2;
    const distance = radius / Math.sin((half * Math.PI) / 180);
    this.camera.near = radius / 500;
    this.camera.far = radius * 60;
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(sphere.center);
    this.camera.position.copy(sphere.center).addScaledVector(direction.clone().normalize(), distance);
    this.controls.update();
    this.cameraMoved();
  }

  /** Moves the camera and its target by the same amount. */
  shift(by: Vector3): void {
    this.camera.position.add(by);
    this.controls.target.add(by);
    this.controls.update();
    this.request();
  }

  /** Position in pixels of the canvas; nothing behind the camera. */
  project(point: Vector3): { x: number; y: number } | null {
    const p = point.clone().project(this.camera);
    if (p.z > 1 || p.z < -1) return null;
    return { x: ((p.x + 1) / 2) * this.parent.clientWidth, y: ((1 - p.y) / 2) * this.parent.clientHeight };
  }

  /** Draws now and returns the canvas, whose content is valid until this task ends. */
  drawNow(): HTMLCanvasElement {
    this.draw();
    return this.canvas;
  }

  private draw(): void {
    this.beforeDraw();
    this.renderer.render(this.scene, this.camera);
    this.drawn++;
  }

  private cameraMoved(): void {
    if (!this.moving) {
      this.moving = true;
      this.onMoving(true);
    }
    window.clearTimeout(this.stillTimer);
    this.stillTimer = window.setTimeout(() => {
      this.moving = false;
      this.onMoving(false);
      this.request();
    }, STILL_AFTER_MS);
    this.request();
  }

  private resize(): void {
    const width = Math.max(this.parent.clientWidth, 1);
    const height = Math.max(this.parent.clientHeight, 1);
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.request();
  }
}
