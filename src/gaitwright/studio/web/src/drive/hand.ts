// The mouse on the views of a live studio: go, push, move and place boxes.

import { effect } from "@preact/signals";
import { drives, type Source } from "../source";
import { isMoving } from "../view/boxes";
import type { Engine } from "../view/engine";
import { taken } from "../view/camera-hand";
import type { Rig } from "../view/rig";
import { watched } from "../view/settings";
import type { Tools } from "../view/stage";
import { BoxDrag } from "./box-drag";
import { aim, pick, type Picked } from "./pick";
import { chosen, placing } from "./placing";
import { PlacingGhost } from "./placing-ghost";
import { PushDrag } from "./push-drag";

const CLICK = 5;

/** What goes on between pressing and letting go. */
export interface Drag {
  move(event: PointerEvent): void;
  end(event: PointerEvent, moved: boolean): void;
  wheel?(event: WheelEvent): void;
  cancel(): void;
}

export function tools(source: Source): Tools {
  return {
    hold: (engine, _view, place, rig) => hold(source, engine, place, rig),
  };
}

function hold(source: Source, engine: Engine, place: HTMLElement, rig: Rig): () => void {
  let drag: Drag | null = null;
  let from: { x: number; y: number; picked: Picked | null } | null = null;
  const ghost = new PlacingGhost(engine);
  const far = (event: PointerEvent) => !from || Math.hypot(event.clientX - from.x, event.clientY - from.y) > CLICK;

  const down = (event: PointerEvent) => {
    if (event.button !== 0 || event.target !== place || !drives(source)) return;
    const picked = pick(engine, aim(event, place, rig), rig);
    from = { x: event.clientX, y: event.clientY, picked };
    if (placing.peek()) return;
    if (picked?.kind === "robot" && picked.robot === engine.watched) drag = new PushDrag(source, engine, place, rig);
    if (picked?.kind === "box" && !isMoving(picked.box.id)) drag = new BoxDrag(source, engine, place, rig, picked);
    if (!drag) return;
    taken.add(event);
    place.setPointerCapture(event.pointerId);
  };
  const move = (event: PointerEvent) => {
    if (drag) {
      if (far(event)) drag.move(event);
    } else if (event.buttons === 0) hover(event);
  };
  const hover = (event: PointerEvent) => {
    const over = event.target === place && drives(source) ? pick(engine, aim(event, place, rig), rig) : null;
    place.classList.toggle("over-robot", over?.kind === "robot" && !placing.peek());
    place.classList.toggle("over-box", over?.kind === "box" && !isMoving(over.box.id) && !placing.peek());
    place.classList.toggle("over-ground", over?.kind === "ground" || placing.peek());
    if (placing.peek() && over) ghost.show(over.at);
    else ghost.hide();
  };
  const up = (event: PointerEvent) => {
    const moved = far(event);
    if (drag) drag.end(event, moved);
    else if (from && !moved && event.button === 0) click(event, from.picked);
    drag = null;
    from = null;
  };
  const click = (event: PointerEvent, picked: Picked | null) => {
    if (picked?.kind === "robot") watched.value = picked.robot;
    if (!picked || picked.kind === "robot") return;
    if (placing.peek()) {
      ghost.place(source, picked.at);
      return;
    }
    chosen.value = null;
    if (picked.kind === "box") chosen.value = picked.box.id;
    const then = event.shiftKey ? { then: true } : {};
    void source.send({ do: "go", x: picked.at.x, y: picked.at.y, ...then });
  };
  const wheel = (event: WheelEvent) => {
    if (!drag?.wheel) return;
    taken.add(event);
    event.preventDefault();
    drag.wheel(event);
  };
  // what was begun is not done; letting go afterwards is no click
  const lost = () => {
    drag?.cancel();
    drag = null;
    from = null;
  };
  const stop = (event: KeyboardEvent) => {
    if (event.key !== "Escape") return;
    lost();
    placing.value = false;
    ghost.hide();
  };
  const watching = effect(() => {
    if (drives(source)) return;
    lost();
    placing.value = false;
    ghost.hide();
  });
  const leave = () => ghost.hide();
  const light = effect(() => {
    const id = chosen.value;
    source.boxes.value; // boxes that are new do not know it
    engine.scenery?.boxes.light(id);
  });
  place.addEventListener("pointerdown", down);
  place.addEventListener("pointermove", move);
  place.addEventListener("pointerup", up);
  place.addEventListener("pointercancel", lost);
  place.addEventListener("pointerleave", leave);
  place.addEventListener("wheel", wheel, { passive: false });
  addEventListener("keydown", stop);
  return () => {
    place.removeEventListener("pointerdown", down);
    place.removeEventListener("pointermove", move);
    place.removeEventListener("pointerup", up);
    place.removeEventListener("pointercancel", lost);
    place.removeEventListener("pointerleave", leave);
    place.removeEventListener("wheel", wheel);
    removeEventListener("keydown", stop);
    watching();
    light();
    ghost.dispose();
  };
}
