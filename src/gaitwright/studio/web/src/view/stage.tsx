// The middle of the page: one canvas, and one to four views over it.

import { effect } from "@preact/signals";
import { useLayoutEffect, useRef, useState } from "preact/hooks";
import { theme } from "../shell/theme";
import type { Source } from "../source";
import { Engine } from "./engine";
import { Rig } from "./rig";
import { kinds, viewCount, watched } from "./settings";
import { StageBar } from "./stage-bar";
import { ViewFrame } from "./view-frame";

export interface Tools {
  /** Takes hold of a view; gives back what lets go of it. */
  hold(engine: Engine, view: number, place: HTMLElement, rig: Rig): () => void;
}

export function Stage({ source, tools }: { source: Source; tools?: Tools }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const engine = useRef<Engine | null>(null);
  const rigs = useRef<Rig[]>([]);
  const [blind, setBlind] = useState(false);
  if (!rigs.current.length) rigs.current = kinds.peek().map((kind) => new Rig(kind));

  // before the views, which need it
  useLayoutEffect(() => {
    let made: Engine;
    try {
      made = new Engine(canvas.current!, source);
    } catch {
      setBlind(true); // no WebGL: everything else works
      return;
    }
    engine.current = made;
    const stops = [
      effect(() => made.dye(theme.value)),
      effect(() => made.arrange(source.world.value)),
      effect(() => {
        const boxes = source.boxes.value;
        made.scenery?.boxes.replace(boxes);
      }),
      effect(() => {
        const things = source.moved.value?.things ?? [];
        made.scenery?.boxes.move(things);
      }),
      effect(() => {
        made.watched = watched.value;
      }),
      effect(() => {
        kinds.value.forEach((kind, k) => {
          if (rigs.current[k].kind !== kind) rigs.current[k].become(kind);
        });
      }),
    ];
    made.start();
    return () => {
      for (const stop of stops) stop();
      made.stop();
    };
  }, [source]);

  const count = viewCount.value;
  return (
    <div class="stage" data-testid="stage">
      <canvas ref={canvas} class="stage-canvas" data-testid="canvas" />
      <div class={`views views-${count}`}>
        {rigs.current.slice(0, count).map((rig, k) => (
          <ViewFrame key={k} index={k} rig={rig} engine={engine} source={source} tools={tools} />
        ))}
      </div>
      <StageBar source={source} engine={engine} />
      {blind && (
        <p class="waiting" data-testid="blind">
          This browser shows no 3-D (WebGL is off); all else works.
        </p>
      )}
      {!blind && <Waiting source={source} />}
    </div>
  );
}

/** What is waited for, as long as something is. */
function Waiting({ source }: { source: Source }) {
  const because = source.waits.value?.because || (source.world.value ? "" : "waiting for the world …");
  return because ? (
    <p class="waiting" data-testid="waiting">
      {because}
    </p>
  ) : null;
}
