// Small pictures, 16 × 16, drawn with the colour of the text.

const PATHS: Record<string, string> = {
  play: "M5 3.5v9l7-4.5z",
  pause: "M4.5 3.5h2.5v9H4.5zM9 3.5h2.5v9H9z",
  step: "M3.5 3.5v9l6-4.5zM10.5 3.5h2v9h-2z",
  back: "M12.5 3.5v9l-6-4.5zM3.5 3.5h2v9h-2z",
  stop: "M4 4h8v8H4z",
  record: "M8 4a4 4 0 1 0 0 8 4 4 0 0 0 0-8z",
  left: "M10 3.5 5.5 8l4.5 4.5",
  right: "M6 3.5 10.5 8 6 12.5",
  reset: "M12.6 6.2A5 5 0 1 0 13 8.6M13 3.2v3.2H9.8",
  undo: "M5.5 3 2.5 6l3 3M3 6h6a4 3.6 0 0 1 0 7.2H6",
  redo: "M10.5 3l3 3-3 3M13 6H7a4 3.6 0 0 0 0 7.2h3",
  sun: "M8 5a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM8 1v2M8 13v2M1 8h2M13 8h2M3 3l1.4 1.4M11.6 11.6 13 13M13 3l-1.4 1.4M4.4 11.6 3 13",
  moon: "M12.8 9.7A5.3 5.3 0 0 1 6.3 3.2a5.3 5.3 0 1 0 6.5 6.5z",
  photo: "M2.5 5h2.6l1-1.6h3.8l1 1.6h2.6v7.6h-11zM8 6.6a2.2 2.2 0 1 0 0 4.4 2.2 2.2 0 0 0 0-4.4z",
  film: "M2.5 4h7.6v8H2.5zM10.1 7.2l3.4-2v5.6l-3.4-2z",
  one: "M2.5 3.5h11v9h-11z",
  two: "M2.5 3.5h11v9h-11zM8 3.5v9",
  four: "M2.5 3.5h11v9h-11zM8 3.5v9M2.5 8h11",
  layers: "M8 2.8 14 6 8 9.2 2 6zM2.6 9 8 11.9 13.4 9",
  cross: "M4 4l8 8M12 4l-8 8",
  minus: "M3.5 8h9",
  plus: "M8 3.5v9M3.5 8h9",
  down: "M8 3v7.5M4.5 7.2 8 10.7l3.5-3.5M3 13.2h10",
  up: "M8 13V4M4.5 7 8 3.5 11.5 7",
};

const FILLED = new Set(["play", "pause", "step", "back", "stop", "record"]);

export function Icon({ name }: { name: string }) {
  const fill = FILLED.has(name);
  return (
    <svg class="icon-picture" viewBox="0 0 16 16" width="14" height="14" aria-hidden="true">
      <path
        d={PATHS[name]}
        fill={fill ? "currentColor" : "none"}
        stroke={fill ? "none" : "currentColor"}
        stroke-width="1.4"
        stroke-linecap="round"
        stroke-linejoin="round"
      />
    </svg>
  );
}
