// Where everything that is shown comes from: a live studio, or a recording. Panels read it and send commands.

import type { ReadonlySignal } from "@preact/signals";
import type { History } from "./history";
import type { Layout } from "./layout";
import type {
  Answer, Box, Command, Curves, Hello, Moved, Proposed, Recordings, Remark, Role, Rules, Scan, Seen, Status, Waits, World,
} from "./protocol";

export type Link = "connecting" | "open" | "lost";

export interface Source {
  readonly kind: "live" | "replay";
  readonly link: ReadonlySignal<Link>;
  readonly hello: ReadonlySignal<Hello | null>;
  readonly role: ReadonlySignal<Role>;
  /** Why there is no connection, and what to do; "" while there is one. */
  readonly lost: ReadonlySignal<string>;
  /** Why the studio has ended; "" while it has not. */
  readonly closed: ReadonlySignal<string>;
  /** That nothing comes from the robot though there is a connection; "" while something does. */
  readonly silent: ReadonlySignal<string>;
  readonly world: ReadonlySignal<World | null>;
  /** The boxes of the world as they are now. */
  readonly boxes: ReadonlySignal<Box[]>;
  readonly status: ReadonlySignal<Status | null>;
  readonly moved: ReadonlySignal<Moved | null>;
  readonly scan: ReadonlySignal<Scan | null>;
  readonly seen: ReadonlySignal<Seen | null>;
  readonly rules: ReadonlySignal<Rules | null>;
  readonly curve: ReadonlySignal<Curves | null>;
  /** What a person showed an apprentice last. */
  readonly tried: ReadonlySignal<Proposed | null>;
  readonly recordings: ReadonlySignal<Recordings | null>;
  /** What happened last, for the bar below. */
  readonly remark: ReadonlySignal<Remark | null>;
  /** What the robot is waited for because of, before it moves. */
  readonly waits: ReadonlySignal<Waits | null>;
  /** The last refusal, for the bar below; "" where there is none. */
  readonly refusal: ReadonlySignal<string>;

  /** Columns of a row; `null` before they are known. */
  readonly layout: ReadonlySignal<Layout | null>;
  /** Changes once per frame that came (live) or per picture drawn (replay): cheap to watch, carries nothing. */
  readonly beat: ReadonlySignal<number>;

  /** Time of what is shown now [s]. */
  now(): number;
  /** Number of robots in the newest frame. */
  readonly count: number;
  /** The newest row of a robot, as a view; `null` before the first. */
  latest(robot: number): Float32Array | null;
  /** The row to draw at a time of the page's clock [ms], between the frames around it; false where there is none. */
  sample(robot: number, now: number, out: Float32Array): boolean;
  /** The last 60 s of a robot (a replay: all of it). */
  history(robot: number): History | null;

  /** Sends a command. A replay refuses. */
  send(command: Command): Promise<Answer>;
  /** Sends without asking for an answer: for what comes many times a second. */
  tell(command: Command): void;
}

/** Whether this page drives, and does not only watch. */
export function drives(source: Source): boolean {
  return source.role.value.role === "driver";
}
