import { defineConfig } from "vitest/config";

// Two browsers at a time: while one waits, the other draws.
export default defineConfig({
  test: { include: ["tests/e2e/**/*.test.ts"], testTimeout: 240000, hookTimeout: 120000, maxWorkers: 2 },
});
