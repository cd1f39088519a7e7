// A picture or a film of the views, saved as a file.

import { signal } from "@preact/signals";
import type { Engine } from "./engine";

export const filming = signal(false);
let recorder: MediaRecorder | null = null;

export function photograph(engine: Engine): void {
  // right after drawing, while the picture is still there
  const once = () => {
    engine.onDrawn = engine.onDrawn.filter((then) => then !== once);
    engine.canvas.toBlob((blob) => blob && save(blob, `${name()}.png`), "image/png");
  };
  engine.onDrawn.push(once);
}

/** Begins to film, or ends and saves. */
export function film(engine: Engine): void {
  if (recorder) {
    recorder.stop();
    return;
  }
  const type = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"].find((one) =>
    MediaRecorder.isTypeSupported(one),
  );
  const parts: Blob[] = [];
  recorder = new MediaRecorder(engine.canvas.captureStream(30), { mimeType: type, videoBitsPerSecond: 8_000_000 });
  recorder.ondataavailable = (event) => parts.push(event.data);
  recorder.onstop = () => {
    recorder = null;
    filming.value = false;
    save(new Blob(parts, { type: "video/webm" }), `${name()}.webm`);
  };
  recorder.start(500);
  filming.value = true;
}

function name(): string {
  return `gaitwright-${new Date().toISOString().slice(0, 19).replaceAll(":", "-")}`;
}

export function save(blob: Blob, file: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = file;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
