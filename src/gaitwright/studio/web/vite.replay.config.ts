import type { OutputAsset, OutputBundle, OutputChunk } from "rolldown";
import { defineConfig, type Plugin } from "vite";

// A replay page: one HTML file with everything in it, which opens from a disk. Its recording is put into the
// empty script of id "recording".

export default defineConfig({
  base: "./",
  publicDir: false,
  build: {
    outDir: "../page", emptyOutDir: false, target: "es2022", cssCodeSplit: false, modulePreload: false,
    rolldownOptions: { input: "replay.html", output: { codeSplitting: false } },
  },
  oxc: { jsx: { runtime: "automatic", importSource: "preact" } },
  plugins: [inline()],
});

/** Puts scripts and styles into the page that names them. */
function inline(): Plugin {
  return {
    name: "inline",
    enforce: "post",
    generateBundle: {
      order: "post",
      handler(_options: unknown, bundle: OutputBundle) {
        const files = Object.values(bundle);
        const page = files.find((file) => file.fileName === "replay.html") as OutputAsset;
        const script = files.find((file): file is OutputChunk => file.type === "chunk")!;
        const style = files.find((file) => file.fileName.endsWith(".css")) as OutputAsset;
        const code = script.code.replaceAll("</script", "<\\/script").replaceAll("<!--", "<\\!--");
        page.source = String(page.source)
          .replace(/<script[^>]*\bsrc=[^>]*><\/script>/, "")
          .replace(/<link[^>]*\brel="stylesheet"[^>]*>/, () => `<style>${String(style.source)}</style>`)
          .replace("</body>", () => `<script type="module">${code}</script>\n</body>`);
        for (const file of files) if (file !== page) delete bundle[file.fileName];
      },
    },
  };
}
