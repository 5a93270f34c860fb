import "uplot/dist/uPlot.min.css";
import "./page/style.css";
import { loadReport } from "./data/load";
import type { ReportData } from "./data/model";
import { watchPlaying } from "./page/actions";
import { el } from "./page/dom";
import { header } from "./page/header";
import { replaceReport } from "./edit/replace_report";
import { editedLoop } from "./edit/editor";
import { watchUnsaved } from "./edit/edit_panel";
import { readLiveStart } from "./live/live_start";
import { type Served, startLive } from "./live/start";
import { REPORT_MOUSE, helpDialog } from "./page/help";
import { bindings, watchKeys } from "./page/keys";
import { splitter } from "./page/splitter";
import { startState } from "./page/start_state";
import { Store } from "./page/state";
import { preferredTheme, toggleTheme, watchTheme } from "./page/theme";
import { comparePanel } from "./panels/compare_panel";
import { framePanel } from "./panels/frame_panel";
import { graphPanel } from "./panels/graph_panel";
import { layersPanel, sceneTools } from "./panels/layers_panel";
import { loopsPanel } from "./panels/loops_panel";
import { overviewPanel } from "./panels/overview_panel";
import { picturesPanel } from "./panels/pictures_panel";
import { tabs } from "./panels/tabs";
import { watchPointer } from "./scene/pointer";
import { SceneView } from "./scene/scene_view";
import { graphics } from "./scene/viewport";
import { timelineControls } from "./timeline/controls";
import { Timeline } from "./timeline/timeline";

function showMessage(page: HTMLElement, text: string): void {
  page.className = "message";
  page.replaceChildren(el("p", { role: "alert" }, text));
}

/** Pixels at the left of the scene that the open layers cover, if they leave enough for the map. */
function coveredBy(layers: HTMLDetailsElement): number {
  const width = layers.offsetLeft + layers.offsetWidth;
  return layers.open && width < 0.4 * (layers.parentElement?.clientWidth ?? 0) ? width : 0;
}

/** The scene with its tools; without WebGL 2 a sentence in its place, and the rest of the page works. */
function showScene(page: HTMLElement, report: ReportData, store: Store): SceneView | null {
  if (graphics() === "none") {
    page.append(
      el(
        "section",
        { class: "scene message" },
        el(
          "p",
          { role: "alert" },
          "This browser has no WebGL 2, so the scene is not shown. Everything else of the report is.",
        ),
      ),
    );
    return null;
  }
  const scene = new SceneView(page, report, store);
  scene.element.append(sceneTools(report, store, scene));
  if (report.runs.length > 0) {
    const layers = layersPanel(report, store);
    scene.element.append(layers);
    new ResizeObserver(() => scene.viewport.setInset(coveredBy(layers))).observe(layers);
    watchPointer(scene, report, store);
  }
  return scene;
}

function showReport(page: HTMLElement, report: ReportData, served: Served | null): void {
  document.title = `${report.title} – ${report.program}`;
  const store = new Store(startState(report, served?.theme ?? preferredTheme()));
  watchTheme(store);
  const help = helpDialog(REPORT_MOUSE);
  const editor = served?.editor ?? null;
  if (editor) editor.onReport = (next, edit) => replaceReport(report, store, next, editedLoop(edit));
  page.className = "report";
  page.append(header(report, store, help.toggle, editor ? watchUnsaved(editor) : null));
  const scene = showScene(page, report, store);
  if (report.runs.length > 0) {
    const timeline = new Timeline(report, store);
    timeline.onHold = (held) => scene?.viewport.hold(held);
    page.append(
      el(
        "section",
        { class: "timeline", "aria-label": "Time line" },
        timelineControls(report, store, timeline),
        timeline.element,
      ),
    );
    watchPlaying(report, store);
  }
  const context = { report, store, served };
  page.append(
    tabs(store, {
      overview: overviewPanel(context),
      frame: framePanel(context),
      loops: loopsPanel(context),
      compare: comparePanel(context),
      pictures: picturesPanel(context),
      graph: graphPanel(context),
    }),
    splitter(page),
    help.element,
  );
  const list = bindings(report, store, scene, help.toggle, () => toggleTheme(store));
  help.fill(list);
  watchKeys(list);
}

function showIfAny(page: HTMLElement, report: ReportData, served: Served | null): void {
  if (report.runs.length > 0 || report.graphs.length > 0 || report.pictures.length > 0)
    showReport(page, report, served);
  else showMessage(page, "The report in this page holds no run, no pose graph and no picture.");
}

function start(page: HTMLElement): void {
  try {
    const live = readLiveStart(document);
    const report = loadReport(document);
    if (live !== null) {
      startLive(page, live, showIfAny, showMessage);
    } else if (report === null) {
      showMessage(
        page,
        'This page holds no report. The command "placegraph report OUT -o report.html" writes a page with the report of a run.',
      );
    } else {
      showIfAny(page, report, null);
    }
  } catch (error) {
    showMessage(
      page,
      `This report cannot be shown. ${error instanceof Error ? error.message : "The fault is unknown."}`,
    );
  }
}

const page = document.getElementById("page");
if (page) start(page);
