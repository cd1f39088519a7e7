// The live studio: one WebSocket, which is opened again when it is lost.

import { batch, signal, type Signal } from "@preact/signals";
import { parseFrame } from "./frame";
import { History } from "./history";
import { Layout } from "./layout";
import type {
  Answer, Box, Command, Curves, FromServer, Hello, Moved, Proposed, Recordings, Remark, Role, Rules, Scan, Seen,
  Status, Waits, World,
} from "./protocol";
import { Smooth } from "./smooth";
import type { Link, Source } from "./source";

const VERSION = 1;
const ANSWER_WITHIN = 15_000;
/** What is seen in physics first may take long where it is done for the first time. */
const SEEN_WITHIN = 120_000;
const NO_STUDIO = "no studio answers here: where it was closed, start it again; this page looks for it";
const NO_ENTRY = "the studio that is open here has another address than this page: open the one that it printed";
const NO_ROOM = "the studio has no room for another page: close one; this page tries again";
/** By how a request is answered that comes with the page's token. */
const REFUSED: Record<number, string> = { 403: NO_ENTRY, 404: NO_ROOM };
/** What nobody may have without the token, whether it is there or not. */
const PROBE = "recordings/none.npz";
/** The studio gives a robot's process up that has said nothing for so long, where a reset is asked for [ms]. */
const SILENT = 30_000;
const SAYS_NOTHING =
  "the robot has said nothing for half a minute: what it does for the first time can take so long; else a reset begins another run";
/** Panels ask these by themselves, and show what is refused: the bar below has nothing to do with it. */
const LOOKS = new Set<Command["do"]>(["why", "curve", "recordings"]);
const RETRY = [500, 1000, 2000, 4000];

/** The address of `/live` next to this page, with the token of its own address. */
export function liveAddress(page: URL): string {
  const address = new URL("live", page);
  address.protocol = page.protocol === "https:" ? "wss:" : "ws:";
  const token = page.searchParams.get("token");
  address.search = token ? `?token=${encodeURIComponent(token)}` : "";
  address.hash = "";
  return address.href;
}

export class Live implements Source {
  readonly kind = "live";
  readonly link = signal<Link>("connecting");
  readonly hello = signal<Hello | null>(null);
  readonly role = signal<Role>({ say: "role", role: "watcher", watchers: 0, has_driver: false });
  readonly lost = signal("");
  readonly closed = signal("");
  readonly silent = signal("");
  readonly world = signal<World | null>(null);
  readonly boxes = signal<Box[]>([]);
  readonly status = signal<Status | null>(null);
  readonly moved = signal<Moved | null>(null);
  readonly scan = signal<Scan | null>(null);
  readonly seen = signal<Seen | null>(null);
  readonly rules = signal<Rules | null>(null);
  readonly curve = signal<Curves | null>(null);
  readonly tried = signal<Proposed | null>(null);
  readonly recordings = signal<Recordings | null>(null);
  readonly remark = signal<Remark | null>(null);
  readonly waits = signal<Waits | null>(null);
  readonly refusal = signal("");
  readonly layout = signal<Layout | null>(null);
  readonly beat = signal(0);

  /** What replaces what was known by that name. */
  private readonly told = {
    role: this.role,
    status: this.status,
    moved: this.moved,
    scan: this.scan,
    seen: this.seen,
    rules: this.rules,
    curve: this.curve,
    tried: this.tried,
    recordings: this.recordings,
    remark: this.remark,
    waits: this.waits,
  };
  private socket: WebSocket | null = null;
  private smooth: Smooth | null = null;
  private histories: History[] = [];
  private waiting = new Map<number, (answer: Answer) => void>();
  private nextId = 1;
  private failures = 0;
  private waitsLong = 0;

  constructor(private readonly address: string) {
    this.open();
  }

  get count(): number {
    return this.smooth?.newest?.rows.length ?? 0;
  }

  now(): number {
    return this.histories[0]?.last() ?? 0;
  }

  latest(robot: number): Float32Array | null {
    return this.smooth?.newest?.rows[robot] ?? null;
  }

  sample(robot: number, now: number, out: Float32Array): boolean {
    return this.smooth?.sample(robot, now / 1000, out) ?? false;
  }

  history(robot: number): History | null {
    return this.histories[robot] ?? null;
  }

  send(command: Command): Promise<Answer> {
    if (this.socket?.readyState !== WebSocket.OPEN) {
      return Promise.resolve(this.refuse("the studio is not connected"));
    }
    const looks = LOOKS.has(command.do);
    if (!looks) this.refusal.value = "";
    const id = this.nextId++;
    this.socket.send(JSON.stringify({ ...command, id }));
    return new Promise((resolve) => {
      const timer = setTimeout(() => {
        this.waiting.delete(id);
        resolve(this.refuse(`no answer to ${command.do}`));
      }, command.do === "edit" ? SEEN_WITHIN : ANSWER_WITHIN);
      this.waiting.set(id, (answer) => {
        clearTimeout(timer);
        if (!answer.done && !looks) this.refuse(answer.because);
        resolve(answer);
      });
    });
  }

