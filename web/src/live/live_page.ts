/** The page of a run that goes on. */
import { formatCount } from "../data/format";
import { button, el } from "../page/dom";
import { LIVE_MOUSE, helpDialog } from "../page/help";
import { type KeyBinding, watchKeys } from "../page/keys";
import { splitter } from "../page/splitter";
import type { Theme } from "../page/state";
import { preferredTheme, showTheme } from "../page/theme";
import { graphics } from "../scene/viewport";
import { Connection } from "./connection";
import { postJson } from "./http";
import { LiveChart } from "./live_chart";
import { LivePanel } from "./live_panel";
import { LiveRun } from "./live_run";
import { type LiveFollow, LiveScene } from "./live_scene";
import type { LiveStart } from "./live_start";

/** The page is drawn again at most this often. */
const PACE_MS = 50;

type Control = "pause" | "resume" | "step";

const LINKS = {
  connecting: "connecting",
  live: "live",
  lost: "The connection is lost: the program has ended or is out of reach. It is tried again.",
};

export class LivePage {
  readonly run = new LiveRun();
  private readonly connection: Connection;
  private readonly panel = new LivePanel(this.run);
  private readonly chart = new LiveChart();
  private readonly scene: LiveScene | null;
  private readonly link = el("span", { class: "link", role: "status" });
  private readonly badge = el("span", { class: "verdict" });
  private readonly progress = el("progress", { "aria-label": "Progress", max: "1", value: "0" });
  private readonly count = el("span", { class: "count" });
  private readonly pause: HTMLButtonElement;
  private readonly step: HTMLButtonElement;
  private readonly fault = el("p", { class: "note fault", role: "alert" });
  private readonly endKeys: () => void;
  private theme: Theme = preferredTheme();
  private pending = false;
  private ended = false;
  private closed = false;

  constructor(
    private readonly page: HTMLElement,
    private readonly start: LiveStart,
    /** Called once, when the results are written. */
    private readonly onDone: () => void,
  ) {
    this.connection = new Connection(this.run, (event) => {
      if (event) this.panel.note(event);
      if (event?.kind === "loop" && event.loop.accepted)
        this.scene?.map.noteLoop(`${event.loop.query} ${event.loop.match}`);
      if (event?.kind === "frame" || event === null) this.panel.image.wake();
      if (!this.closed) this.updateSoon();
    });
    this.pause = button(
      "❚❚ Pause",
      "Pause or go on (space)",
      () => void this.control(this.run.paused ? "resume" : "pause"),
    );
    this.step = button("Step", "One frame, then pause (.)", () => void this.control("step"));
    const help = helpDialog(LIVE_MOUSE);
    page.className = "report live";
    page.append(this.header(help.toggle));
    this.scene = this.makeScene();
    this.fault.hidden = true;
    page.append(
      el("section", { class: "timeline", "aria-label": "Frames so far" }, this.fault, this.chart.element),
      this.panel.element,
      splitter(page),
      help.element,
    );
    const keys = this.keys(help.toggle);
    help.fill(keys);
    this.endKeys = watchKeys(keys);
    document.title = `${start.title} – ${start.program}`;
    showTheme(this.theme);
    this.connection.open();
    this.update();
  }

  /** Ends the page, but for the stream of events: the program serves images as long as somebody follows it. Returns the theme. */
  close(): Theme {
    this.closed = true;
    this.panel.close();
    this.scene?.dispose();
    this.endKeys();
    return this.theme;
  }

  /** A sentence above the chart, or none with "". */
  say(text: string): void {
    this.fault.hidden = text === "";
    this.fault.textContent = text;
  }

  private makeScene(): LiveScene | null {
    if (graphics() === "none") {
      const text = "This browser has no WebGL 2, so the scene is not shown. Everything else is.";
      this.page.append(el("section", { class: "scene message" }, el("p", { role: "alert" }, text)));
      return null;
    }
    const scene = new LiveScene(this.page, this.run, this.theme, () => this.panel.image.aspect);
    scene.element.append(followTools(scene));
    return scene;
  }

  private header(toggleHelp: () => void): HTMLElement {
    return el(
      "header",
      {},
      el("h1", {}, this.start.title),
      this.badge,
      this.progress,
      this.count,
      this.pause,
      this.step,
      this.link,
      el("span", { class: "gap" }),
      button("◐", "Dark or light (D)", () => this.toggleTheme()),
      button("?", "Keys and mouse (?)", toggleHelp),
    );
  }

  private toggleTheme(): void {
    this.theme = this.theme === "dark" ? "light" : "dark";
    showTheme(this.theme);
    this.scene?.setTheme(this.theme);
    this.updateSoon();
  }

  private keys(toggleHelp: () => void): KeyBinding[] {
    const { scene } = this;
    return [
      { keys: [" "], shown: "Space", text: "Pause or go on", run: () => this.pause.click() },
      { keys: ["."], shown: ".", text: "One frame, then pause", run: () => this.step.click() },
      { keys: ["f"], shown: "F", text: "Show all of the map", run: () => scene?.fit() },
      { keys: ["v"], shown: "V", text: "View from above", run: () => scene?.top() },
      { keys: ["h"], shown: "H", text: "Follow the camera", run: () => scene?.setFollow(other(scene.follow)) },
      { keys: ["d"], shown: "D", text: "Dark or light", run: () => this.toggleTheme() },
      { keys: ["?"], shown: "?", text: "This help", run: toggleHelp },
    ];
  }

  private async control(action: Control): Promise<void> {
    try {
      await postJson("control", { action });
      this.say("");
    } catch (error) {
      this.say(error instanceof Error ? error.message : "The run cannot be controlled.");
    }
    this.updateSoon();
  }

  private updateSoon(): void {
    if (this.run.phase === "done" && !this.ended) {
      this.ended = true;
      this.onDone();
    }
    if (this.pending) return;
    this.pending = true;
    window.setTimeout(() => {
      this.pending = false;
      this.update();
    }, PACE_MS);
  }

  private update(): void {
    const { run, connection } = this;
    this.badge.hidden = run.last === null;
    this.badge.textContent = run.last?.state ?? "";
    this.badge.className = `verdict ${run.last?.state === "lost" ? "failed" : run.last?.state === "tracking" ? "good" : "doubtful"}`;
    this.progress.value = run.total > 0 ? run.done / run.total : 0;
    this.count.textContent = run.total > 0 ? `${formatCount(run.done)} of ${formatCount(run.total)} frames` : "";
    this.pause.textContent = run.paused ? "▶ Go on" : "❚❚ Pause";
    this.pause.disabled = this.step.disabled = this.ended || connection.link !== "live";
    this.link.textContent = this.ended ? "done" : LINKS[connection.link];
    this.link.className = `link ${this.ended ? "" : connection.link}`;
    this.panel.update();
    this.chart.draw(run);
    this.scene?.update();
    if (connection.fault !== "") this.say(connection.fault);
  }
}

function other(follow: LiveFollow): LiveFollow {
  return follow === "along" ? "off" : "along";
}

function followTools(scene: LiveScene): HTMLElement {
  const all = button("Fit", "Show all of the map, and go on to do so (F)", () => scene.fit());
  const along = button("Follow", "Follow the camera (H)", () => scene.setFollow(other(scene.follow)));
  const show = (follow: LiveFollow): void => {
    all.setAttribute("aria-pressed", String(follow === "all"));
    along.setAttribute("aria-pressed", String(follow === "along"));
  };
  scene.onFollow = show;
  show(scene.follow);
  return el(
    "div",
    { class: "tools" },
    all,
    button("Top", "View from above (V)", () => scene.top()),
    along,
  );
}
