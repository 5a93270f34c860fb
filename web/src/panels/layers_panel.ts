/** What the scene shows: check boxes for the layers, colours and sizes. It lies over the scene. */
import type { ReportData, RunData } from "../data/model";
import { availableSeries, series } from "../data/series";
import { toggleFollow } from "../page/actions";
import { button, type Choice, el, select, slider } from "../page/dom";
import { comparable } from "../data/compare";
import { isGood, stageCounts } from "../data/loops";
import { LAYER_KEYS, layerTitle } from "../page/keys";
import { type ColourBy, type Follow, LAYERS, type LayerName, type PointColour, type Store } from "../page/state";
import type { SceneView } from "../scene/scene_view";

export function sceneTools(report: ReportData, store: Store, scene: SceneView): HTMLElement {
  const follow = el(
    "div",
    { class: "tools-part" },
    followButton("Follow", "Follow the camera (H)", "along", store),
    followButton("Through", "Look through the camera (E)", "through", store),
  );
  store.on(["tab"], (state) => (follow.hidden = state.tab === "graph"));
  const tools = el(
    "div",
    { class: "tools" },
    button("Fit", "Show all of the map (F)", () => scene.fit()),
    button("Top", "View from above (V)", () => scene.top()),
  );
  if (report.runs.length > 0) tools.append(follow);
  tools.append(button("PNG", "Save the scene as PNG (S)", () => scene.save()));
  return tools;
}

function followButton(text: string, title: string, follow: Follow, store: Store): HTMLButtonElement {
  const element = button(text, title, () => toggleFollow(store, follow));
  const show = (): void => element.setAttribute("aria-pressed", String(store.state.follow === follow));
  store.on(["follow"], show);
  show();
  return element;
}

export function layersPanel(report: ReportData, store: Store): HTMLDetailsElement {
  const body = el("div", { class: "layers-body" });
  const details = el("details", { class: "layers" }, el("summary", {}, "Layers"), body);
  details.open = window.matchMedia("(min-width: 900px)").matches;
  const draw = (): void => {
    const run = report.runs[store.state.run];
    body.replaceChildren(...controls(report, run, store));
  };
  store.on(["run"], draw);
  store.on(["tab"], (state) => (details.hidden = state.tab === "graph"));
  draw();
  return details;
}

function controls(report: ReportData, run: RunData, store: Store): Node[] {
  const { state } = store;
  const nodes: Node[] = [
    el(
      "label",
      {},
      "Colour by ",
      select("Colour of the trajectory", colourChoices(report, run), state.colourBy, (value) =>
        store.set({ colourBy: value as ColourBy }),
      ),
    ),
  ];
  if (run.components.length > 1) nodes.push(componentChoice(run, store));
  for (const name of LAYERS) if (layerExists(report, run, name)) nodes.push(layerBox(name, run, store));
  if (run.landmarks.count > 0) {
    nodes.push(
      el(
        "label",
        {},
        "Landmarks by ",
        select("Colour of the landmarks", pointChoices(run), state.pointColour, (value) =>
          store.set({ pointColour: value as PointColour }),
        ),
      ),
      slider("Landmark size", 1, 8, 0.5, state.pointSize, (pointSize) => store.set({ pointSize })),
    );
  }
  if (run.keyframes.count > 0)
    nodes.push(slider("Keyframe size", 0.3, 4, 0.1, state.frustumSize, (frustumSize) => store.set({ frustumSize })));
  return nodes;
}

function layerBox(name: LayerName, run: RunData, store: Store): HTMLElement {
  const input = el("input", { type: "checkbox", "data-layer": name });
  const show = (): void => {
    input.checked = store.state.layers[name];
  };
  input.addEventListener("change", () => store.setLayer(name, input.checked));
  store.on(["layers"], show);
  show();
  return el("label", { class: "check" }, input, layerTitle(name, run.loops.judged), el("kbd", {}, LAYER_KEYS[name].toUpperCase()));
}

function componentChoice(run: RunData, store: Store): HTMLElement {
  const choices: Choice[] = run.components.map((c) => ({
    value: String(c.number),
    text: `component ${c.number}${c.main ? " (main)" : ""}`,
  }));
  choices.push({ value: "all", text: "all (their frames differ)" });
  const box = select("Component", choices, String(store.state.component ?? "all"), (value) =>
    store.set({ component: value === "all" ? null : Number(value) }),
  );
  store.on(["component"], (state) => (box.value = String(state.component ?? "all")));
  return el("label", {}, "Show ", box);
}

function colourChoices(report: ReportData, run: RunData): Choice[] {
  const choices = availableSeries(run)
    .filter((name) => name !== "inliers" && name !== "rotation_error")
    .map((name) => ({ value: name as string, text: series(run, name).title.toLowerCase() }));
  if (run.components.length > 1) choices.push({ value: "component", text: "component" });
  if (report.runs.length > 1) choices.push({ value: "run", text: "run" });
  return choices;
}

function pointChoices(run: RunData): Choice[] {
  const choices: Choice[] = [];
  if (run.landmarks.colour) choices.push({ value: "own", text: "own colour" });
  choices.push({ value: "height", text: "height" });
  if (run.landmarks.sigma) choices.push({ value: "uncertainty", text: "uncertainty" });
  return choices;
}

function layerExists(report: ReportData, run: RunData, name: LayerName): boolean {
  switch (name) {
    case "truth":
      return run.frames.truth !== null;
    case "before":
      return run.before !== undefined;
    case "frusta":
      return run.keyframes.count > 0;
    case "images":
      return run.keyframes.thumbnails.some((uri) => uri !== "");
    case "landmarks":
      return run.landmarks.count > 0;
    case "places":
      return run.places.count > 0;
    case "constraints":
      return run.constraints.count > 0;
    case "online":
      return run.frames.online !== null;
    case "loops":
    case "refused":
      return stageCounts(run.loops).some(([stage]) => isGood(stage) === (name === "loops"));
    case "planes":
      return run.planes.length > 0;
    case "street":
      return run.streetMap !== null;
    case "others":
      return report.runs.some((other) => other !== run && comparable(run, other));
    default:
      return true;
  }
}
