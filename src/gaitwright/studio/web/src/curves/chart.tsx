// A chart with points to drag: a double click on its line adds one, Delete or a right click takes one out.

import type { ComponentChildren } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import type { Source } from "../source";
import { number } from "../ui/controls";
import * as desk from "./desk";
import { digitsOf, isFixed, lineThrough, type Place, type Scale, smoothThrough, ticksIn, toPixels, toValues } from "./geometry";

const MARGIN = { left: 38, right: 8, top: 6, bottom: 17 };

export interface Drawing {
  id: string;
  title: string;
  unit: string;
  height: number;
  colour: string;
  x: Place;
  y: Place;
  /** Labels of an axis are its values times this. */
  times?: Place;
  xTicks?: number[];
  xUnit: string;
  /** Stretch of x in which the leg stands. */
  stance?: Place;
  /** How high what is ahead is. */
  ahead?: { high: number; label: string };
  /** Lines at values that cannot be gone beyond. */
  bounds?: number[];
  line: Place[];
  ghost: Place[];
  seen?: Place[];
  /** Whether the line comes back to its beginning. */
  closed?: boolean;
  place: (row: number[]) => Place;
  /** The row of the k-th point when it is moved to a place. */
  moved: (rows: number[][], k: number, place: Place) => number[];
  /** The leg's own phase at a place near the line. */
  phaseAt: (place: Place) => number;
}

export function Chart({ source, disabled, drawing }: { source: Source; disabled: boolean; drawing: Drawing }) {
  const box = useRef<HTMLElement>(null);
  const [width, setWidth] = useState(300);
  useLayoutEffect(() => {
    const watch = new ResizeObserver(([entry]) => setWidth(Math.round(entry.contentRect.width)));
    watch.observe(box.current!);
    return () => watch.disconnect();
  }, []);
  const { id, height, x, y } = drawing;
  const scale: Scale = {
    x,
    y,
    left: MARGIN.left,
    top: MARGIN.top,
    width: Math.max(40, width - MARGIN.left - MARGIN.right),
    height: height - MARGIN.top - MARGIN.bottom,
  };
  const pixels = (places: Place[]) => places.map((place) => toPixels(scale, place));
  const rows = desk.points.value;
  const drafted = desk.draft.value !== null;
  const hint = pixels(rows.map(drawing.place));
  const now = desk.dragged.value?.chart === id ? rows[desk.dragged.value.point] : null;
  const addAt = (event: MouseEvent) => {
    if (disabled) return;
    const svg = (event.currentTarget as SVGElement).ownerSVGElement!.getBoundingClientRect();
    desk.add(drawing.phaseAt(toValues(scale, [event.clientX - svg.left, event.clientY - svg.top])));
  };
  return (
    <figure class="curve-chart" ref={box} style={{ "--line-colour": drawing.colour }} data-testid={`curve-${id}`}>
      <figcaption>
        <span>{drawing.title}</span>
        <span class="unit">{now ? reading(drawing, now) : drawing.unit}</span>
      </figcaption>
      <svg width={width} height={height} class={desk.busy.value ? "busy" : ""}>
        <Axes scale={scale} drawing={drawing} />
        <path class="curve-ghost" d={lineThrough(pixels(drawing.ghost))} data-testid={`ghost-${id}`} />
        {drawing.seen && <path class="curve-seen" d={lineThrough(pixels(drawing.seen))} data-testid={`seen-${id}`} />}
        <path class={`curve-line ${drafted ? "old" : ""}`} d={lineThrough(pixels(drawing.line))} />
        {drafted && <path class="curve-draft" d={smoothThrough(hint) + (drawing.closed ? "Z" : "")} />}
        <path
          class="curve-grip"
          d={lineThrough(pixels(drawing.line))}
          data-testid={`line-${id}`}
          onDblClick={addAt}
        />
        {rows.map((_, k) => (
          <Handle key={k} source={source} disabled={disabled} drawing={drawing} scale={scale} k={k} at={hint[k]} />
        ))}
        <Mark id={id} scale={scale} place={drawing.place} />
      </svg>
      <Reason id={id} scale={scale} place={drawing.place} width={width} />
    </figure>
  );
}

function reading({ place, times = [1, 1], unit, xUnit }: Drawing, row: number[]): string {
  const [x, y] = place(row);
  return `${number(x * times[0], 3)}${xUnit && ` ${xUnit}`}, ${number(y * times[1], 3)} ${unit}`;
}

