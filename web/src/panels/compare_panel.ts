import {
  type AlignOn,
  type Comparison,
  bothInTruth,
  comparable,
  compareRuns,
  defaultThreshold,
  firstParting,
  rms,
} from "../data/compare";
import { formatCount, formatDuration, formatNumber, formatTime, formatWithUnit } from "../data/format";
import type { ReportData, RunData } from "../data/model";
import { lengthUnit, travelled } from "../data/series";
import { button, el, facts, select, svgUri } from "../page/dom";
import type { Store } from "../page/state";
import { graphSvg } from "../save/graph_svg";
import { saveSvgAsPng, saveText } from "../save/save";
import { distanceGraph } from "./distance_graph";
import type { Panel, PanelContext } from "./panel";
import { tableSection } from "./table_section";

export function comparePanel({ report, store }: PanelContext): Panel {
  return {
    title: "Compare",
    available: report.runs.length > 1,
    keys: ["run", "compareWith", "alignOn", "threshold", "theme"],
    render: () => {
      return el(
        "div",
        {},
        ...trajectories(report, store),
        el("h3", {}, "Figures side by side"),
        figuresTable(report),
        ...report.tables.map(tableSection),
      );
    },
  };
}

/** The trajectories of the chosen run and another one of the same recording. */
function trajectories(report: ReportData, store: Store): HTMLElement[] {
  const { state } = store;
  const run = report.runs[state.run];
  const choices = report.runs
    .map((other, i) => ({ value: String(i), text: other.name, other }))
    .filter(({ other }) => other !== run && comparable(run, other));
  const chosen = choices.find(({ value }) => value === String(state.compareWith)) ?? choices[0];
  if (chosen === undefined)
    return [el("p", {}, "No other run is of the same recording, so no trajectories are compared.")];
  if (run.loops.judged) return [];
  return [
    el("h2", {}, `${run.name} and ${chosen.other.name}`),
    el(
      "label",
      {},
      "Compare with ",
      select("Run to compare with", choices, chosen.value, (value) => store.set({ compareWith: Number(value) })),
    ),
    partingSection(run, chosen.other, store),
  ];
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
    choices(store, limit, unit, bothInTruth(run, other)),
    el("p", {}, alignmentSentence(comparison, run, other)),
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

function choices(store: Store, limit: number, unit: string, inTruth: boolean): HTMLElement {
  const frames = [
    { value: "beginning", text: "the common beginning" },
    { value: "whole", text: "all common frames" },
  ];
  if (inTruth) frames.unshift({ value: "truth", text: "the ground truth" });
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
      select("Frames of the alignment", frames, store.state.alignOn, (value) =>
        store.set({ alignOn: value as AlignOn }),
      ),
    ),
    el("label", {}, "Threshold ", input, ` ${unit}`),
  );
}

function alignmentSentence(comparison: Comparison, run: RunData, other: RunData): string {
  if (comparison.alignedOn === 0)
    return `Both are in the frame of the ground truth: ${run.name} by the alignment ${run.aligned ?? ""}, ${other.name} by ${other.aligned ?? ""}.`;
  const frames =
    comparison.alignedOn === comparison.ids.length
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

function putCounts(run: RunData, put: (name: string, text: string) => void): void {
  const { summary } = run;
  if (run.loops.judged) return;
  put("Frames posed", `${formatCount(summary.posed)} of ${formatCount(summary.frames)}`);
  if (summary.keyframes !== null) put("Keyframes", formatCount(summary.keyframes));
  if (summary.loops_accepted !== null) put("Loops accepted", formatCount(summary.loops_accepted));
  put("Path length", formatWithUnit(travelled(run), lengthUnit(run)));
  if (summary.wall_s !== null) put("Run time (wall clock)", formatDuration(summary.wall_s));
  if (summary.cpu_s !== null) put("Run time (all cores)", formatDuration(summary.cpu_s));
}

/** The protocol without what differs between runs of one recording: numbers of frames and lengths. */
function sharedProtocol(protocol: string): string {
  return protocol.replace(/, \d+ frames/, "").replace(/ of [\d.]+ m/, "");
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
    if (run.judgement) put("Verdict", i, run.judgement.verdict);
    for (const figure of run.figures)
      put(`${figure.name} (${sharedProtocol(figure.protocol)})`, i, formatWithUnit(figure.value, figure.unit));
    putCounts(run, (name, text) => put(name, i, text));
    for (const option of run.options ?? []) put(`Option ${option.name}`, i, option.value);
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
