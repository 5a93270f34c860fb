import { type Comparison, compareRuns, defaultThreshold, firstParting, rms } from "../data/compare";
import { formatCount, formatDuration, formatNumber, formatTime, formatWithUnit } from "../data/format";
import type { ReportData, RunData } from "../data/model";
import { lengthUnit, travelled } from "../data/series";
import { button, el, facts, select, svgUri } from "../page/dom";
import type { Store } from "../page/state";
import { graphSvg } from "../save/graph_svg";
import { saveSvgAsPng, saveText } from "../save/save";
import { distanceGraph } from "./distance_graph";
import type { Panel, PanelContext } from "./panel";

export function comparePanel({ report, store }: PanelContext): Panel {
  return {
    title: "Compare",
    available: report.runs.length > 1,
    keys: ["run", "compareWith", "alignOn", "threshold", "theme"],
    render: () => {
      const { state } = store;
      const run = report.runs[state.run];
      const index =
        state.compareWith === state.run || !report.runs[state.compareWith]
          ? (state.run + 1) % report.runs.length
          : state.compareWith;
      const other = report.runs[index];
      const choices = report.runs
        .map((r, i) => ({ value: String(i), text: r.name }))
        .filter(({ value }) => value !== String(state.run));
      return el(
        "div",
        {},
        el("h2", {}, `${run.name} and ${other.name}`),
        el(
          "label",
          {},
          "Compare with ",
          select("Run to compare with", choices, String(index), (value) => store.set({ compareWith: Number(value) })),
        ),
        partingSection(run, other, store),
        el("h3", {}, "Figures side by side"),
        figuresTable(report),
      );
    },
  };
}

function partingSection(run: RunData, other: RunData, store: Store): HTMLElement {
  const { alignOn, threshold } = store.state;
  const comparison = compareRuns(run, other, alignOn);
  if (comparison === null) {
    return el(
      "p",
      {},
      "The two runs have fewer than three posed frames in common, so their trajectories cannot be compared.",
    );
  }
  const limit = threshold ?? defaultThreshold(travelled(run));
  const unit = lengthUnit(run);
  const id = firstParting(comparison, limit);
  const row = id === null ? -1 : (run.frames.rowOf.get(id) ?? -1);
  return el(
    "section",
    {},
    choices(store, limit, unit),
    el("p", {}, alignmentSentence(comparison, other, alignOn)),
    el(
      "p",
      { class: "parting", "data-frame": id === null ? "" : String(id) },
      partingSentence(run, comparison, id, limit, unit),
    ),
    row < 0
      ? null
      : button(`Go to frame ${id}`, "Move the cursor to the first frame where the runs part", () =>
          store.set({ row, playing: false }),
        ),
    el("h4", {}, `Distance by frame [${unit}]`),
    distanceGraph(comparison.ids, comparison.distance, limit, 320, (x) => {
      const nearest = comparison.ids.reduce((best, candidate) =>
        Math.abs(candidate - x) < Math.abs(best - x) ? candidate : best,
      );
      store.set({ row: run.frames.rowOf.get(nearest) ?? store.state.row, playing: false });
    }),
    saveButtons(run, other, comparison, unit),
    facts([
      ["Frames in common", formatCount(comparison.ids.length)],
      ["Distance, root mean square", formatWithUnit(rms(comparison.distance), unit)],
      [
        "Distance, largest",
        formatWithUnit(
          comparison.distance.reduce((a, b) => Math.max(a, b), 0),
          unit,
        ),
      ],
    ]),
  );
}

function saveButtons(run: RunData, other: RunData, comparison: Comparison, unit: string): HTMLElement {
  const name = `${run.name}_${other.name}_distance`;
  const svg = (): string => {
    const title = `Distance of ${other.name} from ${run.name}`;
    const range: [number, number] = [comparison.ids[0], comparison.ids[comparison.ids.length - 1]];
    return graphSvg(
      title,
      "Frame",
      `Distance [${unit}]`,
      comparison.ids,
      [{ name: "", colour: "#d55e00", values: comparison.distance }],
      range,
    );
  };
  return el(
    "div",
    { class: "row" },
    button("SVG", "Save the distances as SVG", () => saveText(svg(), "image/svg+xml", `${name}.svg`)),
    button("PNG", "Save the distances as PNG", () => void saveSvgAsPng(svgUri(svg()), 1600, `${name}.png`)),
  );
}

