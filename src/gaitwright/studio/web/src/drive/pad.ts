// A game-pad: left stick forward and sideways, right stick turns, the lowest button stands.

import { signal } from "@preact/signals";
import type { Source } from "../source";
import type { Steering } from "./steering";

const DEAD = 0.12;

/** Name of the game-pad; "" where there is none. */
export const padName = signal("");

export function listenToPad(steering: Steering, source: Source): () => void {
  let timer = 0;
  let pressed = false;
  let holding = false;

  const read = () => {
    const pad = navigator.getGamepads().find((one) => one?.connected);
    padName.value = pad?.id ?? "";
    const away = !pad || !document.hasFocus() || source.role.peek().role !== "driver";
    const [x, y, turn] = away ? [0, 0, 0] : [0, 1, 2].map((axis) => dead(pad.axes[axis] ?? 0));
    const held = x !== 0 || y !== 0 || turn !== 0;
    if (held) steering.hold("pad", { forward: -y, left: -x, turn: -turn });
    else if (holding) steering.hold("pad", null);
    holding = held;
    const stand = !away && Boolean(pad.buttons[0]?.pressed);
    if (stand && !pressed) void source.send({ do: "stand" });
    pressed = stand;
  };
  const begin = () => {
    clearInterval(timer);
    timer = window.setInterval(read, 50);
  };
  const end = () => {
    read();
    if (!navigator.getGamepads().some(Boolean)) clearInterval(timer);
  };
  addEventListener("gamepadconnected", begin);
  addEventListener("gamepaddisconnected", end);
  return () => {
    clearInterval(timer);
    removeEventListener("gamepadconnected", begin);
    removeEventListener("gamepaddisconnected", end);
  };
}

function dead(value: number): number {
  const size = Math.abs(value);
  return size < DEAD ? 0 : (Math.sign(value) * (size - DEAD)) / (1 - DEAD);
}
