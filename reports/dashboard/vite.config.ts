import { defineConfig } from "vite";
import { viteSingleFile } from "vite-plugin-singlefile";

// One page with script and style in it; VSGLBENCH_DASHBOARD_OUT is the folder that it goes to.
export default defineConfig({
  plugins: [viteSingleFile({ removeViteModuleLoader: true })],
  build: {
    outDir: process.env.VSGLBENCH_DASHBOARD_OUT ?? "dist",
    emptyOutDir: false,
    target: "es2022",
    reportCompressedSize: false,
  },
});
