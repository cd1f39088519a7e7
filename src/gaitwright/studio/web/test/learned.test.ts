import { signal } from "@preact/signals";
import { expect, test } from "vitest";
import { gather, Learned, learned } from "../src/map/learned";
import type { Seen } from "../src/protocol";
import type { Source } from "../src/source";

function seen(x: number, y: number, heights: number[], columns: number): Seen {
  const bytes = new Uint8Array(new Float32Array(heights).buffer);
  return {
    say: "seen", x, y, spacing: 0.1, rows: heights.length / columns, columns,
    heights: btoa(String.fromCharCode(...bytes)), obstacles: [], walls: [], walked: [],
  };
}

function heightAt(map: Learned, column: number, row: number): number | undefined {
  for (const tile of map.tiles.values()) {
    const [c, r] = [column - tile.column, row - tile.row];
    if (c >= 0 && r >= 0 && c < 64 && r < 64) return tile.heights[r * 64 + c];
  }
  return undefined;
}

test("what was seen stays known where it is told no more, and what is unknown is not learned", () => {
  const map = new Learned();
  map.add(seen(0, 0, [1, 2, NaN, 4], 2));
  expect(map.known).toBe(3);
  map.add(seen(0.1, 0, [2.5, 7], 2));
  expect(map.known).toBe(4);
  expect([heightAt(map, 0, 0), heightAt(map, 1, 0), heightAt(map, 2, 0), heightAt(map, 1, 1)]).toEqual([1, 2.5, 7, 4]);
  expect(heightAt(map, 0, 1)).toBeNaN();
});

test("places left of and below the origin have tiles of their own", () => {
  const map = new Learned();
  map.add(seen(-0.1, -0.1, [1, 2, 3, 4], 2));
  expect([heightAt(map, -1, -1), heightAt(map, 0, -1), heightAt(map, -1, 0), heightAt(map, 0, 0)]).toEqual([1, 2, 3, 4]);
  expect(map.tiles.size).toBe(4);
});

test("a way is kept as places that lie apart", () => {
  const map = new Learned();
  for (const x of [0, 0.01, 0.1, 0.12, 0.2]) map.at(x, 0);
  expect(map.trail.map(([x]) => x)).toEqual([0, 0.1, 0.2]);
  map.clear();
  expect([map.trail.length, map.known, map.tiles.size]).toEqual([0, 0, 0]);
});

test("a run that begins has learned nothing; a page that was cut off keeps what it has", () => {
  const told = {
    link: signal("open"), hello: signal({}), world: signal(null), status: signal({ time: 5 }), layout: signal(null),
    seen: signal<Seen | null>(null), latest: () => null,
  };
  const stop = gather(told as unknown as Source);
  const begin = (time: number) => {
    told.hello.value = {};
    told.seen.value = null;
    told.status.value = { time };
  };
  const see = () => (told.seen.value = seen(0, 0, [1, 2], 2));
  see();
  expect(learned.known).toBe(2);
  told.link.value = "lost";
  told.link.value = "open";
  begin(6);
  expect(learned.known).toBe(2);
  begin(7); // with the connection there all the time, another run
  expect(learned.known).toBe(0);
  see();
  told.link.value = "lost";
  begin(0.1); // another run that began meanwhile
  expect(learned.known).toBe(0);
  stop();
});
