// One chart: its head with the values at the cursor, and the lines.

import { effect } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import uPlot from "uplot";
import { colour, theme } from "../shell/theme";
import { number } from "../ui/controls";
import type { Chart } from "./charts";
import type { Feed } from "./feed";
import { held } from "./span";

const HEIGHT = 96;
const FONT = "10.5px system-ui, sans-serif";

export function ChartView({ chart, feed }: { chart: Chart; feed: Feed }) {
  const place = useRef<HTMLDivElement>(null);
  const values = useRef<(HTMLElement | null)[]>([]);
  useEffect(() => {
    const box = place.current!;
    let plot: uPlot | null = null;
    const tellValues = () => {
      if (!plot) return;
      const at = plot.cursor.idx ?? plot.valToIdx(feed.now());
      chart.lines.forEach((_, k) => {
        const place = values.current[k];
        const text = number(plot!.data[k + 1]?.[at] as number | undefined, chart.digits);
        if (place && place.textContent !== text) place.textContent = text;
      });
    };
    const stopTheme = effect(() => {
      theme.value;
      plot?.destroy();
      plot = new uPlot(options(chart, box.clientWidth, feed, tellValues), [[]], box);
      feed.refresh();
    });
    const stopFeed = feed.add((times, rows, [from, to]) => {
      if (!plot) return;
      const lines = chart.lines.map(({ value }) => rows.map(value));
      plot.batch(() => {
        plot!.setData([times, ...lines] as uPlot.AlignedData, false);
        plot!.setScale("x", { min: from, max: to });
      });
      tellValues();
    });
    const watch = new ResizeObserver(() => plot?.setSize({ width: box.clientWidth, height: HEIGHT }));
    watch.observe(box);
    return () => {
      stopTheme();
      stopFeed();
      watch.disconnect();
      plot?.destroy();
    };
  }, [chart, feed]);
  return (
    <figure class="chart" data-testid={`chart-${chart.id}`}>
      <figcaption>
        <span class="chart-title">
          {chart.title} <span class="unit">{chart.unit}</span>
        </span>
        {chart.lines.map((line, k) => (
          <span key={k} class="chart-value" style={{ "--line-colour": line.colour }} title={line.label}>
            <i class={line.dash ? "dashed" : ""} />
            {!chart.perLeg && <span class="chart-label">{line.label}</span>}
            <b ref={(element) => void (values.current[k] = element)}>–</b>
          </span>
        ))}
      </figcaption>
      <div ref={place} class="chart-place" style={{ height: `${HEIGHT}px` }} />
    </figure>
  );
}

function options(chart: Chart, width: number, feed: Feed, tell: () => void): uPlot.Options {
  const axis = {
    stroke: colour("--faint"),
    font: FONT,
    grid: { stroke: colour("--plot-grid"), width: 1 },
    ticks: { show: false },
  };
  return {
    width: Math.max(width, 50),
    height: HEIGHT,
    legend: { show: false },
    padding: [4, 6, 0, 0],
    cursor: {
      sync: { key: "gaitwright" },
      drag: { x: true, y: false, setScale: false },
      points: { size: 5 },
      bind: {
        dblclick: () => () => {
          held.value = null;
          return null;
        },
      },
    },
    select: { show: true, left: 0, top: 0, width: 0, height: 0 },
    scales: {
      x: { time: false, auto: false },
      y: { range: (_, low, high) => around(low, high, chart.range) },
    },
    axes: [
      { ...axis, size: 18, gap: 2, space: 44, values: (_, splits) => splits.map((at) => number(at, splits[1] - splits[0] < 1 ? 1 : 0)) },
      { ...axis, size: 38, gap: 4, space: 18 },
    ],
    series: [
      {},
      ...chart.lines.map((line) => ({
        stroke: line.colour, width: line.dash ? 1 : 1.3, dash: line.dash, points: { show: false }, spanGaps: false,
      })),
    ],
    hooks: {
      setCursor: [tell],
      setSelect: [
        (plot: uPlot) => {
          if (plot.select.width < 4) return;
          const at = (pixel: number) => plot.posToVal(pixel, "x");
          held.value = [at(plot.select.left), at(plot.select.left + plot.select.width)];
          plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
          feed.refresh();
        },
      ],
      draw: [(plot: uPlot) => drawNow(plot, feed)],
    },
  };
}

function around(low: number | null, high: number | null, least?: [number, number]): [number, number] {
  const [a, b] = [low ?? least?.[0] ?? 0, high ?? least?.[1] ?? 1];
  const [from, to] = [Math.min(a, least?.[0] ?? a), Math.max(b, least?.[1] ?? b)];
  const room = 0.06 * (to - from) || 0.5;
  return [from - room, to + room];
}

/** In a recording, a line where the views are. */
function drawNow(plot: uPlot, feed: Feed): void {
  if (feed.source.kind !== "replay") return;
  const x = plot.valToPos(feed.now(), "x", true);
  const { left, top, width, height } = plot.bbox;
  if (x < left || x > left + width) return;
  const { ctx } = plot;
  ctx.save();
  ctx.strokeStyle = colour("--ink");
  ctx.lineWidth = devicePixelRatio;
  ctx.beginPath();
  ctx.moveTo(x, top);
  ctx.lineTo(x, top + height);
  ctx.stroke();
  ctx.restore();
}
