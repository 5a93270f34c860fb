/** npm run sample -- [--frames N] [--landmarks N] [--runs N] [--lost A-B] [--components 2] [--no-truth] [--no-scale] [--graph] -o FILE */
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { insertReport } from "./encode";
import { sampleGraph, sampleReport, sampleRun, type SampleOptions } from "./sample";

function value(args: string[], name: string): string | undefined {
  const at = args.indexOf(name);
  return at >= 0 ? args[at + 1] : undefined;
}

export function main(args: string[]): void {
  const out = value(args, "-o");
  if (out === undefined) throw new Error("npm run sample -- [--frames N] ... -o FILE: -o is missing");
  const frames = Number(value(args, "--frames") ?? 1101);
  const lost = value(args, "--lost")?.split("-").map(Number);
  const options: Partial<SampleOptions> = {
    frames,
    landmarks: Number(value(args, "--landmarks") ?? 20 * frames),
    components: value(args, "--components") === "2" ? 2 : 1,
    lost: lost ? [[lost[0], lost[1]]] : [],
    truth: !args.includes("--no-truth"),
    metric: !args.includes("--no-scale"),
  };
  const count = Number(value(args, "--runs") ?? 1);
  const runs = Array.from({ length: count }, (_, i) =>
    sampleRun({ ...options, name: `block_${i + 1}`, seed: i + 1, partsAt: i === 1 ? Math.floor(frames / 2) : null }),
  );
  const page = readFileSync(resolve("dist/report.html"), "utf8");
  writeFileSync(out, insertReport(page, sampleReport(runs, args.includes("--graph") ? [sampleGraph()] : [])));
  console.log(`${out}: ${count} runs of ${frames} frames`);
}
