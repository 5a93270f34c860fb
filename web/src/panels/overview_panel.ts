import { formatCount, formatDuration, formatPercent, formatWithUnit } from "../data/format";
import type { RunData } from "../data/model";
import type { Figure, Judgement, Option } from "../data/report";
import { lengthUnit, times, travelled } from "../data/series";
import { geoJson, gpx } from "../data/geodesy";
import { button, el, facts, svgUri } from "../page/dom";
import { escapeXml } from "../save/graph_svg";
import { saveText } from "../save/save";
import { earthSvg } from "./earth_svg";
import type { Panel, PanelContext } from "./panel";
import { tableSection } from "./table_section";

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
        el("p", { class: "soft" }, sourceOf(run, report.program)),
        run.judgement ? judgementSection(run.judgement) : null,
        figuresSection(run.figures),
        ...run.tables.map(tableSection),
        el("h3", {}, "Counts"),
        countsOf(run),
        componentsSection(run),
        listSection("Notes", run.notes),
        run.options === null ? null : optionsSection(run.options),
        georeferenceSection(run),
      );
    },
  };
}

function sourceOf(run: RunData, program: string): string {
  const aligned = run.aligned === null || run.loops.judged ? "" : `poses aligned to the ground truth: ${run.aligned}`;
  return [run.folder, run.sensor === null ? "" : SENSORS[run.sensor], aligned, program]
    .filter((text) => text !== "")
    .join(" · ");
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
  const rows: [string, string][] = [["Frames", formatCount(summary.frames)]];
  const add = (name: string, value: number | null, text: (value: number) => string): void => {
    if (value !== null) rows.push([name, text(value)]);
  };
  if (summary.posed > 0)
    add("Frames posed", summary.posed, (n) => `${formatCount(n)} (${formatPercent(n / summary.frames)})`);
  add("Keyframes", summary.keyframes, formatCount);
  add("Places", summary.places, formatCount);
  add("Landmarks", summary.landmarks, (n) =>
    run.landmarks.count === n ? formatCount(n) : `${formatCount(n)}, ${formatCount(run.landmarks.count)} of them in this page`,
  );
  add("Loops accepted", summary.loops_accepted, formatCount);
  if (summary.posed > 0) rows.push(["Path length", formatWithUnit(travelled(run), lengthUnit(run))]);
  rows.push(["Length of the sequence", formatDuration(times(run).at(-1) ?? 0)]);
  add("Run time (wall clock)", summary.wall_s, formatDuration);
  add("Run time (all cores)", summary.cpu_s, formatDuration);
  return facts(rows);
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
  const geo = run.georeference;
  if (geo === null) return null;
  const rows: [string, string][] = [
    ["Origin", `${geo.latitude_deg.toFixed(7)}, ${geo.longitude_deg.toFixed(7)} deg (latitude, longitude)`],
  ];
  if (geo.fixes_used !== null) rows.push(["Fixes used", formatCount(geo.fixes_used)]);
  if (geo.fixes_rejected !== null) rows.push(["Fixes rejected", formatCount(geo.fixes_rejected)]);
  if (geo.residual_rms_m !== null) rows.push(["Residual of the fixes, RMS", formatWithUnit(geo.residual_rms_m, "m")]);
  return el(
    "section",
    {},
    el("h3", {}, "Georeference"),
    el("p", { class: "soft" }, geo.folder),
    facts(rows),
    el("img", { class: "earth", src: svgUri(earthSvg(geo)), alt: "The track on the earth, north up" }),
    el(
      "div",
      { class: "row" },
      button("GeoJSON", "Save the track as GeoJSON", () =>
        saveText(geoJson(run.name, geo), "application/geo+json", `${run.name}.geojson`),
      ),
      button("GPX", "Save the track as GPX", () =>
        saveText(gpx(run.name, geo, escapeXml), "application/gpx+xml", `${run.name}.gpx`),
      ),
    ),
  );
}
