// Curves: the leg cycle, joint angles and torques of a skill, point by point.

import { useEffect, useMemo } from "preact/hooks";
import { writes } from "../drive/keys";
import type { CurveKind, Preview } from "../protocol";
import { drives, type Source } from "../source";
import { Field, number, Segmented, Switch } from "../ui/controls";
import { Icon } from "../ui/icons";
import { Chart } from "./chart";
import * as desk from "./desk";
import { drawingsOf } from "./drawings";
import "./curves.css";

const EVERY = 1000;
const KINDS: { value: CurveKind; label: string; title: string }[] = [
  { value: "cycle", label: "Leg cycle", title: "The path of a foot" },
  { value: "angle", label: "Angles", title: "Joint angles over the phase" },
  { value: "torque", label: "Torques", title: "Torques over the phase: a learned profile" },
];

export function CurvesPanel({ source }: { source: Source }) {
  const driving = drives(source);
  useLooking(source);
  useKeys(source, driving);
  const curve = desk.curve.value;
  const seen = desk.preview.value;
  const drawings = useMemo(() => (curve ? drawingsOf(curve, seen) : []), [curve, seen]);
  return (
    <div class="curves" data-testid="curves">
      <Choice source={source} />
      <Tools source={source} disabled={!driving} />
      {source.curve.value?.faults?.map((sentence) => (
        <p class="warning" data-testid="curve-fault" key={sentence}>
          {sentence}
        </p>
      ))}
      {curve?.kind === "cycle" && <Ahead source={source} disabled={!driving} />}
      {!curve && <p class={desk.missing.value ? "refusal nothing" : "faint nothing"} data-testid="curve-missing">
        {desk.missing.value || "looking …"}
      </p>}
      {drawings.map((drawing) => (
        <Chart key={drawing.id} source={source} disabled={!driving} drawing={drawing} />
      ))}
      {curve && <Outcome />}
      {curve && <Hints />}
    </div>
  );
}

/** Looks again now and then, for what is measured, and whenever something was edited. */
function useLooking(source: Source): void {
  const edits = source.curve.value?.edits;
  const link = source.link.value;
  const robot = source.world.value?.robots[0];
  const skills = source.hello.value?.choices.skills;
  useEffect(() => {
    if (robot && skills) desk.fit(robot, skills);
  }, [robot, skills]);
  useEffect(() => {
    if (link === "open") void desk.look(source);
    const timer = setInterval(() => {
      const still = source.status.peek()?.paused || document.hidden || desk.dragged.peek() || desk.busy.peek();
      if (link === "open" && !still) void desk.look(source);
    }, EVERY);
    return () => clearInterval(timer);
  }, [source, link, edits, source.curve.value?.pending, robot]);
}

/** Ctrl-Z and Ctrl-Y. */
function useKeys(source: Source, driving: boolean): void {
  useEffect(() => {
    const press = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey || writes(event.target) || !driving) return;
      const key = event.key.toLowerCase();
      const how = key === "y" || (key === "z" && event.shiftKey) ? "redo" : key === "z" ? "undo" : null;
      if (!how) return;
      event.preventDefault();
      void desk.step(source, how);
    };
    addEventListener("keydown", press);
    return () => removeEventListener("keydown", press);
  }, [source, driving]);
}

function Choice({ source }: { source: Source }) {
  const skills = source.hello.value?.choices.skills ?? [];
  const legs = source.world.value?.robots[0]?.legs ?? [];
  const now = source.status.value?.skill;
  return (
    <div class="curves-choice">
      <Segmented
        id="curve-kind"
        value={desk.kind.value}
        choices={KINDS}
        choose={(value) => desk.choose(source, () => (desk.kind.value = value))}
      />
      <Field label="Skill">
        <select
          data-testid="curve-skill"
          value={skills.includes(desk.skill.value) ? desk.skill.value : ""}
          onChange={(event) => {
            const { value } = event.currentTarget;
            desk.choose(source, () => (desk.skill.value = value));
          }}
        >
          <option value="">{now ? `the one in use: ${now}` : "the one in use"}</option>
          {skills.map((name) => (
            <option key={name} value={name}>
              {name}
            </option>
          ))}
        </select>
      </Field>
      <Field label="Leg">
        <Segmented
          id="curve-leg"
          value={desk.leg.value}
          choices={legs.map((label, value) => ({ value, label }))}
          choose={(value) => desk.choose(source, () => (desk.leg.value = value))}
        />
      </Field>
    </div>
  );
}

