import { asNumberOrNaN, asObject, asText } from "./fields";
import type { Figure, Picture } from "./report";

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
