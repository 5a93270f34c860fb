import { button, el } from "./dom";
import type { KeyBinding } from "./keys";

const MOUSE =
  "In the scene, drag with the left button to rotate, with the right button to pan, and use the wheel to zoom. ";

export const REPORT_MOUSE =
  `${MOUSE}Click a pose or a loop to select it; double-click a pose to rotate about it. ` +
  "In the time line, drag to move the cursor, use the wheel to zoom, double-click to see all of it.";

export const LIVE_MOUSE = `${MOUSE}The view then stays where it is until you choose to show all of the map or to follow the camera.`;

export function helpDialog(mouse: string): {
  element: HTMLDialogElement;
  fill: (list: KeyBinding[]) => void;
  toggle: () => void;
} {
  const body = el("div", { class: "keys" });
  const element = el("dialog", { class: "help", "aria-label": "Help" });
  element.append(
    el(
      "div",
      { class: "row" },
      el("h2", {}, "Keys and mouse"),
      el("span", { class: "gap" }),
      button("Close", "Close the help", () => element.close()),
    ),
    el("p", {}, mouse),
    body,
  );
  element.addEventListener("click", (event) => {
    if (event.target === element) element.close();
  });
  return {
    element,
    fill: (list) =>
      body.replaceChildren(...list.map((binding) => el("div", {}, el("kbd", {}, binding.shown), ` ${binding.text}`))),
    toggle: () => (element.open ? element.close() : element.showModal()),
  };
}
