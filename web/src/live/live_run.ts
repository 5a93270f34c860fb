import type { FrameEvent, LiveEvent, LiveLoop, Snapshot, Stage } from "./events";
import { FrameLog } from "./frame_log";
import { LandmarkList } from "./landmark_list";

/** Refused loops that are kept; a long run has many, and they only show where was searched. */
const REFUSED_KEPT = 2000;

export type Phase = "running" | "done";

/**
 * What the page knows of a run that goes on: its newest snapshot and all events after it, in the order of their numbers.
 * After `moved` or a gap in the numbers it is stale until a snapshot that is new enough is taken.
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
  /** Number of the event that the run began again; 0 for the first time. */
  began = 0;
  /** Number of the newest event that is known. */
  private known = 0;
  /** The events after the newest snapshot. */
  private recent: LiveEvent[] = [];
  /** The least number that a snapshot must have. */
  private wanted = 0;
  private old = true;

  /** Whether a snapshot is needed. */
  get stale(): boolean {
    return this.old;
  }

  /** Takes the next event of the stream; one that is in the newest snapshot changes nothing. */
  apply(event: LiveEvent): void {
    // What lies between is missing, and in the next snapshot.
    const before = event.kind === "joined" ? event.number : event.number - 1;
    if (before > this.known) this.want(before);
    this.known = Math.max(this.known, before);
    if (event.number <= this.known) return;
    this.known = event.number;
    this.recent.push(event);
    if (event.kind === "moved") this.want(event.number);
    this.change(event);
  }

  /** Takes a snapshot; returns false if it is older than what is known but for the events after it. */
  take(snapshot: Snapshot): boolean {
    if (snapshot.number < this.wanted) return false;
    this.wanted = snapshot.number;
    this.known = Math.max(this.known, snapshot.number);
    this.recent = this.recent.filter(({ number }) => number > snapshot.number);
    this.old = false;
    this.show(snapshot);
    for (const event of this.recent) this.change(event);
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

  private want(number: number): void {
    this.wanted = Math.max(this.wanted, number);
    this.old = true;
  }

  /** What the snapshot says, and nothing else. */
  private show(snapshot: Snapshot): void {
    this.frames.load(snapshot.frames);
    this.landmarks.clear();
    this.landmarks.add(snapshot.landmarks);
    this.loops.clear();
    for (const loop of snapshot.loops) this.addLoop(loop);
    this.stages = snapshot.stages;
    this.last = snapshot.last;
    this.total = snapshot.total;
    this.done = snapshot.done;
    this.paused = snapshot.paused;
    this.phase = snapshot.finished ? "done" : "running";
    this.verdict = snapshot.verdict;
    this.began = snapshot.began;
    this.moves++;
  }

  private change(event: LiveEvent): void {
    switch (event.kind) {
      case "frame":
        return this.addFrame(event.frame);
      case "loop":
        return this.addLoop(event.loop);
      case "reset":
        return this.beginAgain(event.number);
      case "stages":
        this.stages = event.stages;
        return;
      case "control":
        this.paused = event.paused;
        return;
      case "done":
        this.phase = "done";
        this.verdict = event.verdict;
    }
  }

  private addFrame(frame: FrameEvent): void {
    this.frames.put(frame);
    if (frame.landmarks) this.landmarks.add(frame.landmarks);
    this.last = frame;
    this.total = frame.total;
    this.done = frame.index + 1;
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

  private beginAgain(number: number): void {
    this.frames.clear();
    this.loops.clear();
    this.landmarks.clear();
    this.last = null;
    this.done = 0;
    this.phase = "running";
    this.verdict = null;
    this.began = number;
    this.moves++;
  }
}
