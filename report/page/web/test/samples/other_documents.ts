import type { ArrayRef, Block, Envelope, PageDocument } from "../../src/contract.js";
import { kPaperArm } from "./arm.js";
import { ArrayWriter } from "./array_writer.js";
import type { Sample } from "./diagnosis_document.js";
import { simulated } from "./simulation.js";
import { torqueOf } from "./sample_runs.js";

function pageOf(title: string, blocks: Block[], arrays: ArrayWriter): Sample {
  const document: PageDocument = {
    schema: "flexarm.page/1",
    program: "flexarm 0.1.0",
    command: "flexarm",
    title,
    date: "",
    results: [],
    next_step: "",
    verdict: { status: "neutral", word: "no verdict", sentence: title },
    facts: [],
    sections: [{ id: "all", title: "All", text: [], blocks }],
  };
  return { document, arrays };
}

/** Least and greatest of buckets of 256 samples, and of 4, 16, ... of those. */
function envelopeOf(record: Float64Array, step: number, arrays: ArrayWriter): Envelope {
  const levels: Envelope["levels"] = [];
  for (let size = 256; size < record.length; size *= 4) {
    const count = Math.ceil(record.length / size);
    const least = new Float64Array(count).fill(Infinity);
    const greatest = new Float64Array(count).fill(-Infinity);
    record.forEach((value, i) => {
      const bucket = Math.floor(i / size);
      least[bucket] = Math.min(least[bucket]!, value);
      greatest[bucket] = Math.max(greatest[bucket]!, value);
    });
    levels.push({ samples_per_bucket: size, least: arrays.i16(least), greatest: arrays.i16(greatest) });
  }
  return { kind: "envelope", x: { start: 0, step, count: record.length }, levels };
}

/** Records of 10^6 samples: one motion that is repeated and dies away, at ten amplitudes. */
export function longSample(runs = 10, count = 1_000_000): Sample {
  const arrays = new ArrayWriter();
  const step_s = 0.001;
  const swing = torqueOf(1);
  const part = simulated(kPaperArm, 0.002, (t) => swing(t % 9) * Math.sin(t / 13), count / 10, step_s).tipAcceleration_m_per_s2;
  const record = Float64Array.from({ length: count }, (_, i) => part[i % part.length]! * (1 - i / count / 2));
  const envelope = envelopeOf(record, step_s, arrays);
  // The arrays hold the same steps at each amplitude; what a step is differs.
  const scaled = (ref: ArrayRef, factor: number): ArrayRef => ({
    ...ref,
    scale: (ref.scale ?? 1) * factor,
    offset: (ref.offset ?? 0) * factor,
  });
  const amplified = (factor: number): Envelope => ({
    ...envelope,
    levels: envelope.levels.map(({ samples_per_bucket, least, greatest }) => ({
      samples_per_bucket,
      least: scaled(least, factor),
      greatest: scaled(greatest, factor),
    })),
  });
  const views = Array.from({ length: runs }, (_, run) => ({
    labels: [`run ${run + 1}`],
    facts: [],
    panels: [
      {
        y: { label: "tip acceleration", unit: "m/s²", scale: "linear" as const },
        height: 1,
        series: (["measured", "before"] as const).map((role, i) => ({
          label: role,
          role,
          draw: "line" as const,
          data: amplified((1 + 0.1 * run) * (1 - 0.3 * i)),
        })),
        levels: [],
      },
    ],
  }));
  const block: Block = {
    id: "long",
    kind: "curves",
    title: "Long records",
    caption: "",
    x: { label: "time", unit: "s", scale: "linear" },
    choices: ["run"],
    views,
  };
  return pageOf("Long records", [block], arrays);
}

export const kHostile = `<img src=x onerror="window.hacked=1"></script><script>window.hacked=1</script>"'&`;