function choices(store: Store, limit: number, unit: string): HTMLElement {
  const input = el("input", {
    type: "number",
    min: "0",
    step: "any",
    value: String(limit),
    "aria-label": `Threshold in ${unit}`,
  });
  input.addEventListener("change", () => {
    const value = Number(input.value);
    store.set({ threshold: value > 0 ? value : null });
  });
  return el(
    "div",
    { class: "row" },
    el(
      "label",
      {},
      "Align on ",
      select(
        "Frames of the alignment",
        [
          { value: "beginning", text: "the common beginning" },
          { value: "whole", text: "all common frames" },
        ],
        store.state.alignOn,
        (value) => store.set({ alignOn: value === "whole" ? "whole" : "beginning" }),
      ),
    ),
    el("label", {}, "Threshold ", input, ` ${unit}`),
  );
}

function alignmentSentence(comparison: Comparison, other: RunData, on: string): string {
  const frames =
    on === "whole"
      ? `all ${formatCount(comparison.alignedOn)} common frames`
      : `the first ${formatCount(comparison.alignedOn)} common frames`;
  const kind = comparison.withScale
    ? `a similarity: its scale ${formatNumber(comparison.alignment.scale, 4)} is fitted, because a run is not metric`
    : "a rigid motion: no scale is fitted";
  return `${other.name} is aligned on ${frames} of the main components by ${kind}.`;
}

function partingSentence(run: RunData, comparison: Comparison, id: number | null, limit: number, unit: string): string {
  if (id === null) return `The two trajectories are nowhere further apart than ${formatWithUnit(limit, unit)}.`;
  const row = run.frames.rowOf.get(id) ?? 0;
  const time = formatTime(run.frames.stamp[row] - run.frames.stamp[0]);
  const distance = comparison.distance[comparison.ids.indexOf(id)];
  return `They part at frame ${id} (${time}): there they are ${formatWithUnit(distance, unit)} apart, more than ${formatWithUnit(limit, unit)} for the first time.`;
}

/** One column a run; figures of one name but different protocols stay apart. */
function figuresTable(report: ReportData): HTMLElement {
  const rows = new Map<string, string[]>();
  const put = (name: string, i: number, text: string): void => {
    const row = rows.get(name) ?? report.runs.map(() => "–");
    row[i] = text;
    rows.set(name, row);
  };
  report.runs.forEach((run, i) => {
    put("Verdict", i, run.judgement?.verdict ?? "none");
    for (const figure of run.figures)
      put(`${figure.name} (${figure.protocol})`, i, formatWithUnit(figure.value, figure.unit));
    put("Frames posed", i, `${formatCount(run.summary.posed)} of ${formatCount(run.summary.frames)}`);
    put("Keyframes", i, formatCount(run.summary.keyframes));
    put("Loops accepted", i, formatCount(run.summary.loops_accepted));
    put("Path length", i, formatWithUnit(travelled(run), lengthUnit(run)));
    put("Run time (wall clock)", i, formatDuration(run.summary.wall_s));
    put("Run time (all cores)", i, formatDuration(run.summary.cpu_s));
    for (const option of run.options) put(`Option ${option.name}`, i, option.value);
  });
  const head = el(
    "tr",
    {},
    el("th", {}, "Figure"),
    ...report.runs.map((run) => el("th", { class: "number" }, run.name)),
  );
  const body = el("tbody");
  for (const [name, texts] of rows)
    body.append(el("tr", {}, el("td", {}, name), ...texts.map((text) => el("td", { class: "number" }, text))));
  return el("div", { class: "wide" }, el("table", { class: "compare" }, el("thead", {}, head), body));
}
