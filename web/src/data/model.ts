/** The decoded report: what the page works with. */
import type { Values } from "./column";
import type {
  Camera,
  Column,
  Component,
  Constraints,
  Figure,
  Georeference,
  Judgement,
  LabelColumn,
  Option,
  Picture,
  Places,
  Plane,
  PlanLine,
  Sensor,
  StreetMap,
  Summary,
  Table,
} from "./report";

export interface Labels {
  table: string[];
  index: Values;
}

/** A type of the report in which columns are decoded. */
export type Decoded<T> = T extends Column
  ? Values
  : T extends LabelColumn
    ? Labels
    : T extends readonly unknown[]
      ? { [K in keyof T]: Decoded<T[K]> }
      : T extends object
        ? { [K in keyof T]: Decoded<T[K]> }
        : T;

export type PlaneShape = Decoded<Plane>;
export type PlanShape = Decoded<PlanLine>;
export type StreetShape = Decoded<StreetMap>;
export type GeoTrack = Decoded<Georeference>;
export type ConstraintTable = Decoded<Constraints> & { count: number };
export type PlaceTable = Decoded<Places> & { count: number; rowOf: Map<number, number> };

export interface FrameTable {
  count: number;
  id: Values;
  stamp: Values;
  component: Values;
  keyframe: Values;
  pose: Values;
  online: Values | null;
  truth: Values | null;
  errorM: Values | null;
  errorDeg: Values | null;
  sigma: Values | null;
  confidence: Values | null;
  inliers: Values | null;
  reason: Labels;
  environment: Labels | null;
  /** Further series that the report names. */
  more: { title: string; unit: string; values: Values }[];
  /** The row of a frame id. */
  rowOf: Map<number, number>;
}

export interface KeyframeTable {
  count: number;
  id: Values;
  frame: Values;
  place: Values;
  thumbnails: string[];
  tracks: TrackTable | null;
  rowOf: Map<number, number>;
  /** Rows in the order of their frames. */
  byFrame: Int32Array;
}

export interface TrackTable {
  /** The rows of keyframe k are `first[k]` to `first[k + 1]`, without that. */
  first: Int32Array;
  landmark: Values;
  pixel: Values;
}

export interface LandmarkTable {
  count: number;
  position: Values;
  colour: Values | null;
  sigma: Values | null;
  keyframe: Values;
}

export interface LoopTable {
  count: number;
  query: Values;
  match: Values;
  probability: Values | null;
  similarity: Values | null;
  inliers: Values | null;
  lines: Values | null;
  stage: Labels;
  reason: Labels | null;
  rank: Values | null;
  judged: boolean;
}

export interface RunData {
  name: string;
  folder: string;
  recording: string;
  sensor: Sensor | null;
  metric: boolean;
  aligned: string | null;
  up: [number, number, number] | null;
  summary: Summary;
  judgement: Judgement | null;
  notes: string[];
  options: Option[] | null;
  figures: Figure[];
  tables: Table[];
  camera: Camera | null;
  components: Component[];
  frames: FrameTable;
  keyframes: KeyframeTable;
  landmarks: LandmarkTable;
  places: PlaceTable;
  constraints: ConstraintTable;
  loops: LoopTable;
  planes: PlaneShape[];
  floorPlan: PlanShape[];
  streetMap: StreetShape | null;
  georeference: GeoTrack | null;
  pictures: Picture[];
  /** Poses of the frames before the last edit in this page, if it has moved them. */
  before?: Values;
}

export interface GraphData {
  name: string;
  nodes: number;
  before: Values;
  after: Values | null;
  edgeCount: number;
  edges: Values;
  /** Numbers of nodes and edges of the whole graph, of which the page may have some. */
  allNodes: number;
  allEdges: number;
  /** The indices of the ends of the edges in the whole graph. */
  ends: Values;
  kind: Labels;
  chi2: Values;
  weight: Values | null;
  figures: Figure[];
}

export interface ReportData {
  program: string;
  title: string;
  runs: RunData[];
  pictures: Picture[];
  tables: Table[];
  graphs: GraphData[];
}

export function label(labels: Labels, row: number): string | null {
  const index = labels.index[row];
  return index >= 0 ? (labels.table[index] ?? null) : null;
}
