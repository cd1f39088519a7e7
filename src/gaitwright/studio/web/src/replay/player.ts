// Recordings as a source: what a live studio tells, from their rows and events. Of several, on one ground, each
// begins at time 0, and the one that is watched is told about.

import { computed, type ReadonlySignal, signal } from "@preact/signals";
import { Blend } from "../blend";
import { fromBase64 } from "../bytes";
import { History } from "../history";
import { Layout } from "../layout";
import type { Answer, Box, Embedded, Hello, Moved, ReplayEvent, Role, Status, Story, World } from "../protocol";
import type { Link, Source } from "../source";
import { watched } from "../view/settings";
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
  readonly waits = nothing;
  readonly curve = nothing;
  readonly recordings = nothing;
  readonly refusal = signal("");
  readonly beat: ReadonlySignal<number>;
  readonly count: number;
  /** What happened to the robot that is watched. */
  readonly story: ReadonlySignal<Story>;
  /** The event that holds now. */
  readonly event: ReadonlySignal<ReplayEvent | null>;
  private readonly blend: Blend;
  private readonly rows: History[];

  constructor(readonly recording: Embedded, world: World, tracks: Track[], private readonly clock: Clock) {
    const layout = new Layout(recording.columns);
    this.layout = signal(layout);
    this.world = signal(world);
    this.boxes = signal(world.boxes);
    this.blend = new Blend(layout);
    this.count = tracks.length;
    this.rows = tracks.map(({ story, data }) => rowsOf(layout, data, story.count));
    this.story = computed(() => (tracks[watched.value] ?? tracks[0]).story);
    this.hello = signal(helloOf(recording));
    this.beat = clock.time;
    const place = computed(() => lastBefore(this.story.value.events, clock.time.value));
    this.event = computed(() => this.story.value.events[place.value] ?? null);
    const movers = recording.movers ?? [];
    const moment = computed(() => (movers.length ? lastBefore(movers, clock.time.value) : -1));
    this.moved = computed(() => (moment.value < 0 ? null : { say: "moved", things: movers[moment.value].things }));
    this.status = computed(() => statusOf(this.event.value, this.story.value.drivers, world.goal));
  }

  /** Unpacks a recording. */
  static async of(found: Embedded, clock: Clock): Promise<Player> {
    const layout = new Layout(found.columns);
    const world = (await unpacked(found.world).json()) as World;
    const stories: Story[] = [found, ...(found.others ?? [])];
    if (world.robots?.length !== stories.length) throw new Error("not a robot for each recording");
    const tracks = await Promise.all(stories.map((story) => trackOf(story, layout)));
    const movers = found.movers?.map(earlier(tracks[0].begins));
    return new Player({ ...found, movers }, world, tracks, clock);
  }

  get duration(): number {
    return Math.max(...this.rows.map((rows) => rows.last()));
  }

  now(): number {
    return this.clock.time.peek();
  }

  latest(robot = 0): Float32Array | null {
    const rows = this.rows[robot];
    return rows?.count ? rows.row(Math.min(rows.count - 1, rows.from(this.now()))) : null;
  }

  sample(robot: number, _now: number, out: Float32Array): boolean {
    const rows = this.rows[robot];
    if (!rows?.count) return false;
    const time = this.now();
    const after = Math.min(rows.count - 1, rows.from(time));
    const before = Math.max(0, after - 1);
    const span = rows.time(after) - rows.time(before);
    const share = span > 0 ? Math.max(0, Math.min(1, (time - rows.time(before)) / span)) : 1;
    this.blend.into(out, rows.row(before), rows.row(after), share);
    return true;
  }

  history(robot: number): History | null {
    return this.rows[robot] ?? null;
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

/** A recording with its own beginning as time 0, and its rows: of several, all begin at once. */
interface Track {
  story: Story;
  data: Float32Array;
  /** Its beginning, in its own time [s]. */
  begins: number;
}

async function trackOf(found: Story, layout: Layout): Promise<Track> {
  const whole = await unpacked(found.rows).arrayBuffer();
  const data = new Float32Array(whole, 0, whole.byteLength >> 2);
  if (data.length < layout.width) throw new Error("nothing to play");
  const at = layout.at("time");
  const begins = data[at] || 0;
  for (let k = at; k < data.length; k += layout.width) data[k] -= begins;
  const story = { ...found, events: found.events.map(earlier(begins)), notes: found.notes?.map(earlier(begins)) };
  return { story, data, begins };
}

/** Moves what has a time to so much earlier [s]. */
function earlier(by: number): <T extends { time: number }>(one: T) => T {
  return (one) => ({ ...one, time: Math.max(0, one.time - by) });
}

function rowsOf(layout: Layout, data: Float32Array, told: number): History {
  const count = Math.min(told, Math.floor(data.length / layout.width));
  const rows = new History(layout.width, layout.at("time"), Infinity, Math.max(1, count));
  for (let k = 0; k < count; k++) rows.add(data.subarray(k * layout.width, (k + 1) * layout.width));
  return rows;
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
