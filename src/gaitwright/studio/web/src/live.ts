// The live studio: one WebSocket, which is opened again when it is lost.

import { signal, type Signal } from "@preact/signals";
import { parseFrame } from "./frame";
import { History } from "./history";
import { Layout } from "./layout";
import type {
  Answer, Command, Curve, FromServer, Hello, Moved, Recordings, Rules, Scan, Seen, Status, Tried, Why, World,
} from "./protocol";
import { Smooth } from "./smooth";
import type { Link, Source } from "./source";

const ANSWER_WITHIN = 15_000;
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
  readonly world = signal<World | null>(null);
  readonly status = signal<Status | null>(null);
  readonly moved = signal<Moved | null>(null);
  readonly scan = signal<Scan | null>(null);
  readonly seen = signal<Seen | null>(null);
  readonly rules = signal<Rules | null>(null);
  readonly why = signal<Why | null>(null);
  readonly tried = signal<Tried | null>(null);
  readonly curve = signal<Curve | null>(null);
  readonly recordings = signal<Recordings | null>(null);
  readonly refusal = signal("");
  readonly layout = signal<Layout | null>(null);
  readonly beat = signal(0);

  /** What replaces what was known by that name. */
  private readonly told = {
    status: this.status,
    moved: this.moved,
    scan: this.scan,
    seen: this.seen,
    rules: this.rules,
    why: this.why,
    tried: this.tried,
    curve: this.curve,
    recordings: this.recordings,
  };
  private socket: WebSocket | null = null;
  private smooth: Smooth | null = null;
  private histories: History[] = [];
  private waiting = new Map<number, (answer: Answer) => void>();
  private nextId = 1;
  private failures = 0;

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
    const id = this.nextId++;
    this.socket.send(JSON.stringify({ ...command, id }));
    return new Promise((resolve) => {
      const timer = setTimeout(() => {
        this.waiting.delete(id);
        resolve(this.refuse(`no answer to ${command.do}`));
      }, ANSWER_WITHIN);
      this.waiting.set(id, (answer) => {
        clearTimeout(timer);
        resolve(answer);
      });
    });
  }

  tell(command: Command): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(command));
  }

  private refuse(because: string): Answer {
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
      this.link.value = "open";
    };
    socket.onclose = () => {
      this.link.value = "lost";
      for (const answer of this.waiting.values()) answer({ done: false, because: "the connection was lost" });
      this.waiting.clear();
      setTimeout(() => this.open(), RETRY[Math.min(this.failures++, RETRY.length - 1)]);
    };
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
        this.arrange(new Layout(message.columns));
        this.hello.value = message;
        break;
      case "world":
        this.smooth?.clear();
        this.histories = [];
        this.moved.value = this.seen.value = this.scan.value = null;
        this.world.value = message;
        break;
      case "done":
      case "refused":
        this.answered(message);
        break;
      default: {
        const known = this.told[message.say] as Signal<unknown> | undefined;
        if (known) known.value = message;
      }
    }
  }

  /** Columns as told in `hello`, which comes again after a reconnection or another role. */
  private arrange(layout: Layout): void {
    if (JSON.stringify(layout.columns) === JSON.stringify(this.layout.value?.columns)) return;
    this.smooth = new Smooth(layout, layout.at("time"));
    this.histories = [];
    this.layout.value = layout;
  }

  private answered(message: Extract<FromServer, { say: "done" | "refused" }>): void {
    const answer: Answer =
      message.say === "done" ? { done: true } : { done: false, because: message.because };
    this.refusal.value = answer.done ? "" : answer.because;
    const waits = message.id === undefined ? undefined : this.waiting.get(message.id);
    if (message.id !== undefined) this.waiting.delete(message.id);
    waits?.(answer);
  }
}
