// The world: reset with which robot where, boxes.

import { useState } from "preact/hooks";
import { drives, type Source } from "../source";
import { number, Section, Select, Field, Segmented, Slider } from "../ui/controls";
import { chosen, placing, size } from "./placing";

export function WorldPanel({ source }: { source: Source }) {
  const watching = !drives(source);
  return (
    <>
      <Setup source={source} watching={watching} />
      <NewBox watching={watching} />
      <ChosenBox source={source} watching={watching} />
    </>
  );
}

function Setup({ source, watching }: { source: Source; watching: boolean }) {
  const choices = source.hello.value?.choices;
  const world = source.world.value;
  const setup = source.status.value?.setup;
  const [robot, setRobot] = useState("");
  const [scene, setScene] = useState("");
  const [seed, setSeed] = useState<number | null>(null);
  const [sight, setSight] = useState<"known" | "camera" | "">("");
  if (!choices || !world) return null;
  const now = {
    robot: robot || setup?.robot || world.robots[0]?.name || "",
    scene: scene || setup?.scene || world.scene,
    seed: seed ?? setup?.seed ?? world.seed,
    sight: sight || setup?.sight || "known",
  };
  const about = choices.scenes?.find(({ name }) => name === now.scene.split(":")[0])?.about;
  return (
    <Section title="Reset with">
      <Field label="Robot">
        <Name id="reset-robot" choices={choices.robots} value={now.robot} choose={setRobot} disabled={watching} />
      </Field>
      <Field label="Scene">
        <Name
          id="reset-scene"
          choices={choices.scenes?.map(({ name }) => name)}
          value={now.scene}
          choose={setScene}
          disabled={watching}
        />
      </Field>
      {about && <p class="faint about">{about}</p>}
      <Field label="Seed">
        <input
          type="number"
          min={0}
          step={1}
          data-testid="reset-seed"
          value={now.seed}
          disabled={watching}
          onChange={(event) => setSeed(Math.max(0, Math.floor(event.currentTarget.valueAsNumber || 0)))}
        />
      </Field>
      <Field label="Ground">
        <Segmented
          id="reset-sight"
          value={now.sight}
          choose={setSight}
          disabled={watching}
          choices={[
            { value: "known", title: "The robot knows the ground" },
            { value: "camera", title: "It knows what its camera sees" },
          ]}
        />
      </Field>
      <button
        class="primary wide"
        data-testid="reset-with"
        disabled={watching}
        onClick={() => {
          chosen.value = null;
          void source.send({ do: "reset", ...now });
        }}
      >
        Reset
      </button>
    </Section>
  );
}

/** A name to choose, or to write where nobody says what there is. */
function Name(props: {
  id: string;
  choices?: string[];
  value: string;
  choose: (name: string) => void;
  disabled: boolean;
}) {
  if (props.choices?.length) return <Select {...props} choices={props.choices} />;
  return (
    <input
      type="text"
      data-testid={props.id}
      value={props.value}
      disabled={props.disabled}
      onChange={(event) => props.choose(event.currentTarget.value.trim())}
    />
  );
}

function NewBox({ watching }: { watching: boolean }) {
  return (
    <Section title="New box">
      <Slider id="box-long" label="Length" unit="m" least={0.05} most={2} step={0.05} value={size.long.value} change={(v) => (size.long.value = v)} />
      <Slider id="box-wide" label="Width" unit="m" least={0.05} most={2} step={0.05} value={size.wide.value} change={(v) => (size.wide.value = v)} />
      <Slider id="box-high" label="Height" unit="m" least={0.01} most={1} step={0.01} value={size.high.value} change={(v) => (size.high.value = v)} />
      <Slider id="box-yaw" label="Turned" unit="°" least={-90} most={90} step={5} digits={0} value={size.yaw.value} change={(v) => (size.yaw.value = v)} />
      <button
        class="wide"
        data-testid="place"
        aria-pressed={placing.value}
        disabled={watching}
        onClick={() => (placing.value = !placing.value)}
      >
        {placing.value ? "Click where it is to stand" : "Place a box"}
      </button>
    </Section>
  );
}

function ChosenBox({ source, watching }: { source: Source; watching: boolean }) {
  const box = source.boxes.value.find(({ id }) => id === chosen.value);
  const count = source.boxes.value.length;
  return (
    <Section title="Boxes" aside={`${count}`}>
      {box ? (
        <>
          <p class="about">
            Box {box.id}: {number(box.lx)} × {number(box.ly)} × {number(box.lz)} m
          </p>
          <button
            class="wide"
            data-testid="remove"
            disabled={watching}
            onClick={() => {
              chosen.value = null;
              void source.send({ do: "remove", thing: box.id });
            }}
          >
            Take it away
          </button>
        </>
      ) : (
        <p class="faint about">{count ? "Click a box to choose it, drag it to move it." : "There is none."}</p>
      )}
    </Section>
  );
}
