/** Keys of the page and what they do; the help lists the same table. */
import type { ReportData } from "../data/model";
import type { SceneView } from "../scene/scene_view";
import { moveCursor, moveToKeyframe, moveToLoop, toggleFollow } from "./actions";
import { type LayerName, type Store, TABS } from "./state";

export interface KeyBinding {
  keys: string[];
  shown: string;
  text: string;
  run(event: KeyboardEvent): void;
}

export const LAYER_KEYS: Record<LayerName, string> = {
  trajectory: "j",
  truth: "t",
  online: "o",
  before: "b",
  frusta: "k",
  images: "i",
  landmarks: "m",
  places: "p",
  constraints: "c",
  loops: "l",
  refused: "r",
  planes: "n",
  street: "w",
  others: "u",
  grid: "g",
};

export const LAYER_TITLES: Record<LayerName, string> = {
  trajectory: "Trajectory",
  truth: "Ground truth",
  online: "Online trajectory",
  before: "Before the last edit",
  frusta: "Keyframes",
  images: "Images of keyframes",
  landmarks: "Landmarks",
  places: "Places",
  constraints: "Constraints of places",
  loops: "Loops accepted",
  refused: "Loops refused",
  planes: "Planes",
  street: "Street map",
  others: "Other runs",
  grid: "Grid",
};

/** The title of a layer for a run: loops that were compared with ground truth are right or not. */
export function layerTitle(name: LayerName, judged: boolean): string {
  if (judged && name === "loops") return "Loops right";
  if (judged && name === "refused") return "Loops wrong or missed";
  return LAYER_TITLES[name];
}

export function bindings(
  report: ReportData,
  store: Store,
  scene: SceneView | null,
  toggleHelp: () => void,
  toggleTheme: () => void,
): KeyBinding[] {
  const step = (event: KeyboardEvent): number => (event.shiftKey ? 10 : 1);
  const end = (): number => (report.runs[store.state.run]?.frames.count ?? 1) - 1;
  const list: KeyBinding[] = [
    {
      keys: [" "],
      shown: "Space",
      text: "Play or pause",
      run: () => store.set({ playing: !store.state.playing && report.runs.length > 0 }),
    },
    {
      keys: ["ArrowLeft"],
      shown: "←",
      text: "One frame back (with Shift: ten)",
      run: (e) => moveCursor(report, store, -step(e)),
    },
    {
      keys: ["ArrowRight"],
      shown: "→",
      text: "One frame on (with Shift: ten)",
      run: (e) => moveCursor(report, store, step(e)),
    },
    { keys: ["["], shown: "[", text: "Previous keyframe", run: () => moveToKeyframe(report, store, -1) },
    { keys: ["]"], shown: "]", text: "Next keyframe", run: () => moveToKeyframe(report, store, 1) },
    { keys: [","], shown: ",", text: "Previous loop", run: () => moveToLoop(report, store, -1) },
    { keys: ["."], shown: ".", text: "Next loop", run: () => moveToLoop(report, store, 1) },
    { keys: ["Home"], shown: "Home", text: "First frame", run: () => moveCursor(report, store, -end()) },
    { keys: ["End"], shown: "End", text: "Last frame", run: () => moveCursor(report, store, end()) },
    { keys: ["f"], shown: "F", text: "Show all of the map", run: () => scene?.fit() },
    { keys: ["v"], shown: "V", text: "View from above", run: () => scene?.top() },
    { keys: ["h"], shown: "H", text: "Follow the camera", run: () => toggleFollow(store, "along") },
    { keys: ["e"], shown: "E", text: "Look through the camera", run: () => toggleFollow(store, "through") },
    { keys: ["s"], shown: "S", text: "Save the scene as PNG", run: () => scene?.save() },
    { keys: ["d"], shown: "D", text: "Dark or light", run: toggleTheme },
    { keys: ["?"], shown: "?", text: "This help", run: toggleHelp },
  ];
  return [...list, ...layerBindings(store), ...tabBindings()];
}

function layerBindings(store: Store): KeyBinding[] {
  return (Object.entries(LAYER_KEYS) as [LayerName, string][]).map(([name, key]) => ({
    keys: [key],
    shown: key.toUpperCase(),
    text: `Layer: ${LAYER_TITLES[name].toLowerCase()}`,
    run: () => store.setLayer(name, !store.state.layers[name]),
  }));
}

function tabBindings(): KeyBinding[] {
  return TABS.map((tab, i) => ({
    keys: [String(i + 1)],
    shown: String(i + 1),
    text: `Panel: ${tab}`,
    run: () => document.getElementById(`tab-${tab}`)?.click(),
  }));
}

/** Whether an element uses the keys itself. */
function takesKeys(target: EventTarget | null, key: string): boolean {
  if (!(target instanceof HTMLElement)) return false;
  if (target.closest("dialog") !== null && key !== "?") return true;
  if (target instanceof HTMLInputElement) return target.type !== "checkbox" || key === " ";
  if (target instanceof HTMLSelectElement) return true;
  return (key === " " || key === "Enter") && target.closest("button, summary, a") !== null;
}

/** Returns what ends it. */
export function watchKeys(list: KeyBinding[]): () => void {
  const byKey = new Map(list.flatMap((binding) => binding.keys.map((key) => [key, binding] as const)));
  const listener = (event: KeyboardEvent): void => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const binding = byKey.get(key);
    if (!binding || takesKeys(event.target, key)) return;
    event.preventDefault();
    binding.run(event);
  };
  document.addEventListener("keydown", listener);
  return () => document.removeEventListener("keydown", listener);
}