/** Labels that would run as HTML. */
export function hostileSample(): Sample {
  const arrays = new ArrayWriter();
  const y = arrays.f64([1, 2, 3]);
  const x = { start: 0, step: 1, count: 3 };
  const axis = { label: kHostile, unit: kHostile, scale: "linear" as const };
  const base = { title: kHostile, caption: kHostile };
  const fact = { label: kHostile, value: kHostile };
  const sample = pageOf(
    kHostile,
    [
      { ...base, id: "t", kind: "table", columns: [{ title: kHostile, unit: kHostile, numeric: false }], rows: [[kHostile]] },
      {
        ...base,
        id: "c",
        kind: "curves",
        x: axis,
        choices: [kHostile],
        views: [1, 2].map((i) => ({
          labels: [`${kHostile}${i}`],
          facts: [fact],
          panels: [
            {
              y: axis,
              height: 1,
              series: [{ label: kHostile, role: "first", draw: "line", data: { kind: "samples", x, y } }],
              levels: [{ label: kHostile, role: "bound", y: 1 }],
            },
          ],
        })),
      },
      {
        ...base,
        id: "m",
        kind: "map",
        x: axis,
        y: axis,
        points: [{ mark: "zero", non_minimum_phase: true, series: kHostile, role: "second", real: 1, imaginary: 2, details: [fact] }],
      },
      { ...base, id: "r", kind: "ranking", chosen_word: kHostile, items: [{ label: kHostile, share: 0.5, value: kHostile, chosen: true, details: [fact] }] },
    ],
    arrays,
  );
  sample.document.verdict = { status: "bad", word: kHostile, sentence: kHostile };
  sample.document.facts = [fact];
  sample.document.command = kHostile;
  sample.document.program = kHostile;
  return sample;
}

/** Little or nothing in every kind of block, and a map with thousands of points. */
export function edgeSample(): Sample {
  const arrays = new ArrayWriter();
  const axis = { label: "x", unit: "", scale: "linear" as const };
  const logAxis = { label: "y", unit: "", scale: "log" as const };
  const none = { start: 0, step: 1, count: 0 };
  const curves = (id: string, y: number[], scale: "linear" | "log"): Block => ({
    id,
    kind: "curves",
    title: id,
    caption: "",
    x: axis,
    choices: [],
    views: [
      {
        labels: [],
        facts: [],
        panels: [
          {
            y: scale === "log" ? logAxis : axis,
            height: 1,
            series: [
              { label: "y", role: "first", draw: "line", data: { kind: "samples", x: { start: 3, step: 1, count: y.length }, y: arrays.f64(y) } },
            ],
            levels: [],
          },
        ],
      },
    ],
  });
  const sample = pageOf(
    "Edges",
    [
      curves("one-sample", [0.25], "linear"),
      curves("one-sample-log", [0.25], "log"),
      curves("no-sample", [], "linear"),
      curves("all-nan", [NaN, NaN, NaN], "linear"),
      curves("all-negative-log", [-1, -2], "log"),
      curves("with-gaps", [1, 2, NaN, 4, NaN, 5, 6], "linear"),
      curves("constant", [2, 2, 2], "linear"),
      { id: "no-view", kind: "curves", title: "no view", caption: "", x: axis, choices: ["run"], views: [] },
      {
        id: "damaged",
        kind: "curves",
        title: "damaged",
        caption: "",
        x: axis,
        choices: [],
        views: [
          {
            labels: [],
            facts: [],
            panels: [
              {
                y: axis,
                height: 1,
                series: [
                  { label: "y", role: "first", draw: "line", data: { kind: "samples", x: none, y: { type: "f64", byte_offset: 1e6, count: 3 } } },
                ],
                levels: [],
              },
            ],
          },
        ],
      },
      { id: "no-points", kind: "map", title: "no points", caption: "", x: axis, y: axis, points: [] },
      {
        id: "many-points",
        kind: "map",
        title: "many points",
        caption: "",
        x: axis,
        y: axis,
        points: Array.from({ length: 5000 }, (_, i) => ({
          mark: i % 2 === 0 ? ("pole" as const) : ("zero" as const),
          non_minimum_phase: false,
          series: "all",
          role: "second" as const,
          real: -0.01 * i * (1 + (i % 7) / 20),
          imaginary: i,
          details: [{ label: "frequency", value: `${i} Hz` }],
        })),
      },
      { id: "no-ranking", kind: "ranking", chosen_word: "", title: "no ranking", caption: "", items: [] },
      { id: "no-rows", kind: "table", title: "no rows", caption: "", columns: [{ title: "a", unit: "", numeric: true }], rows: [] },
      { id: "no-columns", kind: "table", title: "no columns", caption: "", columns: [], rows: [] },
      {
        id: "no-scatter",
        kind: "scatter",
        title: "no scatter",
        caption: "",
        choices: [],
        views: [{ labels: [], facts: [], panels: [{ x: axis, y: logAxis, equal_scales: false, series: [] }] }],
      },
      {
        id: "no-sweep",
        kind: "sweep",
        title: "no sweep",
        caption: "",
        parameter: axis,
        values: none,
        x: axis,
        y: axis,
        frequency: axis,
        tracks: [],
        events: [],
      },
    ],
    arrays,
  );
  sample.document.sections.push({ id: "empty", title: "Empty", text: [], blocks: [] });
  return sample;
}
