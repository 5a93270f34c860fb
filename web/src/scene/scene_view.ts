import { Matrix4, type Sphere, Vector3 } from "three";
import type { GraphData, ReportData, RunData } from "../data/model";
import { isPosed } from "../data/run_view";
import { el } from "../page/dom";
import type { LayerName, State, Store } from "../page/state";
import { saveCanvas } from "../save/save";
import type { LegendItem } from "./colouring";
import { edgeMiddle, graphLegend, graphLines, graphSphere } from "./graph_layer";
import { drawLegend, legendElement } from "./legend";
import { dispose } from "./lines";
import { nearestFrame, nearestLandmark, nearestLoop, type Screen } from "./picking";
import { loopRows } from "./loops_layer";
import { RunScene } from "./run_scene";
import { Viewport } from "./viewport";

const OBLIQUE = new Vector3(-0.35, 0.9, 0.75);
const ABOVE = new Vector3(0, 1, 0.0005);

/** Which state makes which layers be built again. */
const REBUILD: [(keyof State)[], LayerName[]][] = [
  [["colourBy"], ["trajectory"]],
  [["pointColour"], ["landmarks"]],
  [["frustumSize"], ["frusta", "images"]],
  [["loopFilter"], ["loops", "refused"]],
  [["alignOn"], ["others"]],
  [["theme"], ["grid", "truth", "frusta"]],
];

/** The three-dimensional view: a run, or a pose graph while the tab of graphs is open. */
export class SceneView {
  readonly element = el("section", { class: "scene", "aria-label": "Scene" });
  readonly viewport: Viewport;
  private run: RunScene | null = null;
  private built: Pick<State, "run" | "component"> = { run: 0, component: null };
  private graph: ReturnType<typeof graphLines> | null = null;
  private legendBox = legendElement([]);
  private readonly followed = new Vector3();

  constructor(
    page: HTMLElement,
    private readonly report: ReportData,
    private readonly store: Store,
  ) {
    page.append(this.element);
    this.viewport = new Viewport(this.element);
    this.element.append(this.legendBox);
    this.viewport.onQuality = (level) => this.run?.setQuality(level);
    this.viewport.beforeDraw = () => this.run?.beforeDraw();
    this.applyTheme();
    if (report.runs.length > 0) this.buildRun();
    this.showGraph();
    this.watch();
    this.fit();
  }

  fit(): void {
    this.viewport.fit(this.sphere(), OBLIQUE);
  }

  top(): void {
    this.viewport.fit(this.sphere(), ABOVE);
  }

  save(): void {
    const source = this.viewport.drawNow();
    const canvas = document.createElement("canvas");
    canvas.width = source.width;
    canvas.height = source.height;
    const context = canvas.getContext("2d");
    if (!context) return;
    context.drawImage(source, 0, 0);
    const ratio = source.width / Math.max(this.element.clientWidth, 1);
    context.scale(ratio, ratio);
    drawLegend(context, this.legend(), source.height / ratio, this.store.state.theme === "dark");
    saveCanvas(canvas, `${this.name()}_scene.png`);
  }

  /** Row of the frame near a point of the screen, or -1. */
  frameAt(x: number, y: number, radius: number): number {
    const run = this.currentRun();
    return run ? nearestFrame(run, this.store.state.component, this.screen(), x, y, radius) : -1;
  }

  /** Row of a landmark near a point of the screen that the keyframe under the cursor observes, or -1. */
  landmarkAt(x: number, y: number): number {
    const run = this.currentRun();
    const { observed } = this.store.state;
    return run && observed ? nearestLandmark(run, observed, this.screen(), x, y, 6) : -1;
  }

  /** Row of a visible loop near a point of the screen, or -1. */
  loopAt(x: number, y: number): number {
    const run = this.currentRun();
    const { layers, loopFilter, component } = this.store.state;
    if (!run) return -1;
    const rows = [
      ...(layers.loops ? loopRows(run, loopFilter, true) : []),
      ...(layers.refused ? loopRows(run, loopFilter, false) : []),
    ];
    return nearestLoop(run, component, rows, this.screen(), x, y, 7);
  }

  /** Makes the frame the point about which the camera rotates. */
  lookAtFrame(row: number): void {
    const run = this.currentRun();
    if (!this.run || !run || !isPosed(run, row, this.store.state.component)) return;
    const { target } = this.viewport.controls;
    this.viewport.shift(this.run.framePosition(row).sub(target));
  }

