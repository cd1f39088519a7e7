// Light or dark: as the system has it, unless chosen.

import { computed, effect, signal } from "@preact/signals";
import { remembered } from "../ui/remembered";

export type Theme = "light" | "dark";

const system = matchMedia("(prefers-color-scheme: dark)");
const systemDark = signal(system.matches);
system.addEventListener("change", (event) => {
  systemDark.value = event.matches;
});

/** "" follows the system. */
const chosen = remembered<Theme | "">("theme", "");

export const theme = computed<Theme>(() => chosen.value || (systemDark.value ? "dark" : "light"));

export function switchTheme(): void {
  chosen.value = theme.value === "dark" ? "light" : "dark";
}

export function applyTheme(): void {
  effect(() => {
    document.documentElement.dataset.theme = theme.value;
  });
}

/** A colour of the style sheet, by its variable; for canvases. */
export function colour(variable: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(variable).trim();
}
