// Mouse and fingers on a view, where no tool has taken them: turn, move, zoom.

import type { Rig } from "./rig";

/** Set on an event that a tool has taken. */
export const taken = new WeakSet<Event>();

export function moveCamera(place: HTMLElement, rig: Rig): () => void {
  const fingers = new Map<number, { x: number; y: number }>();
  let pans = false;

  const down = (event: PointerEvent) => {
    if (taken.has(event)) return;
    if (fingers.size === 0) pans = event.button !== 0 || event.ctrlKey;
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    place.setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    const [dx, dy] = [event.clientX - before.x, event.clientY - before.y];
    const wide = spread(fingers);
    fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    if (fingers.size === 2) {
      rig.zoom(Math.log(wide / Math.max(1, spread(fingers))));
      rig.pan(dx / 2, dy / 2, place.clientHeight);
    } else if (pans) rig.pan(dx, dy, place.clientHeight);
    else rig.orbit(dx, dy, place.clientHeight);
  };
  const up = (event: PointerEvent) => fingers.delete(event.pointerId);
  const wheel = (event: WheelEvent) => {
    if (taken.has(event)) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 18 : 1;
    rig.zoom(Math.max(-0.5, Math.min(0.5, 0.0012 * lines * event.deltaY)));
  };
  const menu = (event: Event) => event.preventDefault();
  const again = () => rig.become(rig.kind);

  place.addEventListener("pointerdown", down);
  place.addEventListener("pointermove", move);
  place.addEventListener("pointerup", up);
  place.addEventListener("pointercancel", up);
  place.addEventListener("wheel", wheel, { passive: false });
  place.addEventListener("contextmenu", menu);
  place.addEventListener("dblclick", again);
  return () => {
    place.removeEventListener("pointerdown", down);
    place.removeEventListener("pointermove", move);
    place.removeEventListener("pointerup", up);
    place.removeEventListener("pointercancel", up);
    place.removeEventListener("wheel", wheel);
    place.removeEventListener("contextmenu", menu);
    place.removeEventListener("dblclick", again);
  };
}

function spread(fingers: Map<number, { x: number; y: number }>): number {
  const [a, b] = [...fingers.values()];
  return a && b ? Math.hypot(a.x - b.x, a.y - b.y) : 1;
}
