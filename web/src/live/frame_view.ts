/** The full image of the frame under the cursor, with what its keyframe observes. Until it has come, or without it, its thumbnail. */
import { categoryColour, cssColour } from "../data/colour_scale";
import { plural } from "../data/format";
import type { RunData } from "../data/model";
import { keyframeAt, keyframeOf } from "../data/run_view";
import { el, isPicture } from "../page/dom";
import type { Store } from "../page/state";
import { CURSOR } from "../scene/cursor_layer";
import { type Observations, frameImage, frameObservations, nearestPoint } from "./frame_files";

/** The last image stays this long while the next is fetched, so that steps do not flicker. */
const PATIENCE_MS = 200;
const HOVER_PX = 10;

interface Wanted {
  run: RunData;
  index: number;
  row: number;
}

export class FrameView {
  readonly element: HTMLElement;
  private readonly canvas = el("canvas", { role: "img" });
  private readonly caption = el("figcaption");
  private readonly note = el("p", { class: "soft" });
  private wanted: Wanted | null = null;
  private shown: Wanted | null = null;
  private bitmap: ImageBitmap | null = null;
  private observations: Observations | null = null;
  private busy = false;
  private timer = 0;

  constructor(private readonly store: Store) {
    this.element = el("figure", { class: "frame-view" }, this.canvas, this.caption, this.note);
    store.on(["landmark"], () => this.draw());
    this.canvas.addEventListener("pointermove", (event) => this.hover(event));
    this.canvas.addEventListener("pointerleave", () => store.set({ landmark: -1 }));
  }

  /** Shows a frame; of several wanted ones in short time only the last is fetched. */
  show(run: RunData, index: number, row: number): void {
    if (this.wanted?.run === run && this.wanted.row === row) return;
    this.wanted = { run, index, row };
    if (this.store.state.observed !== null) queueMicrotask(() => this.store.set({ observed: null, landmark: -1 }));
    window.clearTimeout(this.timer);
    if (this.bitmap === null) this.showThumbnail(this.wanted);
    else this.timer = window.setTimeout(() => this.wanted && this.showThumbnail(this.wanted), PATIENCE_MS);
    if (!this.busy) void this.fetch();
  }

  private async fetch(): Promise<void> {
    this.busy = true;
    while (this.wanted !== null && this.shown !== this.wanted) {
      const wanted = this.wanted;
      const id = wanted.run.frames.id[wanted.row];
      const isKeyframe = keyframeOf(wanted.run, wanted.row) >= 0;
      try {
        const [bitmap, observations] = await Promise.all([
          frameImage(wanted.index, id).then((blob) => createImageBitmap(blob)),
          isKeyframe ? frameObservations(wanted.index, id).catch(reasonOf) : null,
        ]);
        this.take(wanted, bitmap, observations);
      } catch (error) {
        this.shown = wanted;
        if (this.wanted !== wanted) continue;
        window.clearTimeout(this.timer);
        this.showThumbnail(wanted);
        this.note.textContent = `The thumbnail is shown, as the full image is not there: ${reasonOf(error)}`;
      }
    }
    this.busy = false;
  }

  /** `seen`: the observations, why they cannot be had, or nothing for a frame that is no keyframe. */
  private take(wanted: Wanted, bitmap: ImageBitmap, seen: Observations | string | null): void {
    const observations = typeof seen === "string" ? null : seen;
    window.clearTimeout(this.timer);
    this.bitmap?.close();
    this.bitmap = bitmap;
    this.observations = observations;
    this.shown = wanted;
    const id = wanted.run.frames.id[wanted.row];
    const known = observations?.landmark.filter((landmark) => landmark >= 0).length ?? 0;
    const points = observations ? `, ${plural(observations.count, "point")}, ${known} with a landmark` : "";
    this.canvas.setAttribute("aria-label", `Image of frame ${id}`);
    this.element.dataset["image"] = String(id);
    this.caption.textContent = `Frame ${id}, ${bitmap.width} × ${bitmap.height} pixels${points}`;
    if (typeof seen === "string") this.note.textContent = `The points cannot be shown: ${seen}`;
    else this.note.textContent = seen ? "Rest on a point to see its landmark in the scene (○: it has none)." : "";
    if (wanted === this.wanted) this.store.set({ observed: observations?.landmark ?? null, landmark: -1 });
    this.draw();
  }

  private showThumbnail(wanted: Wanted): void {
    const k = keyframeAt(wanted.run, wanted.row);
    const uri = wanted.run.keyframes.thumbnails[k];
    this.bitmap?.close();
    this.bitmap = null;
    this.observations = null;
    delete this.element.dataset["image"];
    this.note.textContent = "";
    this.caption.textContent = k < 0 ? "" : `Keyframe ${wanted.run.keyframes.id[k]}, thumbnail`;
    if (!isPicture(uri)) return;
    const image = new Image();
    image.src = uri;
    image.decode().then(
      () => {
        if (this.wanted !== wanted || this.bitmap !== null) return;
        this.canvas.width = image.naturalWidth;
        this.canvas.height = image.naturalHeight;
        this.canvas.getContext("2d")?.drawImage(image, 0, 0);
        this.canvas.setAttribute("aria-label", this.caption.textContent ?? "");
      },
      () => undefined, // a damaged thumbnail is not shown
    );
  }

  private draw(): void {
    const { bitmap, observations } = this;
    const context = this.canvas.getContext("2d");
    if (!context || bitmap === null) return;
    this.canvas.width = bitmap.width;
    this.canvas.height = bitmap.height;
    context.drawImage(bitmap, 0, 0);
    if (observations) drawObservations(context, observations, this.store.state.landmark, bitmap.width / 400);
  }

  private hover(event: PointerEvent): void {
    if (!this.observations || this.canvas.clientWidth === 0) return;
    const scale = this.canvas.width / this.canvas.clientWidth;
    const at = nearestPoint(this.observations, event.offsetX * scale, event.offsetY * scale, HOVER_PX * scale);
    this.store.set({ landmark: at < 0 ? -1 : this.observations.landmark[at] });
  }
}

function drawObservations(
  context: CanvasRenderingContext2D,
  { pixel, landmark, count }: Observations,
  chosen: number,
  unit: number,
): void {
  const circle = (i: number, radius: number): void => {
    context.beginPath();
    context.arc(pixel[2 * i], pixel[2 * i + 1], radius, 0, 2 * Math.PI);
  };
  context.fillStyle = cssColour(categoryColour(0));
  context.strokeStyle = "rgba(235, 235, 235, 0.8)";
  context.lineWidth = 0.7 * unit;
  for (let i = 0; i < count; i++) {
    circle(i, 1.7 * unit);
    if (landmark[i] >= 0) context.fill();
    else context.stroke();
  }
  const at = chosen >= 0 ? landmark.indexOf(chosen) : -1;
  if (at < 0) return;
  context.strokeStyle = cssColour(CURSOR);
  context.lineWidth = 2 * unit;
  circle(at, 6 * unit);
  context.stroke();
}

function reasonOf(error: unknown): string {
  return error instanceof Error ? error.message : "The fault is unknown.";
}
