/** How much is drawn while the camera or the cursor moves; all is drawn when they are still. */

export interface QualityLevel {
  /** Share of the resolution. */
  resolution: number;
  /** The most landmarks. */
  points: number;
  /** Whether keyframes and planes are drawn. */
  details: boolean;
}

const LEVELS: QualityLevel[] = [
  { resolution: 1, points: Infinity, details: true },
  { resolution: 0.8, points: 60000, details: true },
  { resolution: 0.6, points: 20000, details: true },
  { resolution: 0.5, points: 8000, details: false },
  { resolution: 0.35, points: 3000, details: false },
];

const SLOW_MS = 50;
const FAST_MS = 20;
const FAST_PICTURES = 20;
/** Longer gaps are pauses of the user. */
const PAUSE_MS = 2000;

/** Follows the time between pictures: slow graphics get less to draw. */
export class Quality {
  private index: number;
  private last = 0;
  private fast = 0;

  constructor(software: boolean) {
    this.index = software ? 3 : 0;
  }

  get level(): QualityLevel {
    return LEVELS[this.index];
  }

  /** Notes a picture drawn at `now` during a movement; returns whether the level has changed. */
  note(now: number): boolean {
    const gap = now - this.last;
    this.last = now;
    if (gap > PAUSE_MS) return false;
    this.fast = gap < FAST_MS ? this.fast + 1 : 0;
    if (gap > SLOW_MS && this.index + 1 < LEVELS.length) return this.change(1);
    if (this.fast >= FAST_PICTURES && this.index > 0) return this.change(-1);
    return false;
  }

  private change(by: number): boolean {
    this.index += by;
    this.fast = 0;
    return true;
  }
}

/** Whether the graphics are drawn by the processor. */
export function isSoftware(gl: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  const name = info ? String(gl.getParameter(info.UNMASKED_RENDERER_WEBGL)) : "";
  return /swiftshader|llvmpipe|software|basic render/i.test(name);
}
