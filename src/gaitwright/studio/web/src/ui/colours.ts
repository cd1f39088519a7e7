// Every skill and every driver has its colour, the same everywhere: those of the project's pictures.

const SKILLS: Record<string, string> = {
  stand: "#6b7280", walk: "#2f9e44", trot: "#1971c2", "turn-in-place": "#e8590c", run: "#c2255c",
  pace: "#0c8599", rack: "#5f3dc4", pronk: "#e67700", bound: "#862e9c", gallop: "#a61e4d",
  "rotary-gallop": "#d6336c", stop: "#868e96", "walk-backward": "#66a80f", "walk-sideways": "#37b24d",
  climb: "#099268", descend: "#1098ad", "turn-left": "#f76707", "turn-right": "#fd7e14",
  tripod: "#1c7ed6", ripple: "#40c057", wave: "#74b816",
};

const DRIVERS: Record<string, string> = {
  numerical: "#1c7ed6", kinematic: "#2f9e44", programmed: "#e8590c", learned: "#9c36b5", hybrid: "#0c8599",
};

const OTHERS = ["#5f3dc4", "#c2255c", "#0c8599", "#e67700", "#66a80f"];

function of(table: Record<string, string>, name: string): string {
  if (!name) return "#868e96";
  if (table[name]) return table[name];
  let sum = 0;
  for (const letter of name) sum = (sum * 31 + letter.charCodeAt(0)) % 9973;
  return OTHERS[sum % OTHERS.length];
}

export const skillColour = (name: string): string => of(SKILLS, name);
export const driverColour = (name: string): string => of(DRIVERS, name);

/** Colours of legs, in their order. */
export const LEGS = ["#1c7ed6", "#e8590c", "#2f9e44", "#9c36b5", "#0c8599", "#c2255c"];
/** Colours of the joints of a leg. */
export const JOINTS = ["#1c7ed6", "#e8590c", "#2f9e44"];
