/** Decoding of the tables of a run: frames, keyframes, landmarks, places, constraints, loops. */
import type { Values } from "./column";
import { asBoolean, asObject, orNull } from "./fields";
import type {
  ConstraintTable,
  FrameTable,
  KeyframeTable,
  LandmarkTable,
  LoopTable,
  PlaceTable,
  TrackTable,
} from "./model";
import type { FrameSeries } from "./report";
import { readColumn, TableReader } from "./table_reader";

function rowsById(id: Values): Map<number, number> {
  const rows = new Map<number, number>();
  for (let row = 0; row < id.length; row++) rows.set(id[row], row);
  return rows;
}

export function readFrames(value: unknown, where: string, more: FrameSeries[] = []): FrameTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  return {
    count: table.rows,
    id,
    stamp: table.column("stamp_s"),
    component: table.column("component"),
    keyframe: table.column("keyframe"),
    pose: table.column("pose", 7),
    online: table.optional("online", 7),
    truth: table.optional("truth", 7),
    errorM: table.optional("error_m"),
    errorDeg: table.optional("error_deg"),
    sigma: table.optional("sigma_m"),
    confidence: table.optional("confidence"),
    inliers: table.optional("inliers"),
    reason: table.labels("reason"),
    environment: table.optionalLabels("environment"),
    more: more.map(({ column, title, unit }) => ({ title, unit, values: table.column(column) })),
    rowOf: rowsById(id),
  };
}

export function readKeyframes(value: unknown, where: string): KeyframeTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  const frame = table.column("frame");
  return {
    count: table.rows,
    id,
    frame,
    byFrame: Int32Array.from(frame, (_, row) => row).sort((a, b) => frame[a] - frame[b]),
    place: table.column("place"),
    thumbnails: table.texts("thumbnails"),
    tracks: orNull(asObject(value, where)["tracks"], `${where}.tracks`, (v, w) => readTracks(v, w, table.rows)),
    rowOf: rowsById(id),
  };
}

export function readLandmarks(value: unknown, where: string): LandmarkTable {
  const table = new TableReader(value, where, "position", 3);
  return {
    count: table.rows,
    position: table.column("position", 3),
    colour: table.optional("colour", 3),
    sigma: table.optional("sigma_m"),
    keyframe: table.column("keyframe"),
  };
}

export function readPlaces(value: unknown, where: string): PlaceTable {
  const table = new TableReader(value, where, "id");
  const id = table.column("id");
  return {
    count: table.rows,
    id,
    keyframe: table.column("keyframe"),
    component: table.column("component"),
    position: table.column("position", 3),
    rowOf: rowsById(id),
  };
}

export function readConstraints(value: unknown, where: string): ConstraintTable {
  const table = new TableReader(value, where, "from");
  return { count: table.rows, from: table.column("from"), to: table.column("to"), source: table.labels("source") };
}

function readTracks(value: unknown, where: string, keyframes: number): TrackTable {
  const json = asObject(value, where);
  const count = readColumn(json["count"], `${where}.count`, 1, keyframes).values;
  const first = new Int32Array(keyframes + 1);
  for (let k = 0; k < keyframes; k++) first[k + 1] = first[k] + count[k];
  const total = first[keyframes];
  return {
    first,
    landmark: readColumn(json["landmark"], `${where}.landmark`, 1, total).values,
    pixel: readColumn(json["pixel"], `${where}.pixel`, 2, total).values,
  };
}

const NO_LOOPS: LoopTable = {
  count: 0,
  query: new Int32Array(0),
  match: new Int32Array(0),
  probability: null,
  similarity: null,
  inliers: null,
  lines: null,
  stage: { table: [], index: new Int32Array(0) },
  reason: null,
  rank: null,
  judged: false,
};

export function readLoops(value: unknown, where: string): LoopTable {
  if (value === null) return NO_LOOPS;
  const table = new TableReader(value, where, "query_frame");
  return {
    count: table.rows,
    query: table.column("query_frame"),
    match: table.column("match_frame"),
    probability: table.optional("probability"),
    similarity: table.optional("similarity"),
    inliers: table.optional("inliers"),
    lines: table.optional("lines"),
    stage: table.labels("stage"),
    reason: table.optionalLabels("reason"),
    rank: table.optional("rank"),
    judged: asBoolean(asObject(value, where)["judged"], `${where}.judged`),
  };
}
