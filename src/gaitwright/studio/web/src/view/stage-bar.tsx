// Over the views, top right: how many there are, what is laid over them, pictures.

import type { RefObject } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import type { Source } from "../source";
import { Segmented, Switch } from "../ui/controls";
import { Icon } from "../ui/icons";
import { filming, film, photograph } from "./capture";
import type { Engine } from "./engine";
import { OVERLAYS, show, shown, viewCount, watched } from "./settings";

export function StageBar({ source, engine }: { source: Source; engine: RefObject<Engine | null> }) {
  const robots = source.world.value?.robots ?? [];
  return (
    <div class="stage-bar" data-testid="stage-bar">
      {robots.length > 1 && (
        <select
          data-testid="watched"
          title="The robot that is watched"
          value={watched.value}
          onChange={(event) => (watched.value = Number(event.currentTarget.value))}
        >
          {robots.map((robot, k) => (
            <option key={k} value={k}>
              {k + 1} {robot.name}
            </option>
          ))}
        </select>
      )}
      <Segmented<1 | 2 | 4>
        id="views"
        value={viewCount.value}
        choose={(count) => (viewCount.value = count)}
        choices={[
          { value: 1, label: <Icon name="one" />, title: "One view" },
          { value: 2, label: <Icon name="two" />, title: "Two views" },
          { value: 4, label: <Icon name="four" />, title: "Four views" },
        ]}
      />
      <OverlayMenu replay={source.kind === "replay"} />
      <button class="over" title="Save a picture (PNG)" data-testid="photo" onClick={() => engine.current && photograph(engine.current)}>
        <Icon name="photo" />
      </button>
      <button
        class={`over ${filming.value ? "recording" : ""}`}
        title={filming.value ? "Stop filming and save" : "Film the views (WebM)"}
        data-testid="film"
        aria-pressed={filming.value}
        onClick={() => engine.current && film(engine.current)}
      >
        <Icon name={filming.value ? "stop" : "film"} />
      </button>
    </div>
  );
}

/** Overlays that need what only a live studio tells. */
const LIVE = new Set(["seen", "reach", "footholds", "ghost"]);

function OverlayMenu({ replay }: { replay: boolean }) {
  const [open, setOpen] = useState(false);
  const menu = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const close = (event: PointerEvent) => {
      if (!menu.current?.contains(event.target as Node)) setOpen(false);
    };
    addEventListener("pointerdown", close);
    return () => removeEventListener("pointerdown", close);
  }, []);
  return (
    <div class="menu" ref={menu}>
      <button
        class="over"
        title="What is laid over the views"
        data-testid="overlays"
        aria-expanded={open}
        onClick={() => setOpen(!open)}
      >
        <Icon name="layers" />
      </button>
      {open && (
        <div class="menu-list" data-testid="overlay-list">
          {OVERLAYS.filter(({ id }) => !replay || !LIVE.has(id)).map(({ id, label }) => (
            <Switch
              key={id}
              id={`overlay-${id}`}
              label={label}
              on={shown.value[id] ?? false}
              change={(on) => show(id, on)}
            />
          ))}
        </div>
      )}
    </div>
  );
}
