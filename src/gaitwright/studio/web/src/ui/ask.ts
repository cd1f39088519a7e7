// A command and what is answered, as a value: what came with it, or why not.

import type { Command } from "../protocol";
import type { Source } from "../source";

export type Reply<More> = { more: More; because: "" } | { more: null; because: string };

export async function ask<More>(source: Source, command: Command): Promise<Reply<More>> {
  const answer = await source.send(command);
  return answer.done ? { more: answer.more as More, because: "" } : { more: null, because: answer.because };
}
