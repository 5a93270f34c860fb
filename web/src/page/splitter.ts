/** The border between the scene and the side panel, which the pointer or the arrow keys move. */
import { el } from "./dom";

const STEP = 20;

export function splitter(page: HTMLElement): HTMLElement {
  const element = el("div", {
    class: "splitter",
    role: "separator",
    tabindex: "0",
    "aria-orientation": "vertical",
    "aria-label": "Width of the panel",
  });
  let width = 400;
  const set = (wanted: number): void => {
    width = Math.min(Math.max(wanted, 280), Math.max(page.clientWidth - 360, 280));
    page.style.setProperty("--panel", `${width}px`);
    element.setAttribute("aria-valuenow", String(Math.round(width)));
  };
  element.addEventListener("pointerdown", (event) => element.setPointerCapture(event.pointerId));
  element.addEventListener("pointermove", (event) => {
    if (element.hasPointerCapture(event.pointerId)) set(page.getBoundingClientRect().right - event.clientX);
  });
  element.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
    event.stopPropagation();
    set(width + (event.key === "ArrowLeft" ? STEP : -STEP));
  });
  element.setAttribute("aria-valuenow", String(width));
  return element;
}
