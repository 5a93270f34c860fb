// node tests/run_script.mjs FILE.ts [ARGUMENT...]: runs `main(arguments)` of a TypeScript file.
import { resolve } from "node:path";
import { runnerImport } from "vite";

const [file, ...rest] = process.argv.slice(2);
const { module } = await runnerImport(resolve(file), { configFile: false, logLevel: "error" });
await module.main(rest);
