import type { Axis, Block, Envelope, Fact, Numbers, PageDocument, Role, Samples } from "../contract.js";
import { type Check, count, isRecord, list, number, object, oneOf, pair, tagged, text, truth } from "./checks.js";

const arrayRef = object(
  { type: oneOf("f64", "f32", "i16"), byte_offset: count, count },
  { scale: number, offset: number },
);
const evenRange = object({ start: number, step: number, count });
const numbers: Check<Numbers> = (value, place) =>
  isRecord(value) && "type" in value ? arrayRef(value, place) : evenRange(value, place);

const fact: Check<Fact> = object({ label: text, value: text });
const axis: Check<Axis> = object(
  { label: text, unit: text, scale: oneOf("linear", "log") },
  { range: pair(number) },
);
const role: Check<Role> = oneOf(
  "measured",
  "before",
  "after",
  "residual_before",
  "residual_after",
  "bound",
  "noise",
  "coherence",
  "first",
  "second",
  "third",
  "fourth",
  "fifth",
  "sixth",
);
const mark = oneOf("pole", "zero");

const samples: Check<Samples> = object(
  { kind: oneOf("samples"), x: numbers, y: numbers },
  { y_std: numbers },
);
const envelope: Check<Envelope> = object({
  kind: oneOf("envelope"),
  x: evenRange,
  levels: list(object({ samples_per_bucket: count, least: arrayRef, greatest: arrayRef })),
});

const curvesPanel = object({
  y: axis,
  height: number,
  series: list(
    object({
      label: text,
      role,
      draw: oneOf("line", "stems", "points"),
      data: tagged("kind", { samples, envelope }),
    }),
  ),
  levels: list(object({ label: text, role, y: number })),
});

const scatterPanel = object({
  x: axis,
  y: axis,
  equal_scales: truth,
  series: list(object({ label: text, role, draw: oneOf("line", "points"), x: numbers, y: numbers })),
});

const mapPoint = object(
  {
    mark,
    non_minimum_phase: truth,
    series: text,
    role,
    real: number,
    imaginary: number,
    details: list(fact),
  },
  { real_std: number, imaginary_std: number },
);

const base = { id: text, title: text, caption: text };

function viewsOf<P, O extends Record<string, Check<unknown>>>(panel: Check<P>, optional: O) {
  return list(object({ labels: list(text), facts: list(fact), panels: list(panel) }, optional));
}

const block: Check<Block> = tagged("kind", {
  table: object({
    ...base,
    kind: oneOf("table"),
    columns: list(object({ title: text, unit: text, numeric: truth })),
    rows: list(list(text)),
  }),
  curves: object({
    ...base,
    kind: oneOf("curves"),
    x: axis,
    choices: list(text),
    views: viewsOf(curvesPanel, { shown: pair(number) }),
  }),
  scatter: object({
    ...base,
    kind: oneOf("scatter"),
    choices: list(text),
    views: viewsOf(scatterPanel, {}),
  }),
  map: object({ ...base, kind: oneOf("map"), x: axis, y: axis, points: list(mapPoint) }),
  ranking: object({
    ...base,
    kind: oneOf("ranking"),
    chosen_word: text,
    items: list(
      object({ label: text, share: number, value: text, chosen: truth, details: list(fact) }),
    ),
  }),
  sweep: object({
    ...base,
    kind: oneOf("sweep"),
    parameter: axis,
    values: numbers,
    x: axis,
    y: axis,
    frequency: axis,
    tracks: list(
      object({ label: text, mark, role, real: numbers, imaginary: numbers, frequency: numbers }),
    ),
    events: list(object({ value: number, text })),
  }),
});

/** What the program has to have written; throws MalformedDocument. */
export const pageDocument: Check<PageDocument> = object(
  {
    schema: oneOf("flexarm.page/1"),
    program: text,
    command: text,
    title: text,
    date: text,
    verdict: object({
      status: oneOf("good", "partial", "bad", "neutral"),
      word: text,
      sentence: text,
    }),
    results: list(fact),
    facts: list(fact),
    next_step: text,
    sections: list(object({ id: text, title: text, text: list(text), blocks: list(block) })),
  },
  { headline: block },
);
