import { button, el } from "./dom";
import type { KeyBinding } from "./keys";

export function helpDialog(): { element: HTMLDialogElement; fill: (list: KeyBinding[]) => void; toggle: () => void } {
  const body = el("tbody");
  const element = el("dialog", { class: "help", "aria-label": "Help" });
  element.append(
    el("h2", {}, "Keys and mouse"),
    el("p", {}, "In the scene, drag with the left button to rotate, with the right button to pan, and use the wheel to zoom. "
      + "Click a pose or a loop to select it; double-click a pose to rotate about it. "
      + "In the time line, drag to move the cursor, use the wheel to zoom, double-click to see all of it."),
    el("table", {}, body),
    button("Close", "Close the help", () => element.close()));
  element.addEventListener("click", (event) => {
    if (event.target === element) element.close();
  });
  return {
    element,
    fill: (list) => body.replaceChildren(...list.map((binding) =>
      el("tr", {}, el("td", {}, el("kbd", {}, binding.shown)), el("td", {}, binding.text)))),
    toggle: () => (element.open ? element.close() : element.showModal()),
  };
}