  private watch(): void {
    const { store } = this;
    store.on(["run", "component"], () => this.buildRun());
    store.on(["layers", ...REBUILD.flatMap(([keys]) => keys)], () => this.refreshLegendSoon());
    store.on(["layers"], (state) => this.run?.update(state));
    for (const [keys, layers] of REBUILD) store.on(keys, (state) => this.run?.update(state, layers));
    store.on(["pointSize"], (state) => this.run?.setPointSize(state));
    store.on(["row", "loop"], (state) => {
      this.run?.showCursor(state);
      this.viewport.move();
      if (state.follow !== "off") this.follow(state);
    });
    store.on(["landmark", "observed"], (state) => this.run?.showCursor(state));
    store.on(["follow"], (state) => {
      if (state.follow === "along") this.lookAtFrame(state.row);
      this.rememberFollowed(state.row);
      if (state.follow === "through") this.follow(state);
    });
    store.on(["theme"], () => this.applyTheme());
    store.on(["tab", "graph", "graphShape", "edgeKind", "edge"], () => this.showGraph());
    store.on(["tab", "graph"], (state) => {
      const shown = state.tab === "graph" && this.report.graphs.length > 0;
      if (shown || this.wasGraph) this.fit();
      this.wasGraph = shown;
    });
    store.on(["edge"], (state) => {
      const graph = this.shownGraph();
      if (graph && state.edge >= 0) {
        this.viewport.shift(edgeMiddle(graph, state.graphShape, state.edge).sub(this.viewport.controls.target));
      }
    });
  }

  private wasGraph = false;
  private legendPending = false;

  private refreshLegendSoon(): void {
    if (this.legendPending) return;
    this.legendPending = true;
    queueMicrotask(() => {
      this.legendPending = false;
      this.refreshLegend();
    });
  }

  private buildRun(): void {
    const { run, component, row } = this.store.state;
    // After an edit the same run is built again, and the view stays.
    const other = this.run !== null && (run !== this.built.run || component !== this.built.component);
    this.run?.dispose();
    this.run = new RunScene(this.report, this.store.state, this.viewport);
    this.built = { run, component };
    this.rememberFollowed(row);
    this.refreshLegend();
    if (other) this.fit();
  }

  private shownGraph(): GraphData | null {
    const { tab, graph } = this.store.state;
    return tab === "graph" || this.report.runs.length === 0 ? (this.report.graphs[graph] ?? null) : null;
  }

  private showGraph(): void {
    if (this.graph) dispose(this.graph);
    this.graph = null;
    const graph = this.shownGraph();
    if (graph) {
      this.graph = graphLines(graph, this.store.state.graphShape, this.store.state.edgeKind, this.store.state.edge);
      this.viewport.scene.add(this.graph);
    }
    if (this.run) this.run.root.visible = graph === null;
    this.element.parentElement?.toggleAttribute("data-graph", graph !== null);
    this.refreshLegend();
    this.viewport.request();
  }

  private legend(): LegendItem[] {
    const graph = this.shownGraph();
    return graph ? [graphLegend(graph)] : (this.run?.legend() ?? []);
  }

  private refreshLegend(): void {
    const next = legendElement(this.legend(), this.legendBox.open);
    this.legendBox.replaceWith(next);
    this.legendBox = next;
  }

  private follow({ row, follow, component }: Readonly<State>): void {
    const run = this.currentRun();
    if (!this.run || !run || !isPosed(run, row, component)) return;
    if (follow === "through") {
      this.viewport.lookFrom(this.run.framePosition(row), this.run.pointAhead(row));
      return;
    }
    const position = this.run.framePosition(row);
    this.viewport.shift(position.clone().sub(this.followed));
    this.followed.copy(position);
  }

  private rememberFollowed(row: number): void {
    const run = this.currentRun();
    if (this.run && run && isPosed(run, row, this.store.state.component)) this.run.framePosition(row, this.followed);
  }

  private currentRun(): RunData | null {
    return this.shownGraph() ? null : (this.report.runs[this.store.state.run] ?? null);
  }

  private name(): string {
    return this.shownGraph()?.name ?? this.currentRun()?.name ?? "placegraph";
  }

  private sphere(): Sphere {
    const graph = this.shownGraph();
    if (graph) return graphSphere(graph);
    return this.run ? this.run.sphere : graphSphere(EMPTY_GRAPH);
  }

  private screen(): Screen {
    const { camera } = this.viewport;
    camera.updateMatrixWorld();
    const matrix = new Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse);
    if (this.run) matrix.multiply(this.run.group.matrixWorld);
    return { width: this.element.clientWidth, height: this.element.clientHeight, matrix };
  }

  private applyTheme(): void {
    this.viewport.setBackground(this.store.state.theme === "dark" ? "#0d1117" : "#ffffff");
  }
}

const EMPTY_GRAPH: GraphData = {
  name: "",
  nodes: 0,
  before: new Float32Array(),
  after: null,
  allNodes: 0,
  edgeCount: 0,
  allEdges: 0,
  edges: new Int32Array(),
  ends: new Int32Array(),
  kind: { table: [], index: new Int32Array() },
  chi2: new Float32Array(),
  weight: null,
  figures: [],
};
