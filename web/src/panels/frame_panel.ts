import { formatNumber, formatPercent, formatTime, formatWithUnit } from "../data/format";
import { loopsAt, stageOf, stageSentence } from "../data/loops";
import { label, type RunData } from "../data/model";
import { keyframeAt, keyframeOf } from "../data/run_view";
import { lengthUnit, series } from "../data/series";
import { FrameView } from "../live/frame_view";
import { loopSelection } from "../page/actions";
import { button, el, facts, isPicture } from "../page/dom";
import type { Panel, PanelContext } from "./panel";
import { tracksOverlay } from "./tracks_overlay";

export function framePanel({ report, store, served }: PanelContext): Panel {
  let figure: HTMLElement | null = null;
  const full = served ? new FrameView(store) : null;
  return {
    title: "Frame",
    available: report.runs.length > 0,
    keys: ["run", "row", "component", "loop"],
    render: () => {
      const run = report.runs[store.state.run];
      const { row } = store.state;
      if (run.frames.count === 0) return el("p", {}, "This run has no frames.");
      const id = run.frames.id[row];
      if (full === null) figure = thumbnailOf(run, row, figure);
      else {
        full.show(run, store.state.run, row);
        figure = full.element;
      }
      return el(
        "div",
        {},
        el("h2", {}, `Frame ${id}`),
        el("p", {}, stateSentence(run, row)),
        componentNote(run, row, store.state.component, (component) => store.set({ component })),
        figure,
        facts(frameFacts(run, row)),
        el("h3", {}, "Loops that start or end here"),
        loopList(run, id, (loop) => store.set({ ...loopSelection(report, store.state, loop), tab: "loops" })),
      );
    },
  };
}

export function stateSentence(run: RunData, row: number): string {
  const { frames } = run;
  const number = frames.component[row];
  if (number < 0) {
    const reason = label(frames.reason, row);
    return reason === null ? "The frame is lost: it has no pose." : `The frame is lost: ${reason}.`;
  }
  const main = run.components.find((component) => component.number === number)?.main ?? false;
  const part = run.components.length > 1 ? ` of component ${number}${main ? " (main)" : ""}` : "";
  return keyframeOf(run, row) >= 0 ? `The frame is a keyframe${part}.` : `The frame has a pose${part}.`;
}

function componentNote(
  run: RunData,
  row: number,
  shown: number | null,
  show: (component: number) => void,
): HTMLElement | null {
  const number = run.frames.component[row];
  if (number < 0 || shown === null || shown === number) return null;
  return el(
    "p",
    { class: "note" },
    `The scene shows component ${shown}; this frame belongs to component ${number}. `,
    button(`Show component ${number}`, "Show the component of this frame", () => show(number)),
  );
}

/** `shown` is the figure in the page: it stays there while the keyframe is the same, without flicker. */
function thumbnailOf(run: RunData, row: number, shown: HTMLElement | null): HTMLElement | null {
  const k = keyframeAt(run, row);
  const uri = run.keyframes.thumbnails[k];
  if (!isPicture(uri)) return null;
  const frame = run.keyframes.frame[k];
  const id = run.keyframes.id[k];
  const caption = frame === run.frames.id[row] ? `Keyframe ${id}` : `Keyframe ${id}, of frame ${frame}`;
  const image = shown?.querySelector("img");
  if (image?.src === uri) {
    image.alt = caption;
    shown?.querySelector("figcaption")?.replaceChildren(caption);
    return shown;
  }
  const camera = run.camera;
  const overlay = camera === null ? null : tracksOverlay(run, k, camera.width, camera.height);
  return el(
    "figure",
    {},
    el("div", { class: "tracked" }, el("img", { src: uri, alt: caption }), overlay),
    el("figcaption", {}, caption),
    overlay === null
      ? null
      : el("p", { class: "soft" }, "Points: landmarks with the longest tracks, and where the keyframes before saw them."),
  );
}

function frameFacts(run: RunData, row: number): [string, string][] {
  const { frames, keyframes } = run;
  const k = keyframeAt(run, row);
  const unit = lengthUnit(run);
  const rows: [string, string][] = [
    ["Time", `${formatTime(frames.stamp[row] - frames.stamp[0])} (stamp ${frames.stamp[row].toFixed(3)} s)`],
    ["Component", frames.component[row] < 0 ? "none" : String(frames.component[row])],
  ];
  if (keyframes.count > 0 && !run.loops.judged)
    rows.push(["Keyframe", keyframeText(run, row)]);
  if (k >= 0 && keyframes.place[k] >= 0) rows.push(["Place", String(keyframes.place[k])]);
  if (frames.inliers) rows.push(["Inliers", formatNumber(frames.inliers[row])]);
  if (frames.confidence) rows.push(["Confidence", formatPercent(frames.confidence[row])]);
  if (frames.errorM) rows.push(["Position error", formatWithUnit(frames.errorM[row], "m")]);
  if (frames.errorDeg) rows.push(["Rotation error", formatWithUnit(frames.errorDeg[row], "deg")]);
  if (frames.sigma) rows.push(["Uncertainty (1 sigma)", formatWithUnit(frames.sigma[row], unit)]);
  rows.push(["Speed", formatWithUnit(series(run, "speed").values[row], `${unit}/s`)]);
  if (frames.environment) rows.push(["Environment", label(frames.environment, row) ?? "unknown"]);
  if (frames.component[row] >= 0) {
    const p = [0, 1, 2].map((i) => frames.pose[7 * row + i].toFixed(3));
    const frame = run.aligned === null ? "the map" : "the ground truth's frame";
    rows.push([`Position in ${frame}`, `${p.join(", ")} ${unit}`]);
  }
  const geo = run.georeference;
  if (geo && Number.isFinite(geo.track[3 * row])) {
    rows.push(["Latitude, longitude", `${geo.track[3 * row].toFixed(7)}, ${geo.track[3 * row + 1].toFixed(7)} deg`]);
    rows.push(["Height above the ellipsoid", `${geo.track[3 * row + 2].toFixed(2)} m`]);
  }
  return rows;
}

function keyframeText(run: RunData, row: number): string {
  const keyframe = run.frames.keyframe[row];
  if (keyframe < 0) return "none";
  const frame = run.keyframes.frame[run.keyframes.rowOf.get(keyframe) ?? -1];
  return frame === undefined || frame === run.frames.id[row] ? String(keyframe) : `${keyframe}, of frame ${frame}`;
}

function loopList(run: RunData, id: number, choose: (loop: number) => void): HTMLElement {
  const rows = loopsAt(run.loops, id);
  if (rows.length === 0) return el("p", { class: "soft" }, "None.");
  const list = el("ul");
  for (const loop of rows.slice(0, 50)) {
    const other = run.loops.query[loop] === id ? run.loops.match[loop] : run.loops.query[loop];
    const stage = stageOf(run.loops, loop);
    list.append(
      el(
        "li",
        {},
        button(`With frame ${other}`, "Select this loop", () => choose(loop)),
        ` ${stageSentence(stage)}`,
      ),
    );
  }
  return list;
}
