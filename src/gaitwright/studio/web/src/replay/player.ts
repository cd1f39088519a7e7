// A recording as a source: what a live studio tells, from its rows and events.

import { computed, type ReadonlySignal, signal } from "@preact/signals";
import { Blend } from "../blend";
import { fromBase64 } from "../bytes";
import { History } from "../history";
import { Layout } from "../layout";
import type { Answer, Box, Embedded, Hello, Moved, ReplayEvent, Role, Status, World } from "../protocol";
import type { Link, Source } from "../source";
import type { Clock } from "./clock";

const nothing: ReadonlySignal<null> = signal(null);

export class Player implements Source {
  readonly kind = "replay";
  readonly link = signal<Link>("open");
  readonly hello: ReadonlySignal<Hello>;
  readonly world: ReadonlySignal<World>;
  readonly boxes: ReadonlySignal<Box[]>;
  readonly status: ReadonlySignal<Status>;
  readonly layout: ReadonlySignal<Layout>;
  readonly role = signal<Role>({ say: "role", role: "watcher", watchers: 0, has_driver: false });
  readonly lost = signal("");
  readonly closed = signal("");
  readonly silent = signal("");
  readonly moved: ReadonlySignal<Moved | null>;
  readonly scan = nothing;
  readonly seen = nothing;
  readonly rules = nothing;
  readonly tried = nothing;
  readonly remark = nothing;
  readonly curve = nothing;
  readonly recordings = nothing;
  readonly refusal = signal("");
  readonly beat: ReadonlySignal<number>;
  readonly count = 1;
  /** The event that holds now. */
  readonly event: ReadonlySignal<ReplayEvent | null>;
  private readonly blend: Blend;
  private readonly rows: History;

  constructor(readonly recording: Embedded, world: World, data: Float32Array, private readonly clock: Clock) {
    const layout = new Layout(recording.columns);
    this.layout = signal(layout);
    this.world = signal(world);
    this.boxes = signal(world.boxes);
    this.blend = new Blend(layout);
    const count = Math.min(recording.count, Math.floor(data.length / layout.width));
    this.rows = new History(layout.width, layout.at("time"), Infinity, Math.max(1, count));
    for (let k = 0; k < count; k++) this.rows.add(data.subarray(k * layout.width, (k + 1) * layout.width));
    this.hello = signal(helloOf(recording));
    this.beat = clock.time;
    const place = computed(() => lastBefore(recording.events, clock.time.value));
    this.event = computed(() => recording.events[place.value] ?? null);
    const movers = recording.movers ?? [];
    const moment = computed(() => (movers.length ? lastBefore(movers, clock.time.value) : -1));
    this.moved = computed(() => (moment.value < 0 ? null : { say: "moved", things: movers[moment.value].things }));
    this.status = computed(() => statusOf(this.event.value, recording.drivers, world.goal));
  }

  /** Unpacks a recording. */
  static async of(found: Embedded, clock: Clock): Promise<Player> {
    const whole = await unpacked(found.rows).arrayBuffer();
    const data = new Float32Array(whole, 0, whole.byteLength >> 2);
    const world = (await unpacked(found.world).json()) as World;
    if (data.length < new Layout(found.columns).width || !world.robots?.length) throw new Error("nothing to play");
    return new Player(fromZero(found, data), world, data, clock);
  }

  get duration(): number {
    return this.rows.last();
  }

  now(): number {
    return this.clock.time.peek();
  }

  latest(): Float32Array | null {
    if (!this.rows.count) return null;
    return this.rows.row(Math.min(this.rows.count - 1, this.rows.from(this.now())));
  }

  sample(robot: number, _now: number, out: Float32Array): boolean {
    if (robot !== 0 || !this.rows.count) return false;
    const time = this.now();
    const after = Math.min(this.rows.count - 1, this.rows.from(time));
    const before = Math.max(0, after - 1);
    const span = this.rows.time(after) - this.rows.time(before);
    const share = span > 0 ? Math.max(0, Math.min(1, (time - this.rows.time(before)) / span)) : 1;
    this.blend.into(out, this.rows.row(before), this.rows.row(after), share);
    return true;
  }

  history(robot: number): History | null {
    return robot === 0 ? this.rows : null;
  }

  send(): Promise<Answer> {
    return Promise.resolve({ done: false, because: "a recording cannot be driven" });
  }

  tell(): void {
    // a recording hears nothing
  }
}

/** What was deflated. */
function unpacked(packed: string): Response {
  const stream = new Blob([fromBase64(packed)]).stream();
  return new Response(stream.pipeThrough(new DecompressionStream("deflate-raw")));
}

/** The recording with its own beginning as time 0, its rows too: of two, both begin at once. */
function fromZero(recording: Embedded, data: Float32Array): Embedded {
  const { columns, events, movers, notes } = recording;
  const layout = new Layout(columns);
  const at = layout.at("time");
  const begins = data[at] || 0;
  for (let k = at; k < data.length; k += layout.width) data[k] -= begins;
  const shift = <T extends { time: number }>(one: T): T => ({ ...one, time: Math.max(0, one.time - begins) });
  return { ...recording, events: events.map(shift), movers: movers?.map(shift), notes: notes?.map(shift) };
}

/** Place of the last of some that are in order of time, not after a time; the first where all are later. */
function lastBefore(all: readonly { time: number }[], time: number): number {
  let [low, high] = [0, all.length];
  while (low + 1 < high) {
    const middle = (low + high) >> 1;
    if (all[middle].time <= time + 1e-6) low = middle;
    else high = middle;
  }
  return low;
}

function helloOf(recording: Embedded): Hello {
  const none = { skills: [], modes: [] };
  const { columns, drivers } = recording;
  return { say: "hello", version: 1, columns, choices: { ...none, drivers } };
}

function statusOf(event: ReplayEvent | null, drivers: string[], goal: World["goal"]): Status {
  const driver = event?.driver ?? drivers[0] ?? "";
  return {
    say: "status", time: event?.time ?? 0, paused: false, pace: 1, real_time: 1, mode: "plan", driver,
    controller: driver, skill: event?.skill ?? "", velocity: [0, 0, 0], because: event?.because ?? "",
    rule: event?.rule ?? "", route: [], goal, no_way: null, pause: null, halt: null,
    over: null, arrived: false, fell: false, faults: [], recording: false,
    obstacle: "", share: {},
  };
}
