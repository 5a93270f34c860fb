import { type Numbers, type Values, decodeColumn } from "./column";
import { type Json, asNumber, asObject, asOneOf, asText, listOf } from "./fields";
import type { Labels } from "./model";
import type { Column } from "./report";

/** The column `value` with rows of `width` values; `rows` of them unless it is undefined. */
export function readColumn(value: unknown, where: string, width: number, rows?: number): Numbers {
  const json = asObject(value, where);
  const column: Column = {
    type: asOneOf(json["type"], ["f32", "f64", "i32", "u8"] as const, `${where}.type`),
    width: asNumber(json["width"], `${where}.width`),
    data: asText(json["data"], `${where}.data`),
  };
  if (column.width !== width) {
    throw new Error(`${where} has ${column.width} values a row; it must have ${width}.`);
  }
  const numbers = decodeColumn(column, where);
  if (rows !== undefined && numbers.rows !== rows) {
    throw new Error(`${where} has ${numbers.rows} rows; it must have ${rows}.`);
  }
  return numbers;
}

/** Reads the columns of one table, which all have the same number of rows. */
export class TableReader {
  private readonly json: Json;
  private readonly where: string;
  readonly rows: number;

  /** `first` is the column, of `width` values a row, that says how many rows there are. */
  constructor(value: unknown, where: string, first: string, width = 1) {
    this.json = asObject(value, where);
    this.where = where;
    this.rows = readColumn(this.json[first], `${where}.${first}`, width).rows;
  }

  column(name: string, width = 1): Values {
    return readColumn(this.json[name], `${this.where}.${name}`, width, this.rows).values;
  }

  optional(name: string, width = 1): Values | null {
    return this.json[name] === null || this.json[name] === undefined ? null : this.column(name, width);
  }

  labels(name: string): Labels {
    const where = `${this.where}.${name}`;
    const json = asObject(this.json[name], where);
    return {
      table: listOf(json["table"], `${where}.table`, asText),
      index: readColumn(json["index"], `${where}.index`, 1, this.rows).values,
    };
  }

  optionalLabels(name: string): Labels | null {
    return this.json[name] === null || this.json[name] === undefined ? null : this.labels(name);
  }

  texts(name: string): string[] {
    const where = `${this.where}.${name}`;
    const list = listOf(this.json[name], where, asText);
    if (list.length !== this.rows) {
      throw new Error(`${where} has ${list.length} rows; it must have ${this.rows}.`);
    }
    return list;
  }
}
