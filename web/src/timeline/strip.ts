/** Thumbnails along the axis; only those that are seen are decoded. */
import type { RunData } from "../data/model";
import { keyframeAt } from "../data/run_view";
import { el, isPicture } from "../page/dom";
import type { Axis } from "./axis";

const SLOT = 84;

export class Strip {
  readonly element = el("div", { class: "strip", "aria-hidden": "true" });
  private readonly images: HTMLImageElement[] = [];

  draw(run: RunData, axis: Axis, range: [number, number], width: number): void {
    const some = run.keyframes.thumbnails.some((uri) => uri !== "");
    this.element.hidden = !some;
    const slots = some ? Math.max(1, Math.floor(width / SLOT)) : 0;
    while (this.images.length < slots) {
      const image = el("img", { alt: "", draggable: "false" });
      this.images.push(image);
      this.element.append(image);
    }
    this.images.forEach((image, i) => {
      image.hidden = i >= slots;
      if (i >= slots) return;
      const row = axis.row(axis.value(((i + 0.5) * width) / slots, range, width));
      const uri = run.keyframes.thumbnails[keyframeAt(run, row)];
      const wanted = isPicture(uri) ? uri : "";
      if (image.getAttribute("src") === wanted) return;
      if (wanted === "") image.removeAttribute("src");
      else image.src = wanted;
      image.style.visibility = wanted === "" ? "hidden" : "visible";
    });
  }
}
