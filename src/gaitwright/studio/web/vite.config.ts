import { defineConfig } from "vite";

// The page of the live studio; the server hands out what is in `page`.
export default defineConfig({
  base: "./",
  build: { outDir: "../page", emptyOutDir: true, target: "es2022", assetsInlineLimit: 0, modulePreload: false },
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  server: { proxy: { "/live": { target: "ws://127.0.0.1:8737", ws: true } } },
});
