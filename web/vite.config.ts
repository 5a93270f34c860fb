import { defineConfig } from "vite";
import { singleFile } from "./single_file.ts";

export default defineConfig({
  base: "./",
  build: {
    target: "es2022",
    outDir: "dist",
    cssCodeSplit: false,
    assetsInlineLimit: 1 << 20,
    modulePreload: false,
    chunkSizeWarningLimit: 4000,
    rollupOptions: { input: "report.html" },
  },
  plugins: [singleFile()],
});
