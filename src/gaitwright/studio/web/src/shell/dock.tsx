// A dock: tabs of panels, a border to drag, and a button to fold it.

import { useRef } from "preact/hooks";
import type { Panel } from "../panels";
import type { Source } from "../source";
import { Icon } from "../ui/icons";
import { dockWidth, folded, setWidth, tabs, type Side } from "./docks";

export function Dock({ side, panels, source }: { side: Side; panels: Panel[]; source: Source }) {
  const mine = panels.filter((panel) => panel.dock === side && (source.kind === "live" || panel.replay));
  const open = mine.find((panel) => panel.id === tabs[side].value) ?? mine[0];
  if (!open) return null;
  if (folded[side].value) {
    return (
      <aside class={`dock folded ${side}`} data-testid={`dock-${side}`}>
        <button
          class="icon"
          title="Unfold"
          data-testid={`unfold-${side}`}
          onClick={() => (folded[side].value = false)}
        >
          <Icon name={side === "left" ? "right" : "left"} />
        </button>
      </aside>
    );
  }
  const View = open.view;
  return (
    <aside class={`dock ${side}`} data-testid={`dock-${side}`}>
      <nav class="tabs" role="tablist">
        {mine.map((panel) => (
          <button
            key={panel.id}
            role="tab"
            class="tab"
            aria-selected={panel === open}
            data-testid={`tab-${panel.id}`}
            onClick={() => (tabs[side].value = panel.id)}
          >
            {panel.title}
          </button>
        ))}
        <span class="spring" />
        <button class="icon" title="Fold" data-testid={`fold-${side}`} onClick={() => (folded[side].value = true)}>
          <Icon name={side} />
        </button>
      </nav>
      <section class="panel" role="tabpanel" data-testid={`panel-${open.id}`} key={open.id}>
        <View source={source} />
      </section>
      <Border side={side} />
    </aside>
  );
}

function Border({ side }: { side: Side }) {
  const from = useRef<{ x: number; width: number } | null>(null);
  return (
    <div
      class="border"
      data-testid={`border-${side}`}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        from.current = { x: event.clientX, width: dockWidth(side) };
      }}
      onPointerMove={(event) => {
        if (!from.current) return;
        const moved = event.clientX - from.current.x;
        setWidth(side, from.current.width + (side === "left" ? moved : -moved));
      }}
      onPointerUp={() => (from.current = null)}
      onPointerCancel={() => (from.current = null)}
    />
  );
}
