// The learned map beside the true ground, from above.

import { useEffect, useRef } from "preact/hooks";
import { theme } from "../shell/theme";
import { drives, type Source } from "../source";
import { number, Segmented } from "../ui/controls";
import { Icon } from "../ui/icons";
import { watched } from "../view/settings";
import { gather, learned, news } from "./learned";
import { paint, type What } from "./paint";
import { fit, follows, type Frame, layout, middle, pan, scale, toWorld, zoom } from "./sight";
import { Truth } from "./truth";
import "./map.css";

const EVERY = 66;
const truth = new Truth();

/** Gathers the map, whichever panel is open. */
export function useMap(source: Source): void {
  useEffect(() => gather(source), [source]);
}

export function MapPanel({ source }: { source: Source }) {
  const place = useRef<HTMLDivElement>(null);
  void news.value;
  const beside = layout.value === "beside";
  const size = (): Frame => {
    const canvas = place.current!.querySelector("canvas")!;
    return { width: canvas.clientWidth, height: canvas.clientHeight };
  };
  return (
    <div class="map" data-testid="map">
      <div class="map-tools">
        <Segmented
          id="map-layout"
          value={layout.value}
          choose={(value) => (layout.value = value)}
          choices={[
            { value: "beside", label: "both", title: "What it has learned, and what is there" },
            { value: "over", label: "learned", title: "What it has learned, the true outlines faint" },
          ]}
        />
        <span class="spring" />
        <button
          data-testid="map-follow"
          aria-pressed={follows.value}
          title="The robot stays in the middle"
          onClick={() => (follows.value = !follows.value)}
        >
          Follow
        </button>
        <button
          data-testid="map-fit"
          title="The whole field"
          onClick={() => source.world.value && fit(source.world.value.bounds, size())}
        >
          All
        </button>
        <button class="icon" title="Nearer" data-testid="map-nearer" onClick={() => zoom(1.5)}>
          <Icon name="plus" />
        </button>
        <button class="icon" title="Farther" data-testid="map-farther" onClick={() => zoom(1 / 1.5)}>
          <Icon name="minus" />
        </button>
      </div>
      <div class="map-places" ref={place}>
        <MapView source={source} what="learned" title={`Learned · ${known()}`} />
        {beside && <MapView source={source} what="true" title="True ground" />}
      </div>
    </div>
  );
}

function known(): string {
  const metres = learned.known * learned.spacing ** 2;
  return metres ? `${number(metres, metres < 10 ? 1 : 0)} m²` : "nothing yet";
}

function MapView({ source, what, title }: { source: Source; what: What; title: string }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  usePainting(source, what, canvas);
  const from = useRef<{ x: number; y: number; moved: boolean } | null>(null);
  const go = (event: PointerEvent & { currentTarget: HTMLCanvasElement }) => {
    if (!drives(source)) return;
    const box = event.currentTarget.getBoundingClientRect();
    const frame = { width: box.width, height: box.height };
    const [x, y] = toWorld(frame, event.clientX - box.left, event.clientY - box.top);
    void source.send({ do: "go", x, y, then: event.shiftKey });
  };
  return (
    <div class="map-view">
      <canvas
        ref={canvas}
        data-testid={`map-${what}`}
        data-known={learned.known}
        onPointerDown={(event) => {
          event.currentTarget.setPointerCapture(event.pointerId);
          from.current = { x: event.clientX, y: event.clientY, moved: false };
        }}
        onPointerMove={(event) => {
          const start = from.current;
          if (!start) return;
          const [dx, dy] = [event.clientX - start.x, event.clientY - start.y];
          if (!start.moved && Math.hypot(dx, dy) < 4) return;
          from.current = { x: event.clientX, y: event.clientY, moved: true };
          pan(dx, dy);
        }}
        onPointerUp={(event) => {
          if (from.current && !from.current.moved && event.button === 0) go(event);
          from.current = null;
        }}
        onPointerCancel={() => (from.current = null)}
        onWheel={(event) => {
          event.preventDefault();
          const box = event.currentTarget.getBoundingClientRect();
          const frame = { width: box.width, height: box.height };
          zoom(1.0015 ** -event.deltaY, frame, [event.clientX - box.left, event.clientY - box.top]);
        }}
      />
      <span class="map-title">{title}</span>
    </div>
  );
}

/** Paints again when something changed, at most fifteen times a second. */
function usePainting(source: Source, what: What, canvas: { current: HTMLCanvasElement | null }): void {
  useEffect(() => {
    let running = 0;
    let before = 0;
    let painted = "";
    const run = (now: number) => {
      running = requestAnimationFrame(run);
      const place = canvas.current;
      if (!place || now - before < EVERY) return;
      before = now;
      if (follows.peek()) follow(source);
      const frame = { width: place.clientWidth, height: place.clientHeight };
      const state = [source.beat.peek(), news.peek(), middle.peek(), scale.peek(), theme.peek(), frame.width, frame.height].join(" ");
      const world = source.world.peek();
      if (!world || !frame.width || state === painted) return;
      painted = state;
      truth.know(world);
      const dense = devicePixelRatio;
      place.width = Math.round(frame.width * dense);
      place.height = Math.round(frame.height * dense);
      const context = place.getContext("2d")!;
      context.scale(dense, dense);
      paint(what, { context, frame, source, truth, theme: theme.peek() });
    };
    running = requestAnimationFrame(run);
    return () => cancelAnimationFrame(running);
  }, [source, what]);
}

function follow(source: Source): void {
  const row = source.latest(watched.peek());
  const at = source.layout.peek()?.at("position_w");
  if (!row || at === undefined) return;
  const [x, y] = [row[at], row[at + 1]];
  const [cx, cy] = middle.peek();
  if (Math.hypot(x - cx, y - cy) > 1e-3) middle.value = [x, y];
}
