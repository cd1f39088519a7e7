// The shape of a feature's tree, and what a rule's marks say of its leaves.

import type { Marks, Tree } from "../protocol";

/** What a rule does at a leaf: fires, as was seen right; does not; nobody knows. */
export type Verdict = "yes" | "no" | "grey";

export interface Node {
  value: string;
  depth: number;
  /** First and last of its leaves. */
  from: number;
  to: number;
  isLeaf: boolean;
}

export interface Shape {
  nodes: Node[];
  leaves: string[];
  depth: number;
}

const RUN = " to ";
const OR = " or ";

export function shapeOf({ values, parents }: Tree): Shape {
  const inner = new Set(parents);
  const leaves: string[] = [];
  const nodes: Node[] = values.map((value, k) => {
    const isLeaf = !inner.has(k);
    const from = leaves.length;
    if (isLeaf) leaves.push(value);
    return { value, depth: 0, from, to: from, isLeaf };
  });
  nodes.forEach((node, k) => {
    if (parents[k] >= 0) node.depth = nodes[parents[k]].depth + 1;
  });
  for (let k = nodes.length - 1; k >= 0; k--) {
    const above = nodes[parents[k]];
    if (above) above.to = Math.max(above.to, nodes[k].to);
  }
  return { nodes, leaves, depth: Math.max(...nodes.map(({ depth }) => depth)) };
}

/** Places of the leaves that a mark stands for: a value, "A to B" of neighbours, "A or B" of any leaves. */
export function leavesOf({ nodes, leaves }: Shape, mark: string | null): Set<number> {
  const node = nodes.find(({ value }) => value === mark);
  if (node) return new Set(range(node.from, node.to));
  for (const [first, last] of mark ? parted(mark, RUN) : []) {
    const [from, to] = [leaves.indexOf(first), leaves.indexOf(last)];
    if (from >= 0 && from < to) return new Set(range(from, to));
  }
  return new Set(mark ? (eitherOf(leaves, mark) ?? []) : []);
}

export function verdicts(shape: Shape, marks: Marks): Verdict[] {
  const [upper, lower] = [leavesOf(shape, marks.upper), leavesOf(shape, marks.lower)];
  return shape.leaves.map((_, k) => (!upper.has(k) ? "no" : lower.has(k) ? "yes" : "grey"));
}

/** Of all leaves below a node; `null` where they differ. */
export function verdictOf(node: Node, leaves: Verdict[]): Verdict | null {
  const [first, ...others] = leaves.slice(node.from, node.to + 1);
  return others.every((one) => one === first) ? first : null;
}

/** How much a rule goes by a tree: it has to be met, it is not known whether it matters, it does not. */
export function weightOf(tree: Tree, marks: Marks): "met" | "open" | "any" {
  if (marks.upper !== tree.values[0]) return "met";
  return marks.lower === tree.values[0] ? "any" : "open";
}

/** Stretches of neighbours in a set. */
export function runs(places: Set<number>): [number, number][] {
  const found: [number, number][] = [];
  for (const place of [...places].sort((a, b) => a - b)) {
    const last = found.at(-1);
    if (last && last[1] === place - 1) last[1] = place;
    else found.push([place, place]);
  }
  return found;
}

function eitherOf(leaves: string[], mark: string): number[] | null {
  const whole = leaves.indexOf(mark);
  if (whole >= 0) return [whole];
  for (const [first, rest] of parted(mark, OR)) {
    const place = leaves.indexOf(first);
    const others = place < 0 ? null : eitherOf(leaves, rest);
    if (others) return [place, ...others];
  }
  return null;
}

/** Both sides of every place where a text can be parted. */
function* parted(text: string, by: string): Generator<[string, string]> {
  for (let at = text.indexOf(by); at >= 0; at = text.indexOf(by, at + 1)) {
    yield [text.slice(0, at), text.slice(at + by.length)];
  }
}

function range(from: number, to: number): number[] {
  return Array.from({ length: to - from + 1 }, (_, k) => from + k);
}
