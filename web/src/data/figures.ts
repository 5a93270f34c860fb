import { asNumberOrNaN, asObject, asText, listOf } from "./fields";
import type { Figure, Picture, Table } from "./report";

export function readFigure(value: unknown, where: string): Figure {
  const json = asObject(value, where);
  return {
    name: asText(json["name"], `${where}.name`),
    value: asNumberOrNaN(json["value"], `${where}.value`),
    unit: asText(json["unit"], `${where}.unit`),
    protocol: asText(json["protocol"], `${where}.protocol`),
  };
}

export function readPicture(value: unknown, where: string): Picture {
  const json = asObject(value, where);
  return {
    title: asText(json["title"], `${where}.title`),
    caption: asText(json["caption"], `${where}.caption`),
    svg: asText(json["svg"], `${where}.svg`),
  };
}

export function readTable(value: unknown, where: string): Table {
  const json = asObject(value, where);
  const columns = listOf(json["columns"], `${where}.columns`, asText);
  const rows = listOf(json["rows"], `${where}.rows`, (row, at) => listOf(row, at, asText));
  const odd = rows.findIndex((row) => row.length !== columns.length);
  if (odd >= 0) throw new Error(`${where}.rows[${odd}] has ${rows[odd].length} cells; it must have ${columns.length}.`);
  return {
    title: asText(json["title"], `${where}.title`),
    protocol: asText(json["protocol"], `${where}.protocol`),
    columns,
    rows,
  };
}
