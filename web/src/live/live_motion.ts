/** Positions that are shown: after a change of the map they move smoothly to the new ones. */
import type { FrameLog } from "./frame_log";

const DURATION_MS = 700;

export class LiveMotion {
  /** Three values a row. */
  shown = new Float32Array(3 * 256);
  count = 0;
  private from: Float32Array | null = null;
  private begin = 0;

  get moving(): boolean {
    return this.from !== null;
  }

  /** Forgets all rows. */
  clear(): void {
    this.count = 0;
    this.from = null;
  }

  /** The poses have changed: those that are shown move to them from now on, if any is elsewhere. */
  start(frames: FrameLog, now: number): void {
    const { pose } = frames;
    let apart = false;
    for (let row = 0; row < this.count && !apart; row++) {
      for (let k = 0; k < 3; k++) apart ||= differs(this.shown[3 * row + k], pose[7 * row + k]);
    }
    if (!apart) return;
    this.from = this.shown.slice(0, 3 * this.count);
    this.begin = now;
  }

  /** Brings the positions to time `now`; returns the first row that has changed. */
  step(frames: FrameLog, now: number): number {
    if (3 * frames.count > this.shown.length) this.grow(frames.count);
    const { pose } = frames;
    const from = this.from;
    // A snapshot may have told of a frame, without a pose, before its event does.
    const changed = frames.takeChanged();
    const first = from === null ? Math.min(this.count, frames.count, changed) : 0;
    const share = from === null ? 1 : ease((now - this.begin) / DURATION_MS);
    for (let row = first; row < frames.count; row++) {
      for (let k = 0; k < 3; k++) {
        const to = pose[7 * row + k];
        const old = from?.[3 * row + k] ?? NaN;
        this.shown[3 * row + k] = Number.isFinite(old) ? old + (to - old) * share : to;
      }
    }
    this.count = frames.count;
    if (share >= 1) this.from = null;
    return first;
  }

  private grow(count: number): void {
    const larger = new Float32Array(Math.max(3 * count, 2 * this.shown.length));
    larger.set(this.shown);
    this.shown = larger;
  }
}

function differs(a: number, b: number): boolean {
  return Number.isNaN(a) !== Number.isNaN(b) || Math.abs(a - b) > 1e-6 * Math.max(1, Math.abs(b));
}

/** From 0 to 1 with a slow begin and end. */
export function ease(share: number): number {
  const t = Math.min(Math.max(share, 0), 1);
  return t * t * (3 - 2 * t);
}
