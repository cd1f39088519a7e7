// The bar below a replay: play, speed, and all of time with its skills and drivers.

import { useRef } from "preact/hooks";
import { driverColour, skillColour } from "../ui/colours";
import { number, Segmented } from "../ui/controls";
import { Icon } from "../ui/icons";
import { clock, SPEEDS } from "./clock";
import type { Player } from "./player";
import { stretches } from "./stretches";

export function Scrubber({ players }: { players: Player[] }) {
  const playing = clock.playing.value;
  return (
    <footer class="bottom-bar scrubber" data-testid="scrubber">
      <button class="icon-text" data-testid={playing ? "pause" : "play"} onClick={() => clock.toggle()}>
        <Icon name={playing ? "pause" : "play"} />
        {playing ? "Pause" : "Play"}
      </button>
      <Segmented
        id="speed"
        value={clock.speed.value}
        choose={(speed) => (clock.speed.value = speed)}
        choices={SPEEDS.map((value) => ({ value, label: `${value}×` }))}
      />
      <span class="clock" data-testid="time">
        {number(clock.time.value, 2)}
        <span class="unit"> / {number(clock.duration.value, 1)} s</span>
      </span>
      <Track players={players} />
    </footer>
  );
}

function Track({ players }: { players: Player[] }) {
  const place = useRef<HTMLDivElement>(null);
  const duration = clock.duration.value || 1;
  const seek = (event: PointerEvent) => {
    const box = place.current!.getBoundingClientRect();
    clock.seek(((event.clientX - box.left) / box.width) * duration);
  };
  return (
    <div
      class="track"
      ref={place}
      data-testid="track"
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        seek(event);
      }}
      onPointerMove={(event) => event.buttons && seek(event)}
    >
      {players.map((player, k) => (
        <Bands key={k} player={player} duration={duration} />
      ))}
      <span class="head" style={{ left: `${(100 * clock.time.value) / duration}%` }} />
    </div>
  );
}

function Bands({ player, duration }: { player: Player; duration: number }) {
  const { events, notes } = player.story.value;
  const end = player.duration;
  const bands = (key: "skill" | "driver", colour: (name: string) => string) =>
    stretches(events, key, end).map(({ name, from, to }) => (
      <span
        key={from}
        title={`${name}, ${number(from, 1)} … ${number(to, 1)} s`}
        style={{ left: `${(100 * from) / duration}%`, width: `${(100 * (to - from)) / duration}%`, background: colour(name) }}
      />
    ));
  return (
    <>
      <div class="band skills-band" data-testid="skill-band">
        {bands("skill", skillColour)}
        {notes?.map(({ time, sentence }, k) => (
          <b key={k} title={`${number(time, 1)} s: ${sentence}`} style={{ left: `${(100 * time) / duration}%` }} data-testid="note-mark" />
        ))}
      </div>
      <div class="band driver-band" data-testid="driver-band">
        {bands("driver", driverColour)}
      </div>
    </>
  );
}
