/** The side panel of a live run: the image, the newest frame, the times, what has happened. */
import { formatCount, formatNumber, formatPercent } from "../data/format";
import { el, facts } from "../page/dom";
import type { FrameEvent, News } from "./events";
import { LiveImageView } from "./live_image";
import type { LiveRun } from "./live_run";
import { stageBars } from "./stage_bars";

const LINES_KEPT = 200;
/** Tables are drawn again at most this often. */
const PACE_MS = 250;

export class LivePanel {
  readonly image = new LiveImageView();
  readonly element: HTMLElement;
  private readonly state = el("p", { "aria-live": "polite" });
  private readonly frame = el("div");
  private readonly stages = el("div");
  private readonly log = el("ol", { class: "live-log" });
  private drawn = -Infinity;
  private timer = 0;
  private lastState = "";

  constructor(private readonly run: LiveRun) {
    this.element = el(
      "aside",
      { class: "panel", "aria-label": "Details" },
      el(
        "div",
        { class: "panel-body", tabindex: "0" },
        this.image.element,
        this.state,
        this.frame,
        el("h3", {}, "Processor time"),
        this.stages,
        el("h3", {}, "What happened"),
        this.log,
      ),
    );
    this.draw();
  }

  /** Notes an event for the list of what happened. */
  note(event: News): void {
    const text = sentenceOf(event, this.lastState);
    if (event.kind === "frame") this.lastState = event.frame.state;
    if (text === null) return;
    this.log.prepend(el("li", {}, text));
    while (this.log.childElementCount > LINES_KEPT) this.log.lastElementChild?.remove();
  }

  update(): void {
    if (this.timer !== 0) return;
    this.timer = window.setTimeout(
      () => {
        this.timer = 0;
        this.drawn = performance.now();
        this.draw();
      },
      Math.max(0, this.drawn + PACE_MS - performance.now()),
    );
  }

  close(): void {
    this.image.close();
    window.clearTimeout(this.timer);
  }

  private draw(): void {
    const { last } = this.run;
    const none = this.run.done > 0 ? "The next frame tells more." : "No frame has been processed yet.";
    this.state.textContent = last === null ? none : stateText(last);
    this.frame.replaceChildren(last === null ? "" : facts(factsOf(last, this.run)));
    this.stages.replaceChildren(stageBars(this.run.stages));
  }
}

/** What the tracking does, as a sentence. */
export function stateText(frame: FrameEvent): string {
  const because = frame.reason === "" ? "" : `: ${frame.reason}`;
  switch (frame.state) {
    case "tracking":
      return `Frame ${frame.frame} has a pose${frame.keyframe ? " and is a keyframe" : ""}.`;
    case "lost":
      return `Frame ${frame.frame} is lost${because}.`;
    case "initializing":
      return `Frame ${frame.frame}: the map begins${because}.`;
  }
}

function factsOf(frame: FrameEvent, run: LiveRun): [string, string][] {
  const rows: [string, string][] = [
    ["Inliers", formatNumber(frame.inliers)],
    ["Confidence", formatPercent(frame.confidence)],
    ["Component", frame.component < 0 ? "none" : String(frame.component)],
  ];
  if (frame.pose !== null)
    rows.push([
      "Position in the map",
      frame.pose
        .slice(0, 3)
        .map((p) => p.toFixed(3))
        .join(", "),
    ]);
  rows.push(
    ["Landmarks", formatCount(run.landmarks.count)],
    ["Loops accepted", formatCount(run.loops.size - run.refused)],
    ["Loops refused", formatCount(run.refused)],
  );
  return rows;
}

/** A line for the list of what happened; nothing for what happens all the time. */
export function sentenceOf(event: News, stateBefore: string): string | null {
  switch (event.kind) {
    case "frame":
      return event.frame.state !== stateBefore && (event.frame.state !== "tracking" || stateBefore === "lost")
        ? stateText(event.frame)
        : null;
    case "loop": {
      const { query, match, accepted, inliers } = event.loop;
      const found = Number.isFinite(inliers) ? `, ${formatNumber(inliers)} inliers` : "";
      return accepted ? `The loop of frames ${query} and ${match} is accepted${found}.` : null;
    }
    case "reset":
      return "The run has begun again.";
    case "control":
      return event.paused ? "The run is paused." : "The run goes on.";
    case "done":
      return "The run is done.";
    case "joined":
    case "moved":
    case "stages":
      return null;
  }
}
