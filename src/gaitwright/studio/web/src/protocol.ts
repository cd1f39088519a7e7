// The studio's protocol, version 1: what server and page say to each other.
// Lengths m, angles rad, world axes x forward, y left, z up; quaternions (w, x, y, z).

import type { CurveKind } from "./protocol-curves";
import type { Rules } from "./protocol-rules";
import type { Box, Column, Thing, Vec2, Vec3, World } from "./protocol-scene";

export * from "./protocol-curves";
export * from "./protocol-rules";
export * from "./protocol-scene";

export type Mode = "guide" | "apprentice" | "plan";

export interface Choices {
  robots?: string[];
  scenes?: { name: string; about: string }[];
  skills: string[];
  drivers: string[];
  modes: Mode[];
  /** Forms that recordings can be fetched in. */
  forms?: string[];
}

export interface Hello {
  say: "hello";
  version: number;
  columns: Column[];
  choices: Choices;
}

/** Who this page is: told when it comes in, and whenever that changes. */
export interface Role {
  say: "role";
  role: "driver" | "watcher";
  watchers: number;
  has_driver: boolean;
}

/** The studio has ended. */
export interface Closed {
  say: "closed";
  because: string;
}

export interface Status {
  say: "status";
  time: number;
  paused: boolean;
  pace: number;
  real_time: number;
  mode: Mode;
  /** A motion is being composed, or played; its moves and seconds, and how much of it was played [s]. */
  composing?: boolean;
  playing?: boolean;
  composed?: number;
  composed_seconds?: number;
  played_seconds?: number;
  /** the driver asked for */
  driver: string;
  /** who has the joints now */
  controller: string;
  skill: string;
  /** asked for: forward, left, turn */
  velocity: Vec3;
  because: string;
  rule: string;
  /** whether that rule was seen right just like this before */
  firm?: boolean;
  route: Vec2[];
  goal: Vec2 | null;
  no_way: string | null;
  pause: string | null;
  halt: string | null;
  over: string | null;
  /** how the last mission ended */
  outcome?: string | null;
  arrived: boolean;
  fell: boolean;
  faults: string[];
  recording: boolean;
  /** of the recording so far [s] */
  recorded?: number;
  obstacle: string;
  /** Legs that are moved over something by what was learned, and why; name "": nothing is for it. */
  operators_in_use?: { leg: string; name: string; reach: number; because: string }[];
  /** the skill that a person holds; "": rules choose */
  held?: string;
  setup?: { robot: string; scene: string; seed: number; sight: "known" | "camera" };
  share: Record<string, number>;
}

/** Where the boxes are now: these, and no others. */
export interface Boxes {
  say: "boxes";
  boxes: Box[];
}

/** Why there is no robot to be seen yet; "": there is. */
export interface Waits {
  say: "waits";
  because: string;
}

/** Something that happened, in a sentence. */
export interface Remark {
  say: "remark";
  sentence: string;
}

export interface Moved {
  say: "moved";
  things: Thing[];
}

export interface Scan {
  say: "scan";
  support: Vec3[];
  predicted: Vec3[];
  cog: Vec3;
  reach: Vec3[][];
  critical: boolean[];
  margin: number | null;
  roll: number;
  pitch: number;
  slope: (number | null)[];
  elevation: (number | null)[];
}

export interface Seen {
  say: "seen";
  x: number;
  y: number;
  spacing: number;
  rows: number;
  columns: number;
  /** base64 of float32, rows along y; NaN: unknown */
  heights: string;
  obstacles: Vec2[][];
  /** x0, y0, x1, y1 */
  walls?: [number, number, number, number][];
  /** ways that it walked */
  walked?: Vec2[][];
}

/** Answer to `why`. */
export interface Why {
  sentences: string[];
  /** What would have to be different; "" where no rule is known. */
  different: string;
  /** Value of each tree now. */
  situation: Record<string, string | null>;
  /** The rule that fires by the book; "": none. */
  fires: string;
}

/** What a lesson would do; nothing is learned before `keep`. Answer to `right` and `order`, and said to all where
    a person showed an apprentice what may be right. */
