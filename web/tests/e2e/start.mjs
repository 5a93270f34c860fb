// Runs the end-to-end tests; where Chromium or a new enough Node is absent, says so and succeeds.
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { fileURLToPath } from "node:url";

const [major, minor] = process.versions.node.split(".").map(Number);
if (major < 20 || (major === 20 && minor < 19)) {
  console.log(`Skipped: the end-to-end tests need Node 20.19 or newer; this is ${process.versions.node}.`);
} else if (!existsSync("/usr/bin/chromium")) {
  console.log("Skipped: the end-to-end tests need /usr/bin/chromium (apt-get install chromium).");
} else {
  const vitest = fileURLToPath(new URL("../../node_modules/vitest/vitest.mjs", import.meta.url));
  const options = ["run", "--config", "vitest.e2e.config.ts", ...process.argv.slice(2)];
  process.exitCode = spawnSync(process.execPath, [vitest, ...options], { stdio: "inherit" }).status ?? 1;
}
