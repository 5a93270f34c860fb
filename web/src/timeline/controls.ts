/** The row above the time line: playback, choice of the graph, readout of the cursor. */
import type { ReportData } from "../data/model";
import { type SeriesName, availableSeries, series } from "../data/series";
import { moveCursor } from "../page/actions";
import { button, el, select } from "../page/dom";
import type { Store } from "../page/state";
import type { Timeline } from "./timeline";

export function timelineControls(report: ReportData, store: Store, timeline: Timeline): HTMLElement {
  const play = button("▶", "Play or pause (space)", () => store.set({ playing: !store.state.playing }));
  const readout = el("output", { class: "readout" });
  const rates = ["1", "2", "4", "10", "30"].map((value) => ({ value, text: `${value}×` }));
  const rate = select("Speed of playback", rates, String(store.state.rate), (value) =>
    store.set({ rate: Number(value) }),
  );
  const axis = select(
    "Horizontal axis",
    [
      { value: "frame", text: "by frame" },
      { value: "time", text: "by time" },
    ],
    store.state.axis,
    (value) => store.set({ axis: value === "time" ? "time" : "frame", range: null }),
  );
  const graphs = el("span");
  const showGraphs = (): void => {
    const run = report.runs[store.state.run];
    const choices = availableSeries(run).map((name) => {
      const { title, unit } = series(run, name);
      return { value: name, text: unit === "" ? title : `${title} [${unit}]` };
    });
    graphs.replaceChildren(
      select("Graph", choices, store.state.series, (value) => store.set({ series: value as SeriesName })),
    );
  };
  const showPlaying = (): void => {
    play.textContent = store.state.playing ? "❚❚" : "▶";
    play.setAttribute("aria-label", store.state.playing ? "Pause" : "Play");
  };
  const showCursor = (): void => {
    readout.textContent = readout.title = timeline.cursorText();
  };
  store.on(["playing"], showPlaying);
  store.on(["run"], showGraphs);
  store.on(["run", "row", "series"], showCursor);
  showGraphs();
  showPlaying();
  showCursor();
  return el(
    "div",
    { class: "controls" },
    button("‹", "One frame back (left arrow)", () => moveCursor(report, store, -1)),
    play,
    button("›", "One frame on (right arrow)", () => moveCursor(report, store, 1)),
    rate,
    graphs,
    axis,
    button("PNG", "Save the graph as PNG", () => timeline.savePng()),
    button("SVG", "Save the graph as SVG", () => timeline.saveSvg()),
    readout,
  );
}
