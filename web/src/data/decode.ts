import { decodeRun } from "./decode_run";
import { asNumber, asObject, asText, listOf, orNull } from "./fields";
import { readFigure, readPicture, readTable } from "./figures";
import type { GraphData, ReportData } from "./model";
import { readColumn, TableReader } from "./table_reader";

/** The decoded report. Throws an error with a plain sentence that names what is missing or wrong. */
export function decodeReport(value: unknown): ReportData {
  const report = asObject(value, "The report");
  if (report["format"] !== "placegraph-report-1") {
    throw new Error(
      `The report has the format ${JSON.stringify(report["format"]) ?? "unknown"}; this page shows placegraph-report-1.`,
    );
  }
  return {
    program: asText(report["program"], "program"),
    title: asText(report["title"], "title"),
    runs: listOf(report["runs"], "runs", decodeRun),
    pictures: listOf(report["pictures"], "pictures", readPicture),
    tables: listOf(report["tables"], "tables", readTable),
    graphs: listOf(report["graphs"], "graphs", decodeGraph),
  };
}

function decodeGraph(value: unknown, where: string): GraphData {
  const json = asObject(value, where);
  const before = readColumn(json["before"], `${where}.before`, 3);
  const table = new TableReader(value, where, "edges", 2);
  const edges = table.column("edges", 2);
  for (let i = 0; i < edges.length; i++) {
    if (edges[i] < 0 || edges[i] >= before.rows) {
      throw new Error(`${where}.edges names node ${edges[i]}, but there are ${before.rows} nodes.`);
    }
  }
  const all = orNull(json["all"], `${where}.all`, asObject);
  return {
    name: asText(json["name"], `${where}.name`),
    nodes: before.rows,
    allNodes: all === null ? before.rows : asNumber(all["nodes"], `${where}.all.nodes`),
    allEdges: all === null ? table.rows : asNumber(all["edges"], `${where}.all.edges`),
    before: before.values,
    after: orNull(json["after"], `${where}.after`, (v, w) => readColumn(v, w, 3, before.rows).values),
    edgeCount: table.rows,
    edges,
    ends: table.optional("ends", 2) ?? edges,
    kind: table.labels("edge_kind"),
    chi2: table.column("chi2"),
    weight: table.optional("weight"),
    figures: listOf(json["figures"], `${where}.figures`, readFigure),
  };
}
