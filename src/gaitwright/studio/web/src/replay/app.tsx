// The replay page: views in the middle, plots and rules at the right, the scrubber below; two recordings side
// by side once a second one is dropped onto it.

import { signal } from "@preact/signals";
import { useEffect, useLayoutEffect, useState } from "preact/hooks";
import { Dock } from "../shell/dock";
import { dockWidth } from "../shell/docks";
import { switchTheme, theme } from "../shell/theme";
import { PlotsPanel } from "../plots/panel";
import { driverColour, skillColour } from "../ui/colours";
import { Icon } from "../ui/icons";
import { watched } from "../view/settings";
import { Stage } from "../view/stage";
import type { Panel } from "../panels";
import { clock } from "./clock";
import { dropped } from "./embedded";
import { listenToKeys } from "./keys";
import type { Player } from "./player";
import { Report } from "./report";
import { RulesOverTime } from "./rules";
import { Scrubber } from "./scrubber";

const panels: Panel[] = [
  { id: "replay-plots", title: "Plots", dock: "right", view: PlotsPanel, replay: true },
  { id: "replay-rules", title: "Rules", dock: "right", view: RulesOverTime, replay: true },
  { id: "replay-report", title: "Report", dock: "right", view: Report, replay: true },
];

const trouble = signal("");

export function ReplayApp({ first }: { first: Player }) {
  const [second, setSecond] = useState<Player | null>(null);
  const [shown, setShown] = useState(0);
  const [over, setOver] = useState(false);
  useEffect(() => listenToKeys(clock, first.recording.rate), [first]);
  useEffect(() => clock.run(), []);
  const players = second ? [first, second] : [first];
  useLayoutEffect(() => clock.lasts(Math.max(...players.map(({ duration }) => duration))), [first, second]);
  const drop = async (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    const file = event.dataTransfer?.files[0];
    if (!file) return;
    const found = await dropped(file, clock);
    trouble.value = typeof found === "string" ? `${file.name}: ${found}` : "";
    if (typeof found !== "string") setSecond(found);
  };
  return (
    <div
      class={`app replay ${over ? "drop" : ""}`}
      style={{ "--left": "0px", "--right": `${dockWidth("right")}px` }}
      data-testid="replay"
      onDragOver={(event) => {
        event.preventDefault();
        setOver(true);
      }}
      onDragLeave={() => setOver(false)}
      onDrop={(event) => void drop(event)}
    >
      <header class="top-bar">
        <span class="brand">Gaitwright</span>
        {players.length === 1 && <Head player={first} />}
        <span class="spring" />
        {trouble.value && (
          <span class="message bad" data-testid="trouble">
            {trouble.value}
          </span>
        )}
        {second ? (
          <>
            <span class="faint">plots of</span>
            {players.map((_, k) => (
              <button key={k} aria-pressed={shown === k} data-testid={`shown-${k}`} onClick={() => setShown(k)}>
                {"AB"[k]}
              </button>
            ))}
            <button data-testid="compare-end" onClick={() => (setSecond(null), setShown(0))}>
              End comparison
            </button>
          </>
        ) : (
          <span class="faint hint-drop">drop another replay here to compare</span>
        )}
        <button class="icon" title="Light or dark" data-testid="theme" onClick={switchTheme}>
          <Icon name={theme.value === "dark" ? "sun" : "moon"} />
        </button>
      </header>
      <main class={`middle side-by-side many-${players.length}`}>
        {players.map((player, k) => (
          <section class="one" key={k} data-testid={`player-${k}`}>
            {second && (
              <div class="one-head">
                <b>{"AB"[k]}</b>
                <Head player={player} />
              </div>
            )}
            <div class="one-stage">
              <Stage source={player} key={player.recording.title + k} />
            </div>
          </section>
        ))}
      </main>
      <Dock side="right" panels={panels} source={players[Math.min(shown, players.length - 1)]} key={shown} />
      <Scrubber players={players} />
    </div>
  );
}

function Head({ player }: { player: Player }) {
  const status = player.status.value;
  return (
    <>
      <span class="scene" title={player.story.value.title}>
        {player.count > 1 && `${watched.value + 1} of ${player.count} · `}
        {player.story.value.title}
      </span>
      <div class="authority" data-testid="authority" style={{ "--who": driverColour(status.controller) }}>
        <span class="lamp" />
        <span class="authority-label">Joints</span>
        <strong data-testid="controller">{status.controller || "nobody"}</strong>
        {status.skill && (
          <span class="chip" style={{ "--chip": skillColour(status.skill) }}>
            {status.skill}
          </span>
        )}
      </div>
    </>
  );
}
