/** Reading of unknown JSON: each reader returns the value in its type or throws a plain sentence. */

export type Json = { [key: string]: unknown };

export function asObject(value: unknown, where: string): Json {
  if (typeof value !== "object" || value === null || Array.isArray(value)) {
    throw new Error(`${where} is missing or is no object.`);
  }
  return value as Json;
}

export function asList(value: unknown, where: string): unknown[] {
  if (!Array.isArray(value)) throw new Error(`${where} is missing or is no list.`);
  return value;
}

export function listOf<T>(value: unknown, where: string, read: (item: unknown, where: string) => T): T[] {
  return asList(value, where).map((item, i) => read(item, `${where}[${i}]`));
}

export function asText(value: unknown, where: string): string {
  if (typeof value !== "string") throw new Error(`${where} is missing or is no text.`);
  return value;
}

export function asNumber(value: unknown, where: string): number {
  if (typeof value !== "number") throw new Error(`${where} is missing or is no number.`);
  return value;
}

/** JSON has no NaN: `null` stands for an unknown number. */
export function asNumberOrNaN(value: unknown, where: string): number {
  return value === null ? NaN : asNumber(value, where);
}

export function asBoolean(value: unknown, where: string): boolean {
  if (typeof value !== "boolean") throw new Error(`${where} is missing or is neither true nor false.`);
  return value;
}

export function asOneOf<T extends string>(value: unknown, allowed: readonly T[], where: string): T {
  const found = allowed.find((name) => name === value);
  if (found === undefined) {
    throw new Error(`${where} is ${JSON.stringify(value) ?? "missing"}; it must be one of ${allowed.join(", ")}.`);
  }
  return found;
}

/** Three numbers, such as a direction or a colour. */
export function asThree(value: unknown, where: string): [number, number, number] {
  const list = listOf(value, where, asNumber);
  if (list.length !== 3) throw new Error(`${where} has ${list.length} values; it must have 3.`);
  return [list[0], list[1], list[2]];
}

export function orNull<T>(value: unknown, where: string, read: (value: unknown, where: string) => T): T | null {
  return value === null || value === undefined ? null : read(value, where);
}
