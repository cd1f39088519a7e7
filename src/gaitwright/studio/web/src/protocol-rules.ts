// Rules as the protocol has them.

export interface Tree {
  name: string;
  unit: string;
  values: string[] | null;
  kind?: string;
  about?: string;
  /** of each value the place of the one that it hangs below; −1: the root */
  parents?: number[];
}

export interface Condition {
  tree: string;
  lower: number | null;
  upper: number | null;
  certain_lower: number | null;
  certain_upper: number | null;
  values: string[] | null;
}

export interface Rule {
  name: string;
  action: string;
  skill: string;
  status: string;
  sentence: string;
  firmness?: number;
  conditions?: Condition[];
  history?: (string | { sentence: string })[];
  /** how many lessons it was right and wrong in, and since how many no mark moved */
  right?: number;
  wrong?: number;
  quiet?: number;
  /** by trees: how far it is known to hold, and not to */
  marks?: Record<string, { upper: unknown; lower: unknown }>;
}

export interface Lesson {
  id: string | number;
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
  numbers?: string[];
}