function Tools({ source, disabled }: { source: Source; disabled: boolean }) {
  const curve = desk.curve.value;
  const alike = curve?.kind === "torque" ? "all legs alike" : "front and hind legs alike";
  return (
    <div class="curves-tools">
      {!desk.isOver.value && <Switch id="curve-mirror" label={alike} on={desk.mirror.value} change={(on) => (desk.mirror.value = on)} />}
      <span class="spring" />
      <button
        class="icon"
        title="Undo (Ctrl-Z)"
        data-testid="curve-undo"
        disabled={disabled || !(curve?.undo || desk.draft.value)}
        onClick={() => void desk.step(source, "undo")}
      >
        <Icon name="undo" />
      </button>
      <button
        class="icon"
        title="Redo (Ctrl-Y)"
        data-testid="curve-redo"
        disabled={disabled || !curve?.redo}
        onClick={() => void desk.step(source, "redo")}
      >
        <Icon name="redo" />
      </button>
      <button
        data-testid="curve-save"
        title="Keeps the edits: torques in the skillbook, leg cycles in files"
        disabled={disabled || !curve?.undo}
        onClick={() => void desk.save(source)}
      >
        Save
      </button>
    </div>
  );
}

/** What is ahead of the leg: an edit can be how it gets over that, for every leg and skill. */
function Ahead({ source, disabled }: { source: Source; disabled: boolean }) {
  const ahead = desk.curve.value?.ahead;
  const waits = desk.isOver.value && desk.draft.value !== null;
  return (
    <div class="curves-ahead" data-testid="curve-ahead" data-kind={ahead?.kind ?? ""}>
      <Switch
        id="curve-obstacle"
        label={ahead ? `over the ${ahead.kind} of ${sizeOf(ahead)} ahead` : "over what is ahead: nothing is"}
        on={desk.obstacle.value}
        change={desk.turnOver}
      />
      {desk.isOver.value && (
        <>
          <p class="faint">
            {waits
              ? "Move all points that have to be others; then let it be learned, for every leg and skill."
              : ahead
                ? "Raise the path over the line: that is what it does with such things ahead."
                : "Bring the leg to something, or something before the leg."}
          </p>
          <button
            class="wide"
            data-testid="curve-learn"
            disabled={disabled || !waits || !ahead || desk.busy.value}
            onClick={() => void desk.submit(source, "path", highestOf(desk.points.peek()))}
          >
            {desk.busy.value ? "Seen in physics …" : "Learn this path"}
          </button>
        </>
      )}
      {desk.learned.value && (
        <p class="good" data-testid="curve-learned">
          Learned: {desk.learned.value}
        </p>
      )}
    </div>
  );
}

function sizeOf({ kind, size }: { kind: string; size: number }): string {
  return kind === "slope" ? number(size) : `${number(100 * size, 1)} cm`;
}

function highestOf(rows: number[][]): number {
  const heights = rows.map((row) => row[2]);
  return heights.indexOf(Math.max(...heights));
}

/** What became of the last edit. */
function Outcome() {
  const curve = desk.curve.value;
  const seen = desk.preview.value;
  const said = desk.said.value;
  const state = desk.busy.value
    ? "seen in physics …"
    : desk.isOver.value && desk.draft.value
      ? "waits to be learned"
      : desk.draft.value && !desk.dragged.value
        ? "counts once a point is moved"
        : curve?.pending
          ? "taken on at the next cycle"
          : curve?.edited
            ? "edited, in effect"
            : desk.learned.value
              ? "as it was, but over what is ahead"
              : "as it was";
  return (
    <div class="curve-outcome">
      <p data-testid="curve-state" data-pending={`${curve?.pending ?? false}`} data-edited={`${curve?.edited ?? false}`}>
        <strong>
          {curve?.skill} · {curve?.leg}
        </strong>{" "}
        <span class="faint">{state}</span>
      </p>
      {seen && <Seen preview={seen} />}
      {said && (
        <p class={said.bad ? "refusal" : "faint"} data-testid="curve-said">
          {said.text}
        </p>
      )}
    </div>
  );
}

function Seen({ preview }: { preview: Preview }) {
  const { seconds, fell, failed, velocity_error, torque_share, took } = preview;
  return (
    <dl class="curve-preview" data-testid="curve-preview" data-fell={`${fell}`}>
      <dt>In {number(seconds, 1)} s of physics</dt>
      <dd class={fell || failed ? "bad" : "good"}>{fell ? "it fell" : failed || "it kept on its feet"}</dd>
      <dt>Velocity off by</dt>
      <dd>{number(velocity_error, 3)} m/s</dd>
      <dt>Greatest torque</dt>
      <dd class={torque_share > 0.999 ? "warn" : ""}>{number(100 * torque_share, 0)} % of its limit</dd>
      <dt>Seen in</dt>
      <dd class="faint">{number(took, 2)} s</dd>
    </dl>
  );
}

function Hints() {
  return (
    <p class="curve-hints faint">
      <span class="curve-key line">asked for</span>
      <span class="curve-key ghost">measured</span>
      <span class="curve-key seen">preview</span>
      <br />
      Drag a point; double click on the line: a new one; Delete or right click: gone.
    </p>
  );
}
