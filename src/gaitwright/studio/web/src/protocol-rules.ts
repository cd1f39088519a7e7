// Rules as the protocol has them.

/** One feature: its values in order, each with the place of the one that it hangs below (−1: the root). */
export interface Tree {
  name: string;
  /** How a sentence on it begins. */
  about: string;
  unit: string;
  values: string[];
  parents: number[];
}

/** Below the upper mark a rule may fire, below the lower one it was seen right; "A to B" and "A or B" are
    marks too, of several leaves. */
export interface Marks {
  upper: string;
  lower: string | null;
}

export interface Rule {
  name: string;
  action: string;
  skill: string;
  status: string;
  /** Situations in which it was seen right, and wrong. */
  right: number;
  wrong: number;
  /** Lessons since a mark moved. */
  quiet: number;
  sentence: string;
  /** By the tree. */
  marks: Record<string, Marks>;
  /** What moved its marks, the oldest first. */
  history: string[];
}

export interface Lesson {
  id: string;
  rule: string;
  given: string;
  about: string;
}

export interface Rules {
  say: "rules";
  trees: Tree[];
  rules: Rule[];
  lessons: Lesson[];
  /** names of what can be said of a situation in numbers */
  numbers: string[];
}
