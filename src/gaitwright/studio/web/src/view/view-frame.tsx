// One view: where it is on the page, its camera's name, and how its camera is moved.

import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import type { Source } from "../source";
import { moveCamera } from "./camera-hand";
import type { Engine } from "./engine";
import { type Kind, KINDS, type Rig } from "./rig";
import { kinds, look, watched } from "./settings";
import { SeeThrough } from "./see-through";
import type { Tools } from "./stage";

const NAMES: Record<Kind, string> = {
  follow: "Following", free: "Free", top: "Top", side: "Side", foot: "Foot",
};

export function ViewFrame(props: {
  index: number;
  rig: Rig;
  engine: RefObject<Engine | null>;
  source: Source;
  tools?: Tools;
}) {
  const { index, rig, engine, source, tools } = props;
  const place = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const made = engine.current;
    if (!made) return;
    const element = place.current!;
    const view = { rig, place: element, through: new SeeThrough() };
    made.views.push(view);
    const letGo = [tools?.hold(made, index, element, rig), moveCamera(element, rig)];
    return () => {
      made.views = made.views.filter((one) => one !== view);
      for (const go of letGo) go?.();
    };
  }, []);
  const kind = kinds.value[index];
  const legs = source.world.value?.robots[watched.value]?.legs ?? [];
  return (
    <div class="view" ref={place} data-testid={`view-${index}`} data-camera={kind}>
      <div class="view-head" onPointerDown={(event) => event.stopPropagation()}>
        <select
          data-testid={`camera-${index}`}
          value={kind}
          title="Camera: drag turns, right button moves, wheel zooms, double click: as it was at first"
          onChange={(event) => look(index, event.currentTarget.value as Kind)}
        >
          {KINDS.map((one) => (
            <option key={one} value={one}>
              {NAMES[one]}
            </option>
          ))}
        </select>
        {kind === "foot" && (
          <select
            data-testid={`foot-${index}`}
            value={Math.min(rig.leg, legs.length - 1)}
            onChange={(event) => (rig.leg = Number(event.currentTarget.value))}
          >
            {legs.map((leg, k) => (
              <option key={leg} value={k}>
                {leg}
              </option>
            ))}
          </select>
        )}
      </div>
    </div>
  );
}
