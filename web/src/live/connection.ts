import { type LiveEvent, decodeEvent, decodeSnapshot, EVENT_KINDS } from "./events";
import { getJson } from "./http";
import type { LiveRun } from "./live_run";

export type Link = "connecting" | "live" | "lost";

/** A snapshot is read after moves of the map, and this often; more seldom where reading takes long. */
const REFRESH_MS = 5000;
const READING_SHARE = 0.1;
const RETRY_MS = 2000;

/** Follows a run by its event stream and snapshots, over gaps of the connection, until it is done. */
export class Connection {
  link: Link = "connecting";
  /** What was wrong with the last message of the program, or "". */
  fault = "";
  private source: EventSource | null = null;
  private reading = false;
  private timer = 0;
  private framesRead = -1;
  private notBefore = -Infinity;
  private closed = false;

  constructor(
    private readonly run: LiveRun,
    /** Called after every event, and with null after every other change of the run or of the connection. */
    private readonly onChange: (event: LiveEvent | null) => void,
  ) {}

  open(): void {
    const source = new EventSource("events");
    this.source = source;
    for (const kind of EVENT_KINDS) {
      source.addEventListener(kind, (event) => this.receive(kind, event as MessageEvent<string>));
    }
    source.addEventListener("open", () => {
      this.link = "live";
      this.onChange(null);
    });
    source.addEventListener("error", () => {
      if (this.closed) return;
      if (this.run.phase === "done") return this.close();
      this.link = "lost";
      this.onChange(null);
      // The browser tries again by itself unless the answer was a refusal.
      if (source.readyState === EventSource.CLOSED) window.setTimeout(() => this.closed || this.open(), RETRY_MS);
    });
  }

  /** Also called when the program ends after the run: it does so when no page follows its events. */
  close(): void {
    this.closed = true;
    this.source?.close();
    window.clearTimeout(this.timer);
  }

  private receive(kind: (typeof EVENT_KINDS)[number], { data, lastEventId }: MessageEvent<string>): void {
    let event: LiveEvent | null = null;
    try {
      event = { ...decodeEvent(kind, JSON.parse(data)), number: Number(lastEventId) };
      this.run.apply(event);
    } catch (error) {
      this.fault = error instanceof Error ? error.message : "An event cannot be read.";
    }
    this.onChange(event);
    if (this.run.stale) void this.readState();
  }

  /** Reads snapshots, one at a time, until one is new enough. */
  private async readState(): Promise<void> {
    if (this.reading || this.closed || this.run.phase === "done") return;
    window.clearTimeout(this.timer);
    const begin = performance.now();
    if (begin < this.notBefore) {
      this.timer = window.setTimeout(() => void this.readState(), this.notBefore - begin);
      return;
    }
    this.reading = true;
    let wait = REFRESH_MS;
    try {
      const snapshot = decodeSnapshot(await getJson("live/state.json"));
      if (this.run.take(snapshot)) this.framesRead = this.run.frames.count;
      if (this.run.stale) wait = 100;
    } catch (error) {
      this.fault = error instanceof Error ? error.message : "The state of the run cannot be read.";
    }
    this.reading = false;
    if (this.closed) return;
    const now = performance.now();
    this.notBefore = now + Math.min((now - begin) / READING_SHARE, REFRESH_MS);
    this.onChange(null);
    this.timer = window.setTimeout(() => this.refresh(), wait);
  }

  private refresh(): void {
    const idle = !this.run.stale && this.run.frames.count === this.framesRead;
    if (!idle && this.link === "live") void this.readState();
    else this.timer = window.setTimeout(() => this.refresh(), REFRESH_MS);
  }
}
