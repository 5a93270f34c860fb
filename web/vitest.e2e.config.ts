import { defineConfig } from "vitest/config";

// Two browsers at a time: while one waits, the other draws. A machine that stalls gets a second chance.
export default defineConfig({
  test: { include: ["tests/e2e/**/*.test.ts"], testTimeout: 240000, hookTimeout: 120000, maxWorkers: 2, retry: 1 },
});
