import type { Column, LabelColumn } from "../src/data/report";

const ARRAYS = { f32: Float32Array, f64: Float64Array, i32: Int32Array, u8: Uint8Array } as const;

export function column(type: Column["type"], values: ArrayLike<number>, width = 1): Column {
  const array = ARRAYS[type].from(values);
  return { type, width, data: Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64") };
}

/** The texts as indices into a table of the different ones; null is -1. */
export function labels(texts: (string | null)[], table: string[] = []): LabelColumn {
  const all = [...table];
  const index = texts.map((text) => {
    if (text === null) return -1;
    const found = all.indexOf(text);
    return found >= 0 ? found : all.push(text) - 1;
  });
  return { table: all, index: column("i32", index) };
}

/** The page with a report in place of its marker, as placegraph writes it. */
export function insertReport(page: string, report: unknown): string {
  const json = JSON.stringify(report).replace(/</g, "\\u003c");
  return page.replace(
    "<!--placegraph-report-->",
    () => `<script id="placegraph-report" type="application/json">${json}</script>`,
  );
}
