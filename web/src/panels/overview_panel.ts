import { formatCount, formatDuration, formatPercent, formatWithUnit } from "../data/format";
import type { RunData } from "../data/model";
import type { Figure, Judgement, Option } from "../data/report";
import { lengthUnit, times, travelled } from "../data/series";
import { button, el, facts } from "../page/dom";
import { saveText } from "../save/save";
import type { Panel, PanelContext } from "./panel";

const SENSORS = { mono: "one camera", stereo: "stereo camera", rgbd: "RGB-D camera" };
const VERDICTS = {
  good: "The run is good.",
  doubtful: "The run is doubtful.",
  failed: "The run has failed.",
};

export function overviewPanel({ report, store }: PanelContext): Panel {
  return {
    title: "Overview",
    available: report.runs.length > 0,
    keys: ["run"],
    render: () => {
      const run = report.runs[store.state.run];
      return el(
        "div",
        {},
        el("h2", {}, run.name),
        el("p", { class: "soft" }, `${run.folder} · ${SENSORS[run.sensor]} · ${report.program}`),
        run.judgement ? judgementSection(run.judgement) : null,
        figuresSection(run.figures),
        el("h3", {}, "Counts"),
        countsOf(run),
        componentsSection(run),
        listSection("Notes", run.notes),
        optionsSection(run.options),
        run.georeference ? georeferenceSection(run) : null,
      );
    },
  };
}

function scaleSentence(judgement: Judgement): string {
  const scale = judgement.metric ? "Lengths are in metres" : "The scale is unknown";
  return judgement.why_metric === "" ? `${scale}.` : `${scale}, ${judgement.why_metric}.`;
}

function judgementSection(judgement: Judgement): HTMLElement {
  const box = el("section", { class: `judgement ${judgement.verdict}` }, el("strong", {}, VERDICTS[judgement.verdict]));
  box.append(el("p", {}, scaleSentence(judgement)));
  if (judgement.expected_drift_m !== null) {
    box.append(el("p", {}, `The expected drift at the end is ${formatWithUnit(judgement.expected_drift_m, "m")}.`));
  }
  for (const finding of judgement.findings) {
    box.append(
      el(
        "div",
        { class: "finding" },
        el("strong", {}, finding.cause),
        el("p", {}, finding.text),
        el("p", {}, el("em", {}, "Advice: "), finding.advice),
      ),
    );
  }
  return box;
}

export function figuresSection(figures: Figure[]): HTMLElement | null {
  if (figures.length === 0) return null;
  const body = el("tbody");
  for (const figure of figures) {
    body.append(
      el(
        "tr",
        {},
        el("td", {}, figure.name),
        el("td", { class: "number" }, formatWithUnit(figure.value, figure.unit)),
        el("td", { class: "soft" }, figure.protocol),
      ),
    );
  }
  const head = el(
    "thead",
    {},
    el("tr", {}, el("th", {}, "Figure"), el("th", { class: "number" }, "Value"), el("th", {}, "Protocol")),
  );
  return el("section", {}, el("h3", {}, "Figures"), el("table", { class: "figures" }, head, body));
}

export function countsOf(run: RunData): HTMLElement {
  const { summary } = run;
  const seconds = times(run).at(-1) ?? 0;
  return facts([
    ["Frames", formatCount(summary.frames)],
    ["Frames posed", `${formatCount(summary.posed)} (${formatPercent(summary.posed / summary.frames)})`],
    ["Keyframes", formatCount(summary.keyframes)],
    ["Places", formatCount(summary.places)],
    [
      "Landmarks",
      run.landmarks.count === summary.landmarks
        ? formatCount(summary.landmarks)
        : `${formatCount(summary.landmarks)}, ${formatCount(run.landmarks.count)} of them in this page`,
    ],
    ["Loops accepted", formatCount(summary.loops_accepted)],
    ["Path length", formatWithUnit(travelled(run), lengthUnit(run))],
    ["Length of the sequence", formatDuration(seconds)],
    ["Run time (wall clock)", formatDuration(summary.wall_s)],
    ["Run time (all cores)", formatDuration(summary.cpu_s)],
  ]);
}

function componentsSection(run: RunData): HTMLElement | null {
  if (run.components.length < 2) return null;
  const rows = run.components.map(
    (c) =>
      `Component ${c.number}${c.main ? " (main)" : ""}: ${formatCount(c.posed)} frames between frame ${c.first} and frame ${c.last}`,
  );
  return el(
    "section",
    {},
    listSection("Components", rows),
    el(
      "p",
      { class: "soft" },
      "Each component has a coordinate frame of its own. Distances between components mean nothing.",
    ),
  );
}

function listSection(title: string, texts: string[]): HTMLElement | null {
  if (texts.length === 0) return null;
  return el("section", {}, el("h3", {}, title), el("ul", {}, ...texts.map((text) => el("li", {}, text))));
}

function optionsSection(options: Option[]): HTMLElement | null {
  if (options.length === 0)
    return el("section", {}, el("h3", {}, "Options"), el("p", { class: "soft" }, "All options have their defaults."));
  const body = el("tbody");
  for (const option of options) {
    body.append(
      el(
        "tr",
        {},
        el("td", {}, el("code", {}, option.name)),
        el("td", {}, option.value),
        el("td", { class: "soft" }, option.default_value),
      ),
    );
  }
  const head = el("thead", {}, el("tr", {}, el("th", {}, "Option"), el("th", {}, "Value"), el("th", {}, "Default")));
  return el("section", {}, el("h3", {}, "Options that differ from their defaults"), el("table", {}, head, body));
}

function georeferenceSection(run: RunData): HTMLElement | null {
  const { georeference } = run;
  if (georeference === null) return null;
  const save = (): void => {
    const coordinates: number[][] = [];
    for (let i = 0; i < georeference.track.length; i += 2) {
      if (Number.isFinite(georeference.track[i])) coordinates.push([georeference.track[i + 1], georeference.track[i]]);
    }
    const line = { type: "Feature", properties: { name: run.name }, geometry: { type: "LineString", coordinates } };
    saveText(JSON.stringify(line), "application/geo+json", `${run.name}.geojson`);
  };
  return el(
    "section",
    {},
    el("h3", {}, "Georeference"),
    facts([
      ["Latitude", `${georeference.latitude.toFixed(7)} deg`],
      ["Longitude", `${georeference.longitude.toFixed(7)} deg`],
    ]),
    button("Save the track as GeoJSON", "Save the track as GeoJSON", save),
  );
}
