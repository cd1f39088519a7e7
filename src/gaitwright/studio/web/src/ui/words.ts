// What modes and drivers are, in a sentence each, for who sees these names for the first time.

import type { Mode } from "../protocol";

export const MODES: Record<Mode, string> = {
  guide: "You compose a motion by driving the robot, and it plays it back.",
  apprentice: "What you show it is offered as a lesson: it learns that where you say so.",
  plan: "You give a destination, and it finds its way there.",
};

/** Who can compute the torques of the joints. */
export const DRIVERS: Record<string, string> = {
  programmed: "Plays fixed joint angles from a table, whatever the ground is like.",
  kinematic: "Feet follow their paths: joint angles by inverse kinematics, held by stiff joints, without dynamics.",
  numerical: "Solves the dynamics at every tick, and shares the forces over the feet that stand.",
  learned: "Plays torque profiles that it was taught.",
  hybrid: "Learned while that goes well, numerical otherwise.",
};

/** A name with what it is. */
export function explained(name: string, words: Record<string, string>): string {
  return words[name] ? `${name}: ${words[name]}` : name;
}
