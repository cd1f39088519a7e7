// Bars over time: which feet are down, and who drives.

import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Layout } from "../layout";
import { colour, theme } from "../shell/theme";
import { driverColour, LEGS } from "../ui/colours";
import type { Feed } from "./feed";

const LEFT = 38;
const RIGHT = 6;
const ROW = 13;

export interface Bar {
  label: string;
  /** Colour of a row at this bar; "" for none. */
  paint: (row: Float32Array) => string;
}

export function stanceBars(layout: Layout, legs: string[]): Bar[] {
  const at = layout.at("stance");
  return legs.map((label, k) => ({ label, paint: (row) => (row[at + k] > 0.5 ? LEGS[k % LEGS.length] : "") }));
}

export function driverBar(layout: Layout, drivers: string[]): Bar {
  const at = layout.at("driver");
  return { label: "driver", paint: (row) => driverColour(drivers[Math.round(row[at])] ?? "") };
}

export function Strip({ title, bars, feed, id }: { title: string; bars: Bar[]; feed: Feed; id: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const height = bars.length * ROW;
  useEffect(() => {
    const stopFeed = feed.add((times, rows, span) => draw(canvas.current!, bars, times, rows, span));
    const stopTheme = effect(() => {
      theme.value;
      feed.refresh();
    });
    return () => {
      stopFeed();
      stopTheme();
    };
  }, [bars, feed]);
  return (
    <figure class="chart" data-testid={`strip-${id}`}>
      <figcaption>
        <span class="chart-title">{title}</span>
      </figcaption>
      <canvas ref={canvas} class="strip" style={{ height: `${height}px` }} />
    </figure>
  );
}

function draw(
  canvas: HTMLCanvasElement, bars: Bar[], times: number[], rows: Float32Array[], [from, to]: [number, number],
): void {
  const ratio = devicePixelRatio;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const ctx = canvas.getContext("2d")!;
  ctx.scale(ratio, ratio);
  ctx.font = "10.5px system-ui, sans-serif";
  ctx.textBaseline = "middle";
  ctx.textAlign = "right";
  const x = (time: number) => LEFT + ((time - from) / (to - from)) * (width - LEFT - RIGHT);
  bars.forEach((bar, k) => {
    const top = k * ROW;
    ctx.fillStyle = colour("--faint");
    ctx.fillText(bar.label, LEFT - 5, top + ROW / 2);
    ctx.fillStyle = colour("--plot-grid");
    ctx.fillRect(LEFT, top + 1, width - LEFT - RIGHT, ROW - 2);
    let begin = 0;
    for (let i = 1; i <= rows.length; i++) {
      const paint = rows[begin] ? bar.paint(rows[begin]) : "";
      if (i < rows.length && bar.paint(rows[i]) === paint) continue;
      if (paint) {
        const [left, right] = [Math.max(LEFT, x(times[begin])), Math.min(width - RIGHT, x(times[Math.min(i, rows.length - 1)]))];
        ctx.fillStyle = paint;
        if (right > left) ctx.fillRect(left, top + 1, right - left, ROW - 2);
      }
      begin = i;
    }
  });
}
