import type { Column } from "./report";

export type Values = Float32Array | Float64Array | Int32Array | Uint8Array;

/** A decoded column of `rows` rows with `width` values each. */
export interface Numbers {
  values: Values;
  width: number;
  rows: number;
}

const BYTES: Record<Column["type"], number> = { f32: 4, f64: 8, i32: 4, u8: 1 };

export function bytesFromBase64(text: string): Uint8Array<ArrayBuffer> {
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < binary.length; i++) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

/** The values of a column. Throws an error with a plain sentence that begins with `where`. */
export function decodeColumn(column: Column, where: string): Numbers {
  let bytes: Uint8Array<ArrayBuffer>;
  try {
    bytes = bytesFromBase64(column.data);
  } catch {
    throw new Error(`${where} is not valid base64.`);
  }
  const rowBytes = BYTES[column.type] * column.width;
  if (bytes.length % rowBytes !== 0) {
    throw new Error(`${where} has ${bytes.length} bytes, which is no multiple of ${rowBytes} bytes a row.`);
  }
  return { values: typed(bytes.buffer, column.type), width: column.width, rows: bytes.length / rowBytes };
}

function typed(buffer: ArrayBuffer, type: Column["type"]): Values {
  switch (type) {
    case "f32":
      return new Float32Array(buffer);
    case "f64":
      return new Float64Array(buffer);
    case "i32":
      return new Int32Array(buffer);
    case "u8":
      return new Uint8Array(buffer);
  }
}
