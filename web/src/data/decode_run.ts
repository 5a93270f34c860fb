import { type Json, asBoolean, asNumber, asObject, asOneOf, asText, asThree, listOf, orNull } from "./fields";
import { readFigure, readPicture, readTable } from "./figures";
import { readGeoreference, readPlane, readPlanLine, readStreetMap } from "./decode_shapes";
import {
  readConstraints,
  readFrames,
  readKeyframes,
  readLandmarks,
  readLoops,
  readPlaces,
} from "./decode_tables";
import type { RunData } from "./model";
import type { Camera, Component, Finding, FrameSeries, Judgement, Option, Summary } from "./report";

export function decodeRun(value: unknown, where: string): RunData {
  const json = asObject(value, where);
  const at = (name: string): string => `${where}.${name}`;
  const more = orNull(json["frame_series"], at("frame_series"), (v, w) => listOf(v, w, readFrameSeries)) ?? [];
  const frames = readFrames(json["frames"], at("frames"), more);
  return {
    name: asText(json["name"], at("name")),
    folder: asText(json["folder"], at("folder")),
    recording: asText(json["recording"], at("recording")),
    sensor: orNull(json["sensor"], at("sensor"), (v, w) => asOneOf(v, ["mono", "stereo", "rgbd"] as const, w)),
    metric: asBoolean(json["metric"], at("metric")),
    aligned: orNull(json["aligned"], at("aligned"), asText),
    up: orNull(json["up"], at("up"), asThree),
    summary: readSummary(json["summary"], at("summary")),
    judgement: orNull(json["judgement"], at("judgement"), readJudgement),
    notes: listOf(json["notes"], at("notes"), asText),
    options: orNull(json["options"], at("options"), (v, w) => listOf(v, w, readOption)),
    figures: listOf(json["figures"], at("figures"), readFigure),
    tables: listOf(json["tables"], at("tables"), readTable),
    camera: orNull(json["camera"], at("camera"), readCamera),
    components: listOf(json["components"], at("components"), readComponent),
    frames,
    keyframes: readKeyframes(json["keyframes"], at("keyframes")),
    landmarks: readLandmarks(json["landmarks"], at("landmarks")),
    places: readPlaces(json["places"], at("places")),
    constraints: readConstraints(json["constraints"], at("constraints")),
    loops: readLoops(json["loops"], at("loops")),
    planes: listOf(json["planes"], at("planes"), readPlane),
    floorPlan: listOf(json["floor_plan"], at("floor_plan"), readPlanLine),
    streetMap: orNull(json["street_map"], at("street_map"), readStreetMap),
    georeference: orNull(json["georeference"], at("georeference"), (v, w) => readGeoreference(v, w, frames.count)),
    pictures: listOf(json["pictures"], at("pictures"), readPicture),
  };
}

function numbersOf<K extends string>(json: Json, where: string, names: readonly K[]): Record<K, number> {
  const result = {} as Record<K, number>;
  for (const name of names) result[name] = asNumber(json[name], `${where}.${name}`);
  return result;
}

function readFrameSeries(value: unknown, where: string): FrameSeries {
  const json = asObject(value, where);
  return {
    column: asText(json["column"], `${where}.column`),
    title: asText(json["title"], `${where}.title`),
    unit: asText(json["unit"], `${where}.unit`),
  };
}

function readSummary(value: unknown, where: string): Summary {
  const json = asObject(value, where);
  const count = (name: string): number | null => orNull(json[name], `${where}.${name}`, asNumber);
  return {
    ...numbersOf(json, where, ["frames", "posed"] as const),
    keyframes: count("keyframes"),
    places: count("places"),
    landmarks: count("landmarks"),
    loops_accepted: count("loops_accepted"),
    cpu_s: count("cpu_s"),
    wall_s: count("wall_s"),
    path_length: count("path_length"),
  };
}

function readJudgement(value: unknown, where: string): Judgement {
  const json = asObject(value, where);
  return {
    verdict: asOneOf(json["verdict"], ["good", "doubtful", "failed"] as const, `${where}.verdict`),
    metric: asBoolean(json["metric"], `${where}.metric`),
    why_metric: asText(json["why_metric"], `${where}.why_metric`),
    expected_drift_m: orNull(json["expected_drift_m"], `${where}.expected_drift_m`, asNumber),
    findings: listOf(json["findings"], `${where}.findings`, readFinding),
  };
}

function readFinding(value: unknown, where: string): Finding {
  const json = asObject(value, where);
  return {
    cause: asText(json["cause"], `${where}.cause`),
    text: asText(json["text"], `${where}.text`),
    advice: asText(json["advice"], `${where}.advice`),
  };
}

function readOption(value: unknown, where: string): Option {
  const json = asObject(value, where);
  return {
    name: asText(json["name"], `${where}.name`),
    value: asText(json["value"], `${where}.value`),
    default_value: asText(json["default_value"], `${where}.default_value`),
  };
}

function readCamera(value: unknown, where: string): Camera {
  return numbersOf(asObject(value, where), where, ["width", "height", "fx", "fy", "cx", "cy"] as const);
}

function readComponent(value: unknown, where: string): Component {
  const json = asObject(value, where);
  return {
    ...numbersOf(json, where, ["number", "first", "last", "posed"] as const),
    main: asBoolean(json["main"], `${where}.main`),
  };
}

