/** The pointer over the scene: a click chooses a frame or a loop, resting on a frame shows it. */
import { formatTime } from "../data/format";
import type { ReportData } from "../data/model";
import { loopSelection } from "../page/actions";
import { keyframeAt } from "../data/run_view";
import { el, isPicture } from "../page/dom";
import type { Store } from "../page/state";
import type { SceneView } from "./scene_view";

const FRAME_RADIUS = 12;

export function watchPointer(view: SceneView, report: ReportData, store: Store): void {
  const { canvas } = view.viewport;
  const tip = el("div", { class: "tip", role: "tooltip" });
  tip.hidden = true;
  view.element.append(tip);
  let down = { x: 0, y: 0 };
  canvas.addEventListener("pointerdown", (event) => {
    down = { x: event.clientX, y: event.clientY };
    tip.hidden = true;
  });
  canvas.addEventListener("click", (event) => {
    if (Math.hypot(event.clientX - down.x, event.clientY - down.y) > 4) return;
    const loop = view.loopAt(event.offsetX, event.offsetY);
    const row = view.frameAt(event.offsetX, event.offsetY, FRAME_RADIUS);
    if (row >= 0) store.set({ row, playing: false });
    else if (loop >= 0) store.set({ ...loopSelection(report, store.state, loop), tab: "loops" });
  });
  canvas.addEventListener("dblclick", (event) => {
    const row = view.frameAt(event.offsetX, event.offsetY, FRAME_RADIUS);
    if (row >= 0) view.lookAtFrame(row);
  });
  let pending = false;
  canvas.addEventListener("pointermove", (event) => {
    if (event.buttons !== 0 || event.pointerType === "touch" || pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      store.set({ landmark: view.landmarkAt(event.offsetX, event.offsetY) });
      showTip(tip, report, store, view.frameAt(event.offsetX, event.offsetY, FRAME_RADIUS), event);
    });
  });
  canvas.addEventListener("pointerleave", () => {
    tip.hidden = true;
    store.set({ landmark: -1 });
  });
}

function showTip(tip: HTMLElement, report: ReportData, store: Store, row: number, event: MouseEvent): void {
  tip.hidden = row < 0;
  if (row < 0) return;
  const run = report.runs[store.state.run];
  const { id, stamp } = run.frames;
  const keyframe = keyframeAt(run, row);
  const uri = run.keyframes.thumbnails[keyframe];
  tip.replaceChildren(el("div", {}, `Frame ${id[row]}, ${formatTime(stamp[row] - stamp[0])}`));
  if (keyframe >= 0) tip.append(el("div", {}, `Keyframe ${run.keyframes.id[keyframe]}`));
  if (isPicture(uri)) tip.append(el("img", { src: uri, alt: `Image of keyframe ${run.keyframes.id[keyframe]}` }));
  const width = tip.parentElement?.clientWidth ?? 0;
  tip.style.left = `${Math.min(event.offsetX + 14, Math.max(width - 180, 0))}px`;
  tip.style.top = `${event.offsetY + 14}px`;
}
