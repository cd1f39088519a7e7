// A stick to drag: up is forward, sideways turns; with shift, sideways goes sideways.

import { useEffect, useRef } from "preact/hooks";
import { held, type Steering } from "./steering";

const SIZE = 92;
const REACH = 34;

export function Stick({ steering, disabled }: { steering: Steering; disabled: boolean }) {
  const down = useRef(false);
  const now = held.value;
  const middle = SIZE / 2;
  const x = middle - REACH * (now ? (Math.abs(now.turn) > Math.abs(now.left) ? now.turn : now.left) : 0);
  const y = middle - REACH * (now?.forward ?? 0);

  const tell = (event: PointerEvent & { currentTarget: Element }) => {
    const box = event.currentTarget.getBoundingClientRect();
    const bound = (value: number) => Math.max(-1, Math.min(1, value));
    const across = bound((box.left + box.width / 2 - event.clientX) / REACH);
    const forward = bound((box.top + box.height / 2 - event.clientY) / REACH);
    steering.hold("stick", { forward, left: event.shiftKey ? across : 0, turn: event.shiftKey ? 0 : across });
  };
  const letGo = () => {
    down.current = false;
    steering.hold("stick", null);
  };
  // it may be gone, or be nobody's any more, while it is dragged
  useEffect(() => letGo, []);
  useEffect(() => {
    if (disabled) letGo();
  }, [disabled]);
  return (
    <svg
      class={`stick ${disabled ? "off" : ""}`}
      width={SIZE}
      height={SIZE}
      data-testid="stick"
      onPointerDown={(event) => {
        if (disabled) return;
        down.current = true;
        event.currentTarget.setPointerCapture(event.pointerId);
        tell(event);
      }}
      onPointerMove={(event) => down.current && tell(event)}
      onPointerUp={letGo}
      onPointerCancel={letGo}
    >
      <circle class="stick-rim" cx={middle} cy={middle} r={middle - 2} />
      <path class="stick-cross" d={`M${middle} 8V${SIZE - 8}M8 ${middle}H${SIZE - 8}`} />
      <line class="stick-arm" x1={middle} y1={middle} x2={x} y2={y} />
      <circle class={`stick-knob ${now ? "held" : ""}`} cx={x} cy={y} r="11" />
    </svg>
  );
}