function Axes({ scale, drawing }: { scale: Scale; drawing: Drawing }) {
  const { left, top, width, height } = scale;
  const [ax, ay] = drawing.times ?? [1, 1];
  const xs = drawing.xTicks ?? ticksIn([scale.x[0] * ax, scale.x[1] * ax], 6).map((tick) => tick / ax);
  const ys = ticksIn([scale.y[0] * ay, scale.y[1] * ay], Math.max(3, Math.floor(height / 20))).map((tick) => tick / ay);
  const [xDigits, yDigits] = [digitsOf(xs.map((tick) => tick * ax)), digitsOf(ys.map((tick) => tick * ay))];
  const stance = drawing.stance?.map((value) => toPixels(scale, [value, 0])[0]);
  return (
    <g class="curve-axes">
      {stance && <rect class="stance" x={stance[0]} y={top} width={stance[1] - stance[0]} height={height} />}
      {xs.map((tick) => {
        const [px] = toPixels(scale, [tick, 0]);
        return (
          <g key={tick}>
            <path d={`M${px} ${top}V${top + height}`} />
            <text x={px} y={top + height + 12} text-anchor={px > left + width - 9 ? "end" : "middle"}>
              {number(tick * ax, xDigits)}
            </text>
          </g>
        );
      })}
      {ys.map((tick) => {
        const [, py] = toPixels(scale, [0, tick]);
        return (
          <g key={tick}>
            <path d={`M${left} ${py}H${left + width}`} class={tick === 0 ? "zero" : ""} />
            <text x={left - 4} y={py + 3.5} text-anchor="end">
              {number(tick * ay, yDigits)}
            </text>
          </g>
        );
      })}
      {(drawing.bounds ?? [])
        .filter((bound) => bound > scale.y[0] && bound < scale.y[1])
        .map((bound) => (
          <path key={bound} class="bound" d={`M${left} ${toPixels(scale, [0, bound])[1]}h${width}`} />
        ))}
      {drawing.ahead && <AheadLine scale={scale} {...drawing.ahead} />}
      <rect class="frame" x={left} y={top} width={width} height={height} />
    </g>
  );
}

function AheadLine({ scale, high, label }: { scale: Scale; high: number; label: string }) {
  const { left, width } = scale;
  const [, y] = toPixels(scale, [0, high]);
  return (
    <g class="ahead" data-testid="ahead-line">
      <path d={`M${left} ${y}h${width}`} />
      <text x={left + width - 4} y={y - 3} text-anchor="end">
        {label}
      </text>
    </g>
  );
}

interface Handled {
  source: Source;
  disabled: boolean;
  drawing: Drawing;
  scale: Scale;
  k: number;
  at: Place;
}

function Handle({ source, disabled, drawing, scale, k, at }: Handled) {
  const from = useRef<{ x: number; y: number; moved: boolean } | null>(null);
  const curve = desk.curve.value;
  const fixed = curve !== null && isFixed(curve, desk.points.value[k]);
  const still = disabled || fixed || desk.busy.value;
  const [x, y] = at;
  const move = (event: PointerEvent & { currentTarget: SVGElement }) => {
    const start = from.current;
    if (!start) return;
    start.moved ||= Math.hypot(event.clientX - start.x, event.clientY - start.y) > 2;
    if (!start.moved) return;
    const svg = event.currentTarget.ownerSVGElement!.getBoundingClientRect();
    const place = toValues(scale, [event.clientX - svg.left, event.clientY - svg.top]);
    const rows = desk.points.peek();
    desk.draft.value = rows.with(k, drawing.moved(rows, k, place));
  };
  const letGo = () => {
    const moved = from.current?.moved;
    from.current = null;
    desk.dragged.value = null;
    if (moved) desk.settle(source, drawing.id, k);
  };
  return (
    <g
      class={`curve-point ${fixed ? "fixed" : ""}`}
      tabindex={still ? undefined : 0}
      data-testid={`point-${drawing.id}-${k + 1}`}
      onPointerDown={(event) => {
        if (still || event.button !== 0) return;
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = { x: event.clientX, y: event.clientY, moved: false };
        desk.hold(drawing.id, k);
      }}
      onPointerMove={move}
      onPointerUp={letGo}
      onPointerCancel={letGo}
      onContextMenu={(event) => {
        event.preventDefault();
        if (!still) desk.remove(source, drawing.id, k);
      }}
      onKeyDown={(event) => {
        if (still || (event.key !== "Delete" && event.key !== "Backspace")) return;
        event.preventDefault();
        desk.remove(source, drawing.id, k);
      }}
    >
      <circle class="reach" cx={x} cy={y} r="9" />
      {fixed ? <rect x={x - 3} y={y - 3} width="6" height="6" /> : <circle class="dot" cx={x} cy={y} r="4.5" />}
      <title>{fixed ? "stays where it is" : `point ${k + 1}`}</title>
    </g>
  );
}

interface Refused {
  id: string;
  scale: Scale;
  place: (row: number[]) => Place;
}

/** The point that was refused, where it would have been. */
function Mark({ id, scale, place }: Refused) {
  const now = desk.refused.value;
  if (now?.chart !== id || !now.row) return null;
  const [x, y] = inside(scale, toPixels(scale, place(now.row)));
  return <circle class="curve-refused" cx={x} cy={y} r="7" data-testid="refused-point" />;
}

function Reason({ id, scale, place, width }: Refused & { width: number }): ComponentChildren {
  const now = desk.refused.value;
  if (now?.chart !== id) return null;
  const [x, y] = now.row ? inside(scale, toPixels(scale, place(now.row))) : [scale.left, scale.top];
  const style = x > width / 2 ? { right: `${width - x + 12}px`, top: `${y + 18}px` } : { left: `${x + 12}px`, top: `${y + 18}px` };
  return (
    <span class="curve-reason" style={style} data-testid="refused-reason">
      {now.because}
    </span>
  );
}

const RING = 9;

function inside({ left, top, width, height }: Scale, [x, y]: Place): Place {
  const bound = (value: number, low: number, high: number) => Math.max(low + RING, Math.min(value, high - RING));
  return [bound(x, left, left + width), bound(y, top, top + height)];
}
