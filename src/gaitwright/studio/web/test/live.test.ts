// The connection: what a run that begins makes void, and why there is none.

import { afterEach, beforeEach, expect, test, vi } from "vitest";
import { HEADER } from "../src/frame";
import { Live } from "../src/live";

class Socket {
  static last: Socket;
  static readonly OPEN = 1;
  readyState = 1;
  onmessage!: (event: { data: unknown }) => void;
  onopen!: () => void;
  onclose!: (event: { reason: string }) => void;

  constructor() {
    Socket.last = this;
  }

  hear(message: object): void {
    this.onmessage({ data: JSON.stringify(message) });
  }
}

function frame(time: number): ArrayBuffer {
  const view = new DataView(new ArrayBuffer(HEADER + 4));
  view.setUint8(0, 1);
  view.setUint16(2, 1, true);
  view.setFloat64(8, time, true);
  view.setFloat32(HEADER, time, true);
  return view.buffer;
}

const HELLO = { say: "hello", version: 1, columns: [{ name: "time", size: 1 }], choices: {} };
const ADDRESS = "ws://here/live?token=t";

let status = 0;

beforeEach(() => {
  vi.useFakeTimers();
  vi.stubGlobal("WebSocket", Socket);
  vi.stubGlobal("window", globalThis);
  vi.stubGlobal("location", { href: "http://here/?token=t" });
  vi.stubGlobal("fetch", () => (status ? Promise.resolve({ status }) : Promise.reject(new Error("nobody"))));
});
afterEach(() => {
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

test("a run that begins leaves nothing of the one before", () => {
  const live = new Live(ADDRESS);
  const { last } = Socket;
  last.onopen();
  last.hear(HELLO);
  for (const time of [1, 1.1]) last.onmessage({ data: frame(time) });
  last.hear({ say: "tried", proposed: true, lesson: "l1" });
  last.hear({ say: "scan" });
  last.hear({ say: "closed", because: "the robot is gone" });
  expect([live.now(), live.count, live.closed.value]).toEqual([expect.closeTo(1.1), 1, "the robot is gone"]);
  last.hear(HELLO);
  expect([live.now(), live.count, live.history(0), live.closed.value]).toEqual([0, 0, null, ""]);
  expect([live.tried.value, live.scan.value, live.seen.value]).toEqual([null, null, null]);
  last.onmessage({ data: frame(0.002) });
  expect(live.count).toBe(1);
});

test.each([
  [0, /no studio answers/], [403, /another address/], [404, /no room/],
])("without a connection it says why: %d", async (answered, because) => {
  status = answered;
  const live = new Live(ADDRESS);
  for (let k = 0; k < 2; k++) {
    Socket.last.onclose({ reason: "" });
    await vi.advanceTimersByTimeAsync(600);
  }
  expect(live.lost.value).toMatch(because);
  Socket.last.onopen();
  expect(live.lost.value).toBe("");
});

test("a studio that says why it closes is believed", () => {
  const live = new Live(ADDRESS);
  Socket.last.onclose({ reason: "64 pages are open" });
  expect(live.lost.value).toBe("64 pages are open");
});

test("a robot that says nothing for long is said to be silent, until it is heard again", () => {
  const live = new Live(ADDRESS);
  Socket.last.onopen();
  Socket.last.hear(HELLO);
  vi.advanceTimersByTime(60_000);
  expect(live.silent.value).toBe(""); // it has not begun yet
  Socket.last.hear({ say: "status", time: 1 });
  vi.advanceTimersByTime(29_000);
  expect(live.silent.value).toBe("");
  vi.advanceTimersByTime(2_000);
  expect(live.silent.value).toMatch(/said nothing/);
  Socket.last.hear({ say: "status", time: 1 });
  expect(live.silent.value).toBe("");
});