  tell(command: Command): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  private refuse(because: string): Answer {
    this.refusal.value = ""; // the same sentence is said again, too
    this.refusal.value = because;
    return { done: false, because };
  }

  private open(): void {
    const socket = new WebSocket(this.address);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      if (typeof event.data === "string") this.hear(JSON.parse(event.data) as FromServer);
      else this.show(event.data);
    };
    socket.onopen = () => {
      this.failures = 0;
      this.closed.value = this.lost.value = "";
      this.link.value = "open";
      this.isHeard();
    };
    socket.onclose = ({ reason }) => {
      this.link.value = "lost";
      clearTimeout(this.waitsLong);
      this.silent.value = "";
      this.role.value = { ...this.role.peek(), role: "watcher" };
      if (reason) this.lost.value = reason;
      else if (this.failures > 0) void this.ask();
      const left = [...this.waiting.values()];
      this.waiting.clear();
      for (const answer of left) answer({ done: false, because: "the connection was lost" });
      setTimeout(() => this.open(), RETRY[Math.min(this.failures++, RETRY.length - 1)]);
    };
  }

  /** Finds out why there is no connection: a browser does not say how a socket was refused. */
  private async ask(): Promise<void> {
    const address = new URL(PROBE, location.href);
    address.search = new URL(this.address).search;
    const status = await fetch(address, { cache: "no-store" }).then((answer) => answer.status, () => 0);
    if (this.link.peek() !== "open") this.lost.value = REFUSED[status] ?? NO_STUDIO;
  }

  /** The robot said something; what it says next should not take long. */
  private isHeard(): void {
    this.silent.value = "";
    clearTimeout(this.waitsLong);
    this.waitsLong = window.setTimeout(() => {
      if (this.status.peek() && !this.closed.peek()) this.silent.value = SAYS_NOTHING;
    }, SILENT);
  }

  private show(data: ArrayBuffer): void {
    const layout = this.layout.value;
    const frame = layout && parseFrame(data, layout.width);
    if (!layout || !frame || !this.smooth) return;
    this.smooth.add(frame, performance.now() / 1000);
    frame.rows.forEach((row, k) => {
      this.histories[k] ??= new History(layout.width, layout.at("time"));
      this.histories[k].add(row);
    });
    this.histories.length = frame.rows.length;
    this.beat.value++;
  }

  private hear(message: FromServer): void {
    switch (message.say) {
      case "hello":
        this.begin(message);
        if (message.version !== VERSION) this.closed.value = "the studio is newer than this page: load it again";
        break;
      case "world":
        this.settle(message);
        break;
      case "boxes":
        this.boxes.value = message.boxes;
        break;
      case "closed":
        this.closed.value = message.because;
        break;
      case "done":
      case "refused":
        this.answered(message);
        break;
      default:
        this.know(message.say, message);
    }
  }

  private know(name: string, what: unknown): void {
    if (name === "status") this.isHeard();
    const known = (this.told as Record<string, unknown>)[name] as Signal<unknown> | undefined;
    if (known) known.value = what;
  }

  /** Another run, or this page comes to one: what is known of the one before holds no longer. */
  private begin(hello: Hello): void {
    const layout = new Layout(hello.columns);
    this.smooth = new Smooth(layout, layout.at("time"));
    this.histories = [];
    const isOther = JSON.stringify(layout.columns) !== JSON.stringify(this.layout.peek()?.columns);
    batch(() => {
      if (isOther) this.layout.value = layout;
      this.moved.value = this.scan.value = this.seen.value = this.tried.value = null;
      this.closed.value = ""; // where a run had ended, another one begins
      this.hello.value = hello;
    });
  }

  /** The world of the run that began. */
  private settle(world: World): void {
    batch(() => {
      this.world.value = world;
      this.boxes.value = world.boxes;
    });
  }

  private answered(message: Extract<FromServer, { say: "done" | "refused" }>): void {
    if (message.say === "refused") {
      if (typeof message.id !== "number") this.refuse(message.because); // of what no answer was awaited
      this.resolve(message.id, { done: false, because: message.because });
      return;
    }
    if (Array.isArray(message.recordings)) this.know("recordings", { names: message.recordings });
    this.resolve(message.id, { done: true, more: message });
  }

  private resolve(id: number | null | undefined, answer: Answer): void {
    if (typeof id !== "number") return;
    this.waiting.get(id)?.(answer);
    this.waiting.delete(id);
  }
}
