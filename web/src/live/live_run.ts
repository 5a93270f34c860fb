import type { FrameEvent, LiveEvent, LiveLoop, Snapshot, Stage } from "./events";
import { FrameLog } from "./frame_log";
import { LandmarkList } from "./landmark_list";

/** Refused loops that are kept; a long run has many, and they only show where was searched. */
const REFUSED_KEPT = 2000;

export type Phase = "running" | "done";

/**
 * What the page knows of a run that goes on. Events add to it; after `moved`, `reset` or a gap in the
 * stream it is stale until a snapshot that is new enough is taken. In whatever order they come, an
 * event never undoes a newer one.
 */
export class LiveRun {
  readonly frames = new FrameLog();
  readonly loops = new Map<string, LiveLoop>();
  readonly landmarks = new LandmarkList();
  stages: Stage[] = [];
  last: FrameEvent | null = null;
  total = 0;
  done = 0;
  paused = false;
  phase: Phase = "running";
  verdict: string | null = null;
  /** Counts how often poses of earlier frames have changed. */
  moves = 0;
  /** Counts how often the run has begun again. */
  resets = 0;
  /** The least version that a snapshot must have. */
  private wanted = 0;
  private old = true;
  private pauseKnown = false;

  /** Whether a snapshot is needed. */
  get stale(): boolean {
    return this.old;
  }

  apply(event: LiveEvent): void {
    switch (event.kind) {
      case "frame":
        return this.addFrame(event.frame);
      case "loop":
        return this.addLoop(event.loop);
      case "moved":
        return this.want(event.version);
      case "reset":
        this.clear();
        return this.want(event.version);
      case "stages":
        this.stages = event.stages;
        return;
      case "control":
        return this.setPaused(event.paused);
      case "done":
        this.phase = "done";
        this.verdict = event.verdict;
    }
  }

  /** The stream had a gap: what it would have told is in the next snapshot. */
  markStale(): void {
    this.old = true;
    this.pauseKnown = false;
  }

  /** The program has said whether it is paused, which holds against a snapshot that may be older. */
  setPaused(paused: boolean): void {
    this.paused = paused;
    this.pauseKnown = true;
  }

  /** Takes a snapshot; returns false, and stays stale, if it is older than what the events have told of. */
  take(snapshot: Snapshot): boolean {
    if (snapshot.version < this.wanted) return false;
    this.wanted = snapshot.version;
    this.old = false;
    this.frames.merge(snapshot);
    this.landmarks.clear();
    this.landmarks.add(snapshot.landmarks);
    for (const loop of snapshot.loops) this.addLoop(loop);
    this.total = Math.max(this.total, snapshot.total);
    this.done = Math.max(this.done, snapshot.done);
    if (!this.pauseKnown) this.paused = snapshot.paused;
    if (snapshot.finished) this.phase = "done";
    this.moves++;
    return true;
  }

  /** The component of the newest frame with a pose; only its frames have one coordinate frame. */
  get component(): number {
    for (let row = this.frames.count - 1; row >= 0; row--)
      if (this.frames.isPosed(row)) return this.frames.component(row);
    return -1;
  }

  /** Number of refused loops that are kept. */
  get refused(): number {
    let count = 0;
    for (const { accepted } of this.loops.values()) if (!accepted) count++;
    return count;
  }

  private want(version: number): void {
    this.wanted = Math.max(this.wanted, version);
    this.old = true;
  }

  private addFrame(frame: FrameEvent): void {
    this.frames.put(frame);
    if (frame.landmarks) this.landmarks.add(frame.landmarks);
    this.last = frame;
    this.total = frame.total;
    this.done = Math.max(this.done, frame.index + 1);
  }

  private addLoop(loop: LiveLoop): void {
    const key = `${loop.query} ${loop.match}`;
    this.loops.delete(key); // so that the map is in the order of the last news
    this.loops.set(key, loop);
    if (this.loops.size <= REFUSED_KEPT) return;
    for (const [oldest, { accepted }] of this.loops) {
      if (accepted) continue;
      this.loops.delete(oldest);
      return;
    }
  }

  private clear(): void {
    this.frames.clear();
    this.loops.clear();
    this.landmarks.clear();
    this.last = null;
    this.done = 0;
    this.phase = "running";
    this.verdict = null;
    this.resets++;
    this.moves++;
  }
}
