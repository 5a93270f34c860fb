import { decodeReport } from "./decode";
import type { ReportData } from "./model";

/** The report in the page; nothing if the page holds none. */
export function loadReport(from: Document): ReportData | null {
  const text = from.getElementById("placegraph-report")?.textContent?.trim() ?? "";
  if (text === "") return null;
  let json: unknown;
  try {
    json = JSON.parse(text);
  } catch (error) {
    throw new Error(
      `The report in this page is not valid JSON: ${error instanceof Error ? error.message : "unknown fault"}.`,
    );
  }
  return decodeReport(json);
}
