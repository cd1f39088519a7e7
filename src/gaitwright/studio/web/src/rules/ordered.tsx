// Rules in their order: one that is dragged over others is to come before them, where both could fire.
// That is a lesson, which waits for a word over the views or under “Teach”.

import type { ComponentChildren } from "preact";
import { useRef, useState } from "preact/hooks";
import type { Rule } from "../protocol";
import { drives, type Source } from "../source";
import { order } from "../teach/teaching";

const MOVED = 5;

interface Dragged {
  rule: string;
  /** Before which it is to come; "": before none. */
  before: string;
}

export function Ordered(props: {
  source: Source;
  rules: Rule[];
  children: (rule: Rule, lit: boolean) => ComponentChildren;
}) {
  const { source, rules, children } = props;
  const list = useRef<HTMLOListElement>(null);
  const from = useRef<{ rule: string; y: number } | null>(null);
  const was = useRef(false);
  const [dragged, setDragged] = useState<Dragged | null>(null);
  const [refused, setRefused] = useState({ rule: "", because: "" });
  const now = source.status.value?.rule;
  const driving = drives(source);

  /** The rule above which the pointer is, of those that come before the one that is dragged. */
  const above = (rule: string, y: number): string => {
    for (const [k, row] of [...(list.current?.children ?? [])].entries()) {
      if (rules[k].name === rule) return "";
      const { top, bottom } = row.getBoundingClientRect();
      if (y < (top + bottom) / 2) return rules[k].name;
    }
    return "";
  };
  const down = (event: PointerEvent, rule: string) => {
    const on = event.target as Element;
    was.current = false;
    if (!driving || event.button !== 0 || !on.closest(".rule-line")) return;
    from.current = { rule, y: event.clientY };
  };
  const move = (event: PointerEvent & { currentTarget: HTMLElement }) => {
    const start = from.current;
    if (!start || (!dragged && Math.abs(event.clientY - start.y) < MOVED)) return;
    if (!dragged) event.currentTarget.setPointerCapture(event.pointerId);
    was.current = true;
    setDragged({ rule: start.rule, before: above(start.rule, event.clientY) });
  };
  const up = async () => {
    const asked = dragged;
    from.current = null;
    setDragged(null);
    if (!asked?.before) return;
    setRefused({ rule: asked.rule, because: await order(source, asked.rule, asked.before) });
  };
  const lose = () => {
    from.current = null;
    setDragged(null);
  };
  // a click that ends a drag opens nothing
  const click = (event: Event) => {
    if (was.current) event.stopPropagation();
    was.current = false;
  };
  return (
    <ol class={`rules ${dragged ? "ordering" : ""}`} ref={list} data-testid="rules">
      {rules.map((rule) => {
        const lit = now === rule.name;
        const place = rule.name === dragged?.rule ? "dragged" : rule.name === dragged?.before ? "before" : "";
        return (
          <li
            key={rule.name}
            class={`rule-row ${lit ? "lit" : ""} ${place}`}
            data-testid="rule"
            data-rule={rule.name}
            data-status={rule.status}
            onPointerDown={(event) => down(event, rule.name)}
            onPointerMove={move}
            onPointerUp={() => void up()}
            onPointerCancel={lose}
            onClickCapture={click}
          >
            {children(rule, lit)}
            {refused.rule === rule.name && refused.because && (
              <p class="refusal" data-testid="refusal-order">
                {refused.because}
              </p>
            )}
          </li>
        );
      })}
    </ol>
  );
}
