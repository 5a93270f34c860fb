/** Decoding of what lies beside a map: planes, plans, the street map, the position on the earth. */
import { asBoolean, asNumber, asNumberOrNaN, asObject, asText, asThree, listOf, orNull } from "./fields";
import type { GeoTrack, PlaneShape, PlanShape, StreetShape } from "./model";
import { readColumn } from "./table_reader";

export function readPlane(value: unknown, where: string): PlaneShape {
  const json = asObject(value, where);
  return {
    name: asText(json["name"], `${where}.name`),
    rgb: asThree(json["rgb"], `${where}.rgb`),
    outline: readColumn(json["outline"], `${where}.outline`, 3).values,
    holes: listOf(json["holes"], `${where}.holes`, (v, w) => readColumn(v, w, 3).values),
  };
}

export function readPlanLine(value: unknown, where: string): PlanShape {
  const json = asObject(value, where);
  return {
    label: asText(json["label"], `${where}.label`),
    closed: asBoolean(json["closed"], `${where}.closed`),
    points: readColumn(json["points"], `${where}.points`, 2).values,
  };
}

export function readStreetMap(value: unknown, where: string): StreetShape {
  const json = asObject(value, where);
  const at = (name: string): string => `${where}.${name}`;
  const low = listOf(json["low_m"], at("low_m"), asNumber);
  if (low.length !== 2) throw new Error(`${where}.low_m has ${low.length} values; it must have 2.`);
  const columns = asNumber(json["columns"], at("columns"));
  const rows = asNumber(json["rows"], at("rows"));
  return {
    image: asText(json["image"], at("image")),
    width: asNumber(json["width"], at("width")),
    height: asNumber(json["height"], at("height")),
    cell_m: asNumber(json["cell_m"], at("cell_m")),
    low_m: [low[0], low[1]],
    R_plan_map: readColumn(json["R_plan_map"], at("R_plan_map"), 3, 3).values,
    columns,
    rows,
    ground: readColumn(json["ground"], at("ground"), 3, (columns + 1) * (rows + 1)).values,
    classes: listOf(json["classes"], at("classes"), (v, w) => ({
      name: asText(asObject(v, w)["name"], `${w}.name`),
      rgb: asThree(asObject(v, w)["rgb"], `${w}.rgb`),
      area_m2: asNumber(asObject(v, w)["area_m2"], `${w}.area_m2`),
    })),
  };
}

export function readGeoreference(value: unknown, where: string, frames: number): GeoTrack {
  const json = asObject(value, where);
  return {
    latitude_deg: asNumberOrNaN(json["latitude_deg"], `${where}.latitude_deg`),
    longitude_deg: asNumberOrNaN(json["longitude_deg"], `${where}.longitude_deg`),
    folder: asText(json["folder"], `${where}.folder`),
    fixes_used: orNull(json["fixes_used"], `${where}.fixes_used`, asNumber),
    fixes_rejected: orNull(json["fixes_rejected"], `${where}.fixes_rejected`, asNumber),
    residual_rms_m: orNull(json["residual_rms_m"], `${where}.residual_rms_m`, asNumber),
    track: readColumn(json["track"], `${where}.track`, 3, frames).values,
  };
}
