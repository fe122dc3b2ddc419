/** A program, a machine or a list of tools: the path of a file, or one in memory. */
export type Source = string | { name: string; text: string } | { name: string; bytes: Uint8Array };

export type Language = 'fagor' | 'num' | 'sinumerik' | 'heidenhain' | 'linuxcnc';

/** A message about a program, at its place; line 0: about all of it. */
export interface Diagnostic {
  /** TRN-392; `npx cnctrans explain TRN-392` prints its page. */
  code: string;
  severity: 'error' | 'warning' | 'note';
  file: string;
  line: number;
  column: number;
  endLine: number;
  endColumn: number;
  message: string;
  /** What to do about it. */
  hint: string;
}

export interface Reading {
  /** A built-in machine (fagor-lathe), or a profile. */
  machine?: string | Source;
  /** Tools of the job: CSV, JSON, or the tool table of a control. */
  tools?: Source;
  /** Programs that are called, definitions. */
  libraries?: Source | Source[];
  reader?: 'scanner' | 'antlr' | 'both';
}

export interface Running {
  /** Initial values of variables: {P100: 3}. */
  set?: Record<string, number | string>;
  /** Block-skip switches that are on. */
  skip?: number | number[];
  maxEvents?: number;
  maxSteps?: number;
}

export interface Directed {
  /** Without it: by extension and content. */
  from?: Language;
  to?: Language;
  targetMachine?: string | Source;
  /** Prove more than one way through the program. */
  explore?: boolean;
  replays?: number;
}

export interface TranslateOptions extends Reading, Running, Directed {
  to: Language;
  /** What becomes of a construct without counterpart. */
  unsupported?: 'error' | 'warn' | 'comment';
  /** Write what can be translated, with a list of what is left to do. */
  draft?: boolean;
  numbering?: 'keep' | 'none' | 'renumber';
  numberStep?: number;
  cycles?: 'native' | 'exact' | 'explode';
  structure?: 'keep' | 'raise';
  /** The source line as a comment beside its translation. */
  annotate?: boolean;
  /** false: no remark at the head that names the source. */
  origin?: boolean;
  encoding?: 'utf-8' | 'windows-1252';
  eol?: 'lf' | 'crlf' | 'cr';
  /** false: written without replaying both programs. */
  prove?: boolean;
  /** Which report `report` holds; without it the JSON report, as an object. */
  report?: 'json' | 'html' | 'md' | 'sarif';
}

export interface Output {
  name: string;
  bytes: Uint8Array;
  text: string;
  /** For each line the lines of the source it comes from. Not with a report of another form than json. */
  lines?: number[][];
}

export interface Translation {
  /** A translation was written. */
  ok: boolean;
  status: 'translated' | 'refused' | 'different' | 'draft' | 'failed';
  /** Both programs were replayed and move the machine the same way. */
  verified: boolean;
  verdict: string;
  outputs: Output[];
  diagnostics: Diagnostic[];
  /** An object for json (null where there is none), else its text. */
  report: any;
}

export interface Comparison {
  ok: boolean;
  verified: boolean;
  verdict: string;
  diagnostics: Diagnostic[];
}

export interface Check {
  /** No errors. */
  ok: boolean;
  summary: string;
  diagnostics: Diagnostic[];
}

export interface Run {
  /** It ran to its end. */
  ok: boolean;
  ended: 'end' | 'error' | 'limit';
  summary: string;
  /** Their values at the end. */
  variables: Record<string, unknown>;
  diagnostics: Diagnostic[];
  /** With `events: true`: what the machine did (docs/trace.md). */
  events?: Array<{ event: string; [more: string]: any }>;
}

/** Translates a program, replays both and compares them; nothing is written to disk. */
export function translate(program: Source, options: TranslateOptions): Promise<Translation>;
/** Compares a program with a translation made by anyone: its files, the main program first. */
export function verify(program: Source, translation: Source | Source[], options?: Reading & Running & Directed): Promise<Comparison>;
/** Reads a program and says what is wrong in it. */
export function check(program: Source, options?: Reading & { dialect?: Language }): Promise<Check>;
/** Runs a program in the reference interpreter. */
export function run(program: Source, options?: Reading & Running & { dialect?: Language; events?: boolean }): Promise<Run>;
export function dialects(): Promise<{
  languages: Array<{ id: Language; name: string; read: boolean; extensions: string[] }>;
  machines: string[];
}>;
export function version(): Promise<string>;
/** Any command line, on files in memory: the files that came to be come back. */
export function command(
  args: string[],
  files?: Array<{ name: string; bytes: Uint8Array }>,
): Promise<{ status: number; stdout: string; stderr: string; files: Array<{ name: string; bytes: Uint8Array }> }>;

/** A call that can't be done. What is wrong in a program is no such error: it stands in the result. */
export class UsageError extends Error {}
