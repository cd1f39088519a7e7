// A source that notes what is sent to it.

import { signal } from "@preact/signals";
import type { Answer, Command, Role } from "../src/protocol";
import type { Link, Source } from "../src/source";

export class Noted {
  readonly role = signal<Role>({ say: "role", role: "driver", watchers: 0, has_driver: true });
  readonly link = signal<Link>("open");
  readonly told: Command[] = [];
  readonly asked: Command[] = [];
  answer: Answer = { done: true, more: {} };

  get source(): Source {
    return this as unknown as Source;
  }

  drives(on: boolean): void {
    this.role.value = { ...this.role.peek(), role: on ? "driver" : "watcher" };
  }

  tell(command: Command): void {
    this.told.push(command);
  }

  send(command: Command): Promise<Answer> {
    this.asked.push(command);
    return Promise.resolve(this.answer);
  }
}
