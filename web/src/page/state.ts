/** What the user has chosen; every view follows it. */
import type { AlignOn } from "../data/compare";
import type { LoopFilter, LoopOrder } from "../data/loops";
import type { SeriesName } from "../data/series";

export const LAYERS = [
  "trajectory",
  "truth",
  "online",
  "before",
  "frusta",
  "images",
  "landmarks",
  "places",
  "constraints",
  "loops",
  "refused",
  "planes",
  "street",
  "others",
  "grid",
] as const;
export type LayerName = (typeof LAYERS)[number];

export const TABS = ["overview", "frame", "loops", "compare", "pictures", "graph"] as const;
export type Tab = (typeof TABS)[number];

export type ColourBy = Exclude<SeriesName, "rotation_error" | "inliers" | `more:${number}`> | "component" | "run";
export type PointColour = "own" | "height" | "uncertainty";
export type GraphShape = "before" | "after" | "both";
/** What the view does when the cursor moves: nothing, move along, or look through the camera. */
export type Follow = "off" | "along" | "through";
export type Theme = "dark" | "light";

export interface State {
  run: number;
  /** Row of the frame under the cursor. */
  row: number;
  /** Row of the selected loop, or -1. */
  loop: number;
  /** Landmark that the pointer is on, by its row, or -1. */
  landmark: number;
  /** Rows of the landmarks that the keyframe under the cursor observes; null where they are unknown. */
  observed: Int32Array | null;
  /** The component that the scene shows; null for all. */
  component: number | null;
  colourBy: ColourBy;
  layers: Record<LayerName, boolean>;
  pointColour: PointColour;
  pointSize: number;
  frustumSize: number;
  loopFilter: LoopFilter;
  loopOrder: LoopOrder;
  playing: boolean;
  rate: number;
  follow: Follow;
  series: SeriesName;
  axis: "frame" | "time";
  /** Part of the axis that the time line shows; null for all. */
  range: [number, number] | null;
  tab: Tab;
  compareWith: number;
  alignOn: AlignOn;
  /** Distance beyond which two runs have parted; null for the default. */
  threshold: number | null;
  graph: number;
  graphShape: GraphShape;
  /** The kind of edges that are shown; null for all. */
  edgeKind: string | null;
  /** Selected edge of the graph, or -1. */
  edge: number;
  theme: Theme;
}

type Listener = (state: Readonly<State>) => void;

export class Store {
  private current: State;
  private readonly listeners: { keys: ReadonlySet<keyof State>; call: Listener }[] = [];

  constructor(initial: State) {
    this.current = initial;
  }

  get state(): Readonly<State> {
    return this.current;
  }

  set(change: Partial<State>): void {
    this.change(change, []);
  }

  /** Changes the state after the data of the run have changed: all that shows the run is drawn again. */
  refresh(change: Partial<State>): void {
    this.change(change, ["run"]);
  }

  private change(change: Partial<State>, also: (keyof State)[]): void {
    const next = { ...this.current, ...change };
    const changed = (Object.keys(change) as (keyof State)[]).filter((key) => next[key] !== this.current[key]);
    changed.push(...also);
    if (changed.length === 0) return;
    this.current = next;
    for (const { keys, call } of this.listeners) if (changed.some((key) => keys.has(key))) call(this.current);
  }

  /** Calls `call` after each change of one of `keys`. */
  on(keys: (keyof State)[], call: Listener): void {
    this.listeners.push({ keys: new Set(keys), call });
  }

  setLayer(name: LayerName, visible: boolean): void {
    this.set({ layers: { ...this.current.layers, [name]: visible } });
  }
}
