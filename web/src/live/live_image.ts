/** The current image of the run with its tracks and lines, coloured by their residuals. */
import { type Rgb, SCALES, cssColour, scaleColour, shareOf } from "../data/colour_scale";
import { formatNumber, plural } from "../data/format";
import { checkbox, el, isPicture } from "../page/dom";
import { type LiveImage, decodeLiveImage } from "./events";
import { request } from "./http";

/** At most ten pictures a second, and one a second where nothing says that there is a new one. */
const PACE_MS = 100;
const IDLE_MS = 1000;
/** Residuals from here on have the last colour. */
const LARGEST_PX = 3;
const NO_LANDMARK: Rgb = [235, 235, 235];

export class LiveImageView {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { role: "img", "aria-label": "Current image" });
  private readonly caption = el("figcaption", {}, "The first image has not come yet.");
  private shown: { image: LiveImage; bitmap: HTMLImageElement } | null = null;
  private points = true;
  private lines = true;
  private busy = false;
  private again = false;
  private closed = false;
  private timer = 0;

  constructor() {
    const redraw = (): void => this.draw();
    this.element = el(
      "figure",
      { class: "live-image" },
      this.canvas,
      this.caption,
      el(
        "div",
        { class: "row" },
        checkbox("Points", true, (on) => ((this.points = on), redraw())),
        checkbox("Lines", true, (on) => ((this.lines = on), redraw())),
        residualLegend(),
      ),
    );
    document.addEventListener("visibilitychange", () => this.wake());
  }

  /** A new image may be there: it is fetched when the last one is drawn. */
  wake(): void {
    if (this.closed || document.hidden) return;
    if (this.busy) this.again = true;
    else void this.next();
  }

  /** Width over height of the images; that of a common camera before the first. */
  get aspect(): number {
    return this.shown ? this.shown.image.width / this.shown.image.height : 1.5;
  }

  close(): void {
    this.closed = true;
    window.clearTimeout(this.timer);
  }

  private async next(): Promise<void> {
    this.busy = true;
    this.again = false;
    window.clearTimeout(this.timer);
    const begin = performance.now();
    try {
      const response = await request("live/image.json");
      if (response.status !== 204) await this.take(decodeLiveImage(await response.json()));
    } catch (error) {
      this.caption.textContent = error instanceof Error ? error.message : "The image cannot be shown.";
    }
    window.setTimeout(
      () => {
        this.busy = false;
        if (this.again) this.wake();
        else this.timer = window.setTimeout(() => this.wake(), IDLE_MS);
      },
      Math.max(0, PACE_MS - (performance.now() - begin)),
    );
  }

  private async take(image: LiveImage): Promise<void> {
    if (!isPicture(image.image)) throw new Error("The current image is no JPEG, PNG or WebP picture.");
    const bitmap = new Image();
    bitmap.src = image.image;
    await bitmap.decode();
    this.shown = { image, bitmap };
    this.draw();
    this.caption.textContent = captionOf(image);
    this.element.dataset["frame"] = String(image.frame);
  }

  private draw(): void {
    const context = this.canvas.getContext("2d");
    if (!context || !this.shown) return;
    const { image, bitmap } = this.shown;
    if (this.canvas.width !== image.width) this.canvas.width = image.width;
    if (this.canvas.height !== image.height) this.canvas.height = image.height;
    context.drawImage(bitmap, 0, 0, image.width, image.height);
    const unit = image.width / 640;
    if (this.lines) drawSegments(context, image, 1.6 * unit);
    if (this.points) drawPoints(context, image, 2.6 * unit);
  }
}

function residualColour(residual: number): string {
  return cssColour(Number.isNaN(residual) ? NO_LANDMARK : scaleColour("residual", shareOf(residual, [0, LARGEST_PX])));
}

function drawPoints(context: CanvasRenderingContext2D, { points, pointCount }: LiveImage, radius: number): void {
  context.lineWidth = radius / 2;
  for (let i = 0; i < pointCount; i++) {
    const residual = points[3 * i + 2];
    context.fillStyle = context.strokeStyle = residualColour(residual);
    context.beginPath();
    context.arc(points[3 * i], points[3 * i + 1], radius, 0, 2 * Math.PI);
    // A point without a landmark is open, so that it is known without its colour.
    if (Number.isNaN(residual)) context.stroke();
    else context.fill();
  }
}

function drawSegments(context: CanvasRenderingContext2D, { lines, lineCount }: LiveImage, width: number): void {
  context.lineWidth = width;
  for (let i = 0; i < lineCount; i++) {
    context.strokeStyle = residualColour(lines[5 * i + 4]);
    context.setLineDash(Number.isNaN(lines[5 * i + 4]) ? [3 * width, 2 * width] : []);
    context.beginPath();
    context.moveTo(lines[5 * i], lines[5 * i + 1]);
    context.lineTo(lines[5 * i + 2], lines[5 * i + 3]);
    context.stroke();
  }
  context.setLineDash([]);
}

function captionOf(image: LiveImage): string {
  const residuals: number[] = [];
  for (let i = 0; i < image.pointCount; i++) {
    if (Number.isFinite(image.points[3 * i + 2])) residuals.push(image.points[3 * i + 2]);
  }
  residuals.sort((a, b) => a - b);
  const median = residuals[residuals.length >> 1];
  const parts = [`Frame ${image.frame}: ${plural(image.pointCount, "point")}, ${residuals.length} with a landmark`];
  if (image.lineCount > 0) parts.push(plural(image.lineCount, "line"));
  if (median !== undefined) parts.push(`median residual ${formatNumber(median, 2)} px`);
  return parts.join(", ");
}

function residualLegend(): HTMLElement {
  const bar = el("span", { class: "residual-bar" });
  bar.style.background = `linear-gradient(to right, ${SCALES.residual.map((c) => cssColour(c)).join(", ")})`;
  return el(
    "span",
    { class: "entry", title: "Distance between a feature and the projection of its landmark; open: no landmark yet" },
    "residual 0",
    bar,
    `≥ ${LARGEST_PX} px, ○ no landmark yet`,
  );
}
