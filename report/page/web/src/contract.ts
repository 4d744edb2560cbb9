/**
 * What the program writes into the page and the page draws: the seam between report/page/*.cpp and
 * this folder. The C++ structs of report/page/page_document.hpp have the same names and members.
 *
 * Words and units come from the program, as an engineer reads them ("hub angle", "m/s²"); the page
 * knows no sensor, effect or formulation. Numbers that are shown as text come formatted.
 *
 * The page holds two elements: <script type="application/json" id="document"> with a PageDocument,
 * and <script type="application/octet-stream" id="arrays"> with one base64 text, the bytes of all
 * arrays one behind the other, little-endian. In the JSON "<" is written as \u003c, so that no text
 * ends the element; it has no NaN.
 */

/** A range of the bytes of all arrays. `f64` and `f32` are numbers as they stand, NaN is a gap;
 * `i16` is value = offset + scale * integer, -32768 is a gap. */
export interface ArrayRef {
  type: "f64" | "f32" | "i16";
  byte_offset: number;
  count: number;
  scale?: number;
  offset?: number;
}

/** Evenly spaced numbers: start + step * index. */
export interface EvenRange {
  start: number;
  step: number;
  count: number;
}

export type Numbers = ArrayRef | EvenRange;

export interface PageDocument {
  schema: "flexarm.page/1";
  program: string; // "flexarm 0.1.0"
  command: string; // the command line that made the page
  title: string; // "Diagnosis of bench/measurement.toml"
  date: string; // of the run of the program, "2026-11-29"; may be empty
  verdict: Verdict;
  /** What came out, each with its value: "Coulomb friction, torque" "0.00215 ± 5e-08 N m". */
  results: Fact[];
  /** The picture of the first screen. */
  headline?: Block;
  /** What is left, and other numbers of the first screen. */
  facts: Fact[];
  /** What to do next, a sentence; may be empty. */
  next_step: string;
  sections: Section[];
}

export interface Verdict {
  /** Colour and sign; the word says the same. */
  status: "good" | "partial" | "bad" | "neutral";
  word: string; // "explained", "formulations agree", ...
  sentence: string;
}

export interface Fact {
  label: string; // "NRMSE before"
  value: string; // "60.5 %"
}

export interface Section {
  id: string; // unique, of a-z, 0-9 and "-": the address after #
  title: string;
  text: string[]; // paragraphs
  blocks: Block[];
}

export type Block = TableBlock | CurvesBlock | ScatterBlock | MapBlock | RankingBlock | SweepBlock;

interface BlockBase {
  id: string; // unique in the page, as of Section; also the name of its CSV file
  title: string;
  caption: string; // what is seen, in a sentence or two; may be empty
}

export interface TableBlock extends BlockBase {
  kind: "table";
  columns: { title: string; unit: string; numeric: boolean }[];
  rows: string[][];
}

export interface Axis {
  label: string;
  unit: string; // may be empty
  scale: "linear" | "log";
  /** Empty: from the data in view. */
  range?: [number, number];
}

/** What a curve is decides its colour and stroke, in light, dark and print. */
export type Role =
  | "measured"
  | "before" // simulation of the arm file
  | "after" // simulation of the extended arm
  | "residual_before"
  | "residual_after"
  | "bound" // confidence bounds, noise level
  | "noise"
  | "coherence"
  | "first" // formulations, tracks: distinguishable, without an order, like none of those above
  | "second"
  | "third"
  | "fourth"
  | "fifth"
  | "sixth";

/** Curves over a common x axis, panels one above the other; one view is seen at a time. */
export interface CurvesBlock extends BlockBase {
  kind: "curves";
  x: Axis;
  /** Names of what the views differ in, for the selectors: ["run", "sensor"]; empty for one view. */
  choices: string[];
  views: CurvesView[];
}

export interface CurvesView {
  labels: string[]; // one for each of `choices`
  facts: Fact[]; // "fit" "99.5 %"
  panels: CurvesPanel[];
  /** The part of x that is in view first; empty: the whole range. */
  shown?: [number, number];
}

export interface CurvesPanel {
  y: Axis;
  height: number; // relative to the other panels
  series: Series[];
  /** Horizontal lines: bounds of a correlation, a noise level. */
  levels: { label: string; role: Role; y: number }[];
}

export interface Series {
  label: string;
  role: Role;
  /** line: joined in order; stems: from zero, one a point (correlations); points: unjoined. */
  draw: "line" | "stems" | "points";
  data: Samples | Envelope;
}

/** x ascends; y has as many numbers. */
export interface Samples {
  kind: "samples";
  x: Numbers;
  y: Numbers;
  /** Standard deviation of each y, drawn as a band of one. */
  y_std?: Numbers;
}

/** A record that is too long to send whole: least and greatest value of each bucket, in levels from
 * fine to coarse. Bucket i of a level covers samples_per_bucket samples from i * samples_per_bucket
 * on; the page draws the coarsest level that has a bucket a pixel in view. */
export interface Envelope {
  kind: "envelope";
  x: EvenRange; // of the samples
  levels: { samples_per_bucket: number; least: ArrayRef; greatest: ArrayRef }[];
}

/** Points without an order along x: residual torque over velocity or angle, Nyquist. */
export interface ScatterBlock extends BlockBase {
  kind: "scatter";
  choices: string[];
  views: { labels: string[]; facts: Fact[]; panels: ScatterPanel[] }[];
}

export interface ScatterPanel {
  x: Axis;
  y: Axis;
  equal_scales: boolean;
  series: { label: string; role: Role; draw: "line" | "points"; x: Numbers; y: Numbers }[];
}

/** Poles and zeros in the s plane. On a logarithmic axis, here and in a sweep, each place is
 * sign(v) log10(1 + |v|/v0), v0 a third of the smallest number; the reader can change to and fro. */
export interface MapBlock extends BlockBase {
  kind: "map";
  x: Axis;
  y: Axis;
  points: MapPoint[];
}

export interface MapPoint {
  mark: "pole" | "zero";
  /** A zero in the right half plane. */
  non_minimum_phase: boolean;
  series: string; // "measured", "fem", ...: one entry of the legend
  role: Role;
  real: number;
  imaginary: number;
  real_std?: number;
  imaginary_std?: number;
  /** Frequency, damping ratio, sensor. The first one is the label beside the point. */
  details: Fact[];
}

/** Bars, each a whole by itself: causes by probability. */
export interface RankingBlock extends BlockBase {
  kind: "ranking";
  chosen_word: string; // "identified": beside the chosen ones
  items: {
    label: string;
    /** 0 to 1: length of the bar. */
    share: number;
    value: string; // "0.99"
    chosen: boolean;
    details: Fact[];
  }[];
}

/** Poles and zeros over a parameter, with a slider for it. */
export interface SweepBlock extends BlockBase {
  kind: "sweep";
  parameter: Axis;
  values: Numbers;
  x: Axis; // of the s plane
  y: Axis;
  frequency: Axis;
  /** One number for each value; NaN where the root does not exist. */
  tracks: {
    label: string; // "pole 1", "zero 2 of the tip acceleration"
    mark: "pole" | "zero";
    role: Role;
    real: Numbers;
    imaginary: Numbers;
    frequency: Numbers;
  }[];
  events: { value: number; text: string }[];
}
