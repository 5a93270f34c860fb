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
const FAST_FRAMES = 20;

/** Follows the time between animation frames of a movement: slow graphics get less to draw. */
export class Quality {
  private index: number;
  private last = NaN;
  private fast = 0;

  constructor(software: boolean) {
    this.index = software ? 3 : 0;
  }

  get level(): QualityLevel {
    return LEVELS[this.index];
  }

  /** A movement begins. */
  begin(): void {
    this.last = NaN;
  }

  /** Notes an animation frame at `now`; returns whether the level has changed. */
  note(now: number): boolean {
    const gap = now - this.last;
    this.last = now;
    this.fast = gap < FAST_MS ? this.fast + 1 : 0;
    if (gap > SLOW_MS && this.index + 1 < LEVELS.length) return this.change(1);
    if (this.fast >= FAST_FRAMES && this.index > 0) return this.change(-1);
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
