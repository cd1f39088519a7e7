// The trees of a rule: at which values it fires, at which it does not, and where nobody knows.

import { useMemo, useState } from "preact/hooks";
import type { Marks, Rule, Tree, Why } from "../protocol";
import { leavesOf, runs, type Shape, shapeOf, type Verdict, verdictOf, verdicts, weightOf } from "./tree-shape";

interface Drawn {
  tree: Tree;
  marks: Marks;
  weight: ReturnType<typeof weightOf>;
  now: string | null;
}

const TITLES = { met: "It goes by", open: "Not known yet", any: "Does not matter" };

export function Forest({ trees, rule, situation }: { trees: Tree[]; rule: Rule; situation: Why["situation"] }) {
  const drawn: Drawn[] = trees
    .filter(({ name }) => rule.marks[name])
    .map((tree) => {
      const marks = rule.marks[tree.name];
      return { tree, marks, weight: weightOf(tree, marks), now: situation[tree.name] ?? null };
    });
  return (
    <div class="forest" data-testid="forest" data-rule={rule.name}>
      {(["met", "open", "any"] as const).map((weight) => {
        const some = drawn.filter((one) => one.weight === weight);
        return some.length ? (
          <div key={weight} class={`grove ${weight}`} data-testid={`grove-${weight}`}>
            <h3>
              {TITLES[weight]} <span>{some.length}</span>
            </h3>
            {some.map((one) => (
              <TreeView key={one.tree.name} {...one} />
            ))}
          </div>
        ) : null;
      })}
    </div>
  );
}

function TreeView({ tree, marks, weight, now }: Drawn) {
  const [open, setOpen] = useState(weight === "met");
  const shape = useMemo(() => shapeOf(tree), [tree]);
  const leaves = useMemo(() => verdicts(shape, marks), [shape, marks]);
  const at = [...leavesOf(shape, now)];
  const said = now === null ? "unknown" : now;
  return (
    <div class="tree" data-testid={`tree-${tree.name}`} data-weight={weight}>
      <button class="tree-head" aria-expanded={open} title={`${tree.about} …`} onClick={() => setOpen(!open)}>
        <span class="tree-name">
          {tree.name}
          {tree.unit && <span class="unit"> {tree.unit}</span>}
        </span>
        <Strip leaves={leaves} at={at} />
        <span class={`tree-now ${at.length === 1 ? leaves[at[0]] : ""}`} title={`now: ${said}`} data-testid="tree-now">
          {said}
        </span>
      </button>
      {open && <Branches shape={shape} marks={marks} leaves={leaves} at={at} />}
    </div>
  );
}

/** A cell for each leaf, with a dot at the one that holds now. */
function Strip({ leaves, at }: { leaves: Verdict[]; at: number[] }) {
  return (
    <span class="tree-strip">
      {leaves.map((verdict, k) => (
        <i key={k} class={`${verdict} ${at.includes(k) ? "now" : ""}`} />
      ))}
    </span>
  );
}

/** The tree on its side: the root at the left, a row for each leaf; bars at the right are the marks. */
function Branches({ shape, marks, leaves, at }: { shape: Shape; marks: Marks; leaves: Verdict[]; at: number[] }) {
  const { nodes, depth } = shape;
  const last = depth + 1;
  const inner = depth > 1 ? `repeat(${depth - 1}, minmax(0, 1fr))` : "";
  const bars = [
    { name: "upper", mark: marks.upper, column: last + 1, says: "upper mark: outside it the rule does not fire" },
    { name: "lower", mark: marks.lower, column: last + 2, says: "lower mark: inside it the rule was seen right" },
  ];
  return (
    <div class="branches" style={{ gridTemplateColumns: `9px ${inner} minmax(0, 1.5fr) 7px 7px` }}>
      {nodes.map((node) => {
        const verdict = verdictOf(node, leaves) ?? "mixed";
        const here = node.isLeaf && at.includes(node.from);
        const signs = `${node.value === marks.upper ? "▲" : ""}${node.value === marks.lower ? "▼" : ""}`;
        return (
          <span
            key={node.value}
            class={`node ${verdict} ${here ? "now" : ""}`}
            title={`${node.value}${signs ? ` ${signs}` : ""}`}
            data-testid={`value-${node.value}`}
            data-verdict={verdict}
            style={{
              gridRow: `${node.from + 1} / ${node.to + 2}`,
              gridColumn: `${node.depth + 1} / ${node.isLeaf ? last + 1 : node.depth + 2}`,
            }}
          >
            {node.depth > 0 && node.value}
            {node.depth > 0 && signs && <b>{signs}</b>}
          </span>
        );
      })}
      {bars.flatMap(({ name, mark, column, says }) =>
        runs(leavesOf(shape, mark)).map(([from, to]) => (
          <span
            key={`${name}${from}`}
            class={`mark ${name}`}
            title={says}
            data-testid={`mark-${name}`}
            style={{ gridRow: `${from + 1} / ${to + 2}`, gridColumn: `${column}` }}
          />
        )),
      )}
    </div>
  );
}
