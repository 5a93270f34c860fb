import { comparable } from "../data/compare";
import { cssColour } from "../data/colour_scale";
import { formatTime, formatWithUnit } from "../data/format";
import type { ReportData, RunData } from "../data/model";
import { type Series, series } from "../data/series";
import { clampRow } from "../page/actions";
import { el } from "../page/dom";
import type { Store } from "../page/state";
import { runColour } from "../scene/colouring";
import { graphSvg } from "../save/graph_svg";
import { saveCanvas, saveText } from "../save/save";
import { Axis, LEFT, RIGHT } from "./axis";
import { Bands, bandsLegend } from "./bands";
import { type Curve, Graph } from "./graph";
import { Strip } from "./strip";

const GRAPH_HEIGHT = 118;

/** Thumbnails, graph and bands over one axis, with a cursor that goes through all of them. */
export class Timeline {
  readonly element = el("div", {
    class: "track",
    tabindex: "0",
    role: "slider",
    "aria-label": "Frame under the cursor",
  });
  /** Called when the user takes and leaves the cursor. */
  onHold: (held: boolean) => void = () => undefined;
  private readonly strip = new Strip();
  private readonly bands = new Bands();
  private readonly graphBox = el("div", { class: "graph" });
  private readonly graph = new Graph(this.graphBox);
  private readonly line = el("div", { class: "cursor-line" });
  private legend: HTMLElement = el("div");
  private axis: Axis;
  private shown: Series;
  private curves: Curve[] = [];
  private drawnWidth = -1;

  constructor(
    private readonly report: ReportData,
    private readonly store: Store,
  ) {
    this.axis = new Axis(this.run, store.state.axis);
    this.shown = series(this.run, store.state.series);
    this.element.append(this.strip.element, this.graphBox, this.bands.canvas, this.legend, this.line);
    this.watch();
    new ResizeObserver(() => {
      if (this.element.clientWidth !== this.drawnWidth) this.draw();
    }).observe(this.element);
    store.on(["run", "series", "axis", "theme"], () => this.draw());
    store.on(["range"], () => this.drawRange());
    store.on(["loopFilter", "loop"], () => this.drawBands());
    store.on(["row"], () => this.showCursor());
  }

  savePng(): void {
    const canvas = this.graph.canvas();
    if (canvas) saveCanvas(opaque(canvas, this.element), `${this.run.name}_${this.shown.name}.png`);
  }

  saveSvg(): void {
    const { title, unit } = this.shown;
    const yTitle = unit === "" ? title : `${title} [${unit}]`;
    const xTitle = this.axis.kind === "time" ? "Time [s]" : "Frame";
    const svg = graphSvg(`${this.run.name}: ${title}`, xTitle, yTitle, this.axis.values, this.curves, this.range);
    saveText(svg, "image/svg+xml", `${this.run.name}_${this.shown.name}.svg`);
  }

  private get run(): RunData {
    return this.report.runs[this.store.state.run];
  }

  private get range(): [number, number] {
    return this.store.state.range ?? this.axis.full;
  }

  private get width(): number {
    return Math.max(this.element.clientWidth - LEFT - RIGHT, 1);
  }

  private draw(): void {
    const { state } = this.store;
    this.axis = new Axis(this.run, state.axis);
    this.shown = series(this.run, state.series);
    this.curves = this.makeCurves();
    this.drawnWidth = this.element.clientWidth;
    if (this.drawnWidth === 0) return;
    const size = { width: this.element.clientWidth, height: GRAPH_HEIGHT };
    this.graph.show(this.shown, this.curves, this.axis, this.range, size);
    const legend = bandsLegend(this.run);
    this.legend.replaceWith(legend);
    this.legend = legend;
    this.drawStrips();
    this.showCursor();
  }

  /** The chosen run, and the others at the frames that they have too. */
  private makeCurves(): Curve[] {
    const { run: chosen, series: name } = this.store.state;
    return this.report.runs.flatMap((run, i) => {
      const colour = cssColour(runColour(i));
      if (i === chosen) return [{ name: run.name, colour, values: this.shown.values }];
      if (!comparable(this.run, run)) return [];
      const other = series(run, name).values;
      const values = Float64Array.from(this.run.frames.id, (id) => other[run.frames.rowOf.get(id) ?? -1] ?? NaN);
      return [{ name: run.name, colour, values }];
    });
  }

  private drawRange(): void {
    this.graph.setRange(this.range);
    this.drawStrips();
    this.showCursor();
  }

  private drawStrips(): void {
    this.strip.draw(this.run, this.axis, this.range, this.width);
    this.drawBands();
  }

  private drawBands(): void {
    const { loopFilter, loop } = this.store.state;
    this.bands.draw(this.run, this.axis, this.range, this.width, loopFilter, loop);
  }

  private showCursor(): void {
    const { row, range } = this.store.state;
    const value = this.axis.values[row] ?? 0;
    if (range !== null) {
      const next = this.axis.containing(range, value);
      if (next !== range) {
        this.store.set({ range: next });
        return;
      }
    }
    this.line.style.transform = `translateX(${LEFT + this.axis.pixel(value, this.range, this.width)}px)`;
    const { id, count } = this.run.frames;
    this.element.setAttribute("aria-valuemin", String(id[0] ?? 0));
    this.element.setAttribute("aria-valuemax", String(id[count - 1] ?? 0));
    this.element.setAttribute("aria-valuenow", String(id[row] ?? 0));
    this.element.setAttribute("aria-valuetext", this.cursorText());
  }

  cursorText(): string {
    const { row } = this.store.state;
    const { id, stamp, component } = this.run.frames;
    const value =
      component[row] < 0
        ? "lost"
        : `${this.shown.title.toLowerCase()} ${formatWithUnit(this.shown.values[row], this.shown.unit)}`;
    return `Frame ${id[row]}, ${formatTime(stamp[row] - stamp[0])}, ${value}`;
  }

  private watch(): void {
    const scrub = (event: PointerEvent): void => {
      const x = event.clientX - this.element.getBoundingClientRect().left - LEFT;
      const row = this.axis.row(this.axis.value(Math.min(Math.max(x, 0), this.width), this.range, this.width));
      this.store.set({ row: clampRow(this.run, row) });
    };
    this.element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.element.setPointerCapture(event.pointerId);
      this.onHold(true);
      scrub(event);
    });
    this.element.addEventListener("pointermove", (event) => {
      if (this.element.hasPointerCapture(event.pointerId)) scrub(event);
    });
    this.element.addEventListener("lostpointercapture", () => this.onHold(false));
    this.element.addEventListener("dblclick", () => this.store.set({ range: null }));
    this.element.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const x = event.clientX - this.element.getBoundingClientRect().left - LEFT;
        const centre = this.axis.value(x, this.range, this.width);
        this.store.set({ range: this.axis.zoomed(this.range, centre, event.deltaY > 0 ? 1.25 : 0.8) });
      },
      { passive: false },
    );
  }
}

function opaque(canvas: HTMLCanvasElement, themed: HTMLElement): HTMLCanvasElement {
  const copy = document.createElement("canvas");
  copy.width = canvas.width;
  copy.height = canvas.height;
  const context = copy.getContext("2d");
  if (context) {
    context.fillStyle = getComputedStyle(themed).getPropertyValue("--back") || "#ffffff";
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(canvas, 0, 0);
  }
  return copy;
}
