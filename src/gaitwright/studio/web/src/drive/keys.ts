// Held keys: W S forward and back, A D turn, Q E sideways; space stands.

import { effect } from "@preact/signals";
import { drives, type Source } from "../source";
import type { Steering, Velocity } from "./steering";

const KEYS: Record<string, Partial<Velocity>> = {
  KeyW: { forward: 1 }, KeyS: { forward: -1 }, KeyA: { turn: 1 }, KeyD: { turn: -1 },
  KeyQ: { left: 1 }, KeyE: { left: -1 },
};

export function listenToKeys(steering: Steering, source: Source): () => void {
  const down = new Set<string>();

  const tell = () => {
    if (!down.size) return steering.hold("keys", null);
    const sum: Velocity = { forward: 0, left: 0, turn: 0 };
    for (const code of down) {
      for (const [name, value] of Object.entries(KEYS[code])) sum[name as keyof Velocity] += value;
    }
    steering.hold("keys", sum);
  };
  const press = (event: KeyboardEvent) => {
    if (event.ctrlKey || event.metaKey || event.altKey || writes(event.target)) return;
    if (source.role.peek().role !== "driver") return;
    if (event.code === "Space" && !event.repeat) {
      event.preventDefault();
      down.clear();
      steering.release();
      void source.send({ do: "stand" });
    }
    if (!(event.code in KEYS) || event.repeat) return;
    event.preventDefault();
    down.add(event.code);
    tell();
  };
  const lift = (event: KeyboardEvent) => {
    if (down.delete(event.code)) tell();
  };
  const lose = () => {
    down.clear();
    steering.release();
  };
  const hidden = () => {
    if (document.hidden) lose();
  };
  // keys that are still down when the wheel comes back do not move the robot
  const watching = effect(() => {
    if (!drives(source)) lose();
  });
  // a list that was used gives the keys back
  const used = (event: Event) => {
    if (event.target instanceof HTMLSelectElement) event.target.blur();
  };
  document.addEventListener("change", used);
  addEventListener("keydown", press);
  addEventListener("keyup", lift);
  addEventListener("blur", lose);
  document.addEventListener("visibilitychange", hidden);
  return () => {
    watching();
    document.removeEventListener("change", used);
    removeEventListener("keydown", press);
    removeEventListener("keyup", lift);
    removeEventListener("blur", lose);
    document.removeEventListener("visibilitychange", hidden);
  };
}

/** Whether keys belong to what has the focus. */
export function writes(target: EventTarget | null): boolean {
  if (!(target instanceof HTMLElement)) return false;
  const { tagName } = target;
  const written = target instanceof HTMLInputElement && !["range", "checkbox", "radio"].includes(target.type);
  return written || tagName === "TEXTAREA" || tagName === "SELECT" || target.isContentEditable;
}
