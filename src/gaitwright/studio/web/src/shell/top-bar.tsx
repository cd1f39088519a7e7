// The bar above: who has authority over the joints, always; mode and driver; the link; the theme.

import type { Mode } from "../protocol";
import { drives, type Source } from "../source";
import { driverColour, skillColour } from "../ui/colours";
import { number, Segmented, Select } from "../ui/controls";
import { Icon } from "../ui/icons";
import { DRIVERS, explained, MODES } from "../ui/words";
import { switchTheme, theme } from "./theme";

export function TopBar({ source }: { source: Source }) {
  const world = source.world.value;
  return (
    <header class="top-bar" data-testid="top-bar">
      <span class="brand">Gaitwright</span>
      <span class="scene" data-testid="scene">
        {world ? world.scene : "…"}
        {world && world.robots.length > 0 && <span class="faint"> · {nameOf(world.robots)}</span>}
      </span>
      <Authority source={source} />
      <Composing source={source} />
      <span class="spring" />
      {source.kind === "live" && <Choices source={source} />}
      {source.kind === "live" && <LinkState source={source} />}
      <button class="icon" title="Light or dark" data-testid="theme" onClick={switchTheme}>
        <Icon name={theme.value === "dark" ? "sun" : "moon"} />
      </button>
    </header>
  );
}

function nameOf(robots: { name: string }[]): string {
  return robots.length === 1 ? robots[0].name : `${robots.length} robots`;
}

/** Who computes the torques now. */
function Authority({ source }: { source: Source }) {
  const status = source.status.value;
  const controller = status?.controller ?? "";
  const asked = status && status.driver !== controller ? status.driver : "";
  return (
    <div
      class="authority"
      data-testid="authority"
      data-controller={controller}
      style={{ "--who": driverColour(controller) }}
    >
      <span class="lamp" />
      <span class="authority-label" title="Who computes the torques of the joints now">
        Joints
      </span>
      <strong data-testid="controller" title={explained(controller, DRIVERS)}>
        {controller || "nobody"}
      </strong>
      {asked && (
        <span class="faint asked" title={explained(asked, DRIVERS)}>
          for {asked}
        </span>
      )}
      {status?.skill && (
        <span class="chip" data-testid="skill" style={{ "--chip": skillColour(status.skill) }}>
          {status.skill}
        </span>
      )}
    </div>
  );
}

/** That what a person asks for is being noted, or played back. */
function Composing({ source }: { source: Source }) {
  const status = source.status.value;
  if (!status?.composing && !status?.playing) return null;
  const done = number(status.composing ? status.composed_seconds : status.played_seconds, 1);
  return (
    <span class={`composing ${status.composing ? "on" : ""}`} data-testid="composing">
      <i />
      {status.composing ? `composing ${done} s` : `playing ${done} of ${number(status.composed_seconds, 1)} s`}
    </span>
  );
}

function Choices({ source }: { source: Source }) {
  const hello = source.hello.value;
  const status = source.status.value;
  if (!hello || !status) return null;
  const watching = !drives(source);
  return (
    <>
      <Segmented<Mode>
        id="mode"
        choices={hello.choices.modes.map((mode) => ({ value: mode, title: MODES[mode] }))}
        value={status.mode}
        choose={(mode) => void source.send({ do: "mode", mode })}
        disabled={watching}
      />
      <Select
        id="driver"
        title={`Who is to compute the torques of the joints\n${explained(status.driver, DRIVERS)}`}
        titles={DRIVERS}
        choices={hello.choices.drivers}
        value={status.driver}
        choose={(driver) => void source.send({ do: "drive", driver })}
        disabled={watching}
      />
    </>
  );
}

function LinkState({ source }: { source: Source }) {
  const link = source.link.value;
  const { role, has_driver, watchers } = source.role.value;
  const others = watchers === 1 ? "one more page is open" : `${watchers} more pages are open`;
  return (
    <span class="link" data-testid="link" data-link={link} title={watchers ? others : ""}>
      <span class={`dot ${link}`} />
      {link !== "open" ? (
        link === "lost" ? "no connection" : "connecting"
      ) : role === "driver" ? (
        <>
          <span class="link-word">you drive</span>
          <button
            title="Gives the wheel away: this page only watches then, until it takes over again"
            data-testid="release"
            onClick={() => void source.send({ do: "release" })}
          >
            Let go
          </button>
        </>
      ) : (
        <>
          <span class="link-word">{has_driver ? "you watch" : "nobody drives"}</span>
          <button
            title={has_driver ? "Takes the wheel from the page that drives now" : "This page drives then"}
            data-testid="take"
            onClick={() => void source.send({ do: "take" })}
          >
            Take over
          </button>
        </>
      )}
    </span>
  );
}
