import { asBoolean, asObject, asOneOf, asText } from "../data/fields";

/** What a served page says of its server: `placegraph view` (a saved map) or `run --view` (a run that goes on). */
export interface LiveStart {
  kind: "view" | "run";
  program: string;
  title: string;
  /** Whether loops can be edited. */
  editable: boolean;
}

/** Nothing if the page is no served one. */
export function readLiveStart(from: Document): LiveStart | null {
  const text = from.getElementById("placegraph-live")?.textContent?.trim() ?? "";
  return text === "" ? null : decodeLiveStart(JSON.parse(text));
}

export function decodeLiveStart(value: unknown): LiveStart {
  const json = asObject(value, "The start of the page");
  if (json["format"] !== "placegraph-live-1") {
    throw new Error(
      `The server speaks ${JSON.stringify(json["format"]) ?? "nothing"}; this page knows placegraph-live-1.`,
    );
  }
  return {
    kind: asOneOf(json["kind"], ["view", "run"] as const, "kind"),
    program: asText(json["program"], "program"),
    title: asText(json["title"], "title"),
    editable: asBoolean(json["editable"], "editable"),
  };
}