export interface Tried {
  lesson: string;
  sentence: string;
  moves: string[];
  followed: boolean;
  stretches: string[];
  broken: string[];
  mended: string[];
}

/** Curves are other ones than before, or legs follow them now: ask again. */
export interface Curves {
  say: "curve";
  edits: number;
  pending: boolean;
  /** What was learned at obstacles, in the order in which it is tried. */
  operators: Operator[];
  /** Files of leg cycles that could not be read, a sentence for each. */
  faults?: string[];
}

export interface Operator {
  name: string;
  kinds: string[];
  /** [m] */
  largest: number;
  strategy: string;
  taught: string;
  sentence: string;
}

/** What a person showed an apprentice waits for her word, or nothing does any more. */
export type Proposed = { say: "tried" } & (({ proposed: true } & Tried) | { proposed: false });

export interface Recordings {
  say: "recordings";
  names: { name: string; bytes: number }[];
}

export interface Done {
  say: "done";
  id: number | null;
  /** what else is answered */
  [more: string]: unknown;
}

export interface Refused {
  say: "refused";
  id?: number | null;
  because: string;
}

export type FromServer =
  | Hello | Role | Closed | World | Boxes | Remark | Waits | Status | Moved | Scan | Seen | Rules | Curves | Proposed
  | Recordings | Done | Refused;

export type Command =
  | { do: "go"; x: number; y: number; then?: boolean }
  | { do: "steer"; forward: number; left: number; turn: number }
  | { do: "skill"; name: string; speed?: number }
  | { do: "drive"; driver: string }
  | { do: "mode"; mode: Mode }
  | { do: "step"; ticks: number }
  | { do: "pace"; factor: number }
  | { do: "reset"; robot?: string; scene?: string; seed?: number; sight?: "known" | "camera"; driver?: string }
  | { do: "push"; impulse: number; direction: number }
  | { do: "place"; x: number; y: number; lx: number; ly: number; height: number; yaw: number }
  | { do: "move"; thing: string | number; x: number; y: number; yaw?: number }
  | { do: "remove"; thing: string | number }
  | { do: "compose" | "record"; on: boolean }
  | { do: "right"; skill: string; speed?: number; about?: string; name?: string }
  | { do: "forget"; lesson?: string }
  | { do: "keep"; lesson: string }
  /** `brief`: only the situation, and which rule fires */
  | { do: "why"; rule?: string; brief?: boolean }
  | { do: "order"; rule: string; before: string }
  | { do: "curve"; kind: CurveKind; skill?: string; leg: number }
  | { do: "edit"; kind: CurveKind; skill: string; leg: number; points: number[][]; mirror: boolean; obstacle?: boolean }
  | {
      do: "stand" | "play" | "pause" | "resume" | "abort" | "take" | "release" | "back" | "ok" | "undo" | "redo"
        | "save" | "recordings";
    };

/** `more`: what came with it. */
export type Answer = { done: true; more: Record<string, unknown> } | { done: false; because: string };

/** What a replay page carries in `<script type="application/json" id="recording">`. */
export interface Embedded extends Story {
  /** base64 of deflate-raw-compressed JSON of a `World` */
  world: string;
  columns: Column[];
  /** where moving things were, time by time */
  movers?: { time: number; things: Thing[] }[];
  /** recordings of other robots on the same ground */
  others?: Story[];
}

/** What happened to one robot. */
export interface Story {
  title: string;
  drivers: string[];
  /** rows per second */
  rate: number;
  count: number;
  /** base64 of deflate-raw-compressed float32 */
  rows: string;
  events: ReplayEvent[];
  report: Record<string, unknown>;
  /** what a person did meanwhile */
  notes?: ReplayNote[];
}

export interface ReplayNote {
  time: number;
  /** "mode", "lesson", "edit" or "world" */
  kind: string;
  sentence: string;
}

export interface ReplayEvent {
  time: number;
  skill: string;
  driver: string;
  because: string;
  rule: string;
}
