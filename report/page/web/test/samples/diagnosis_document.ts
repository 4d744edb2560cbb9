import type { PageDocument } from "../../src/contract.js";
import { ArrayWriter } from "./array_writer.js";
import { bodeBlock, mapPoints, sweepBlock } from "./sample_roots.js";
import { channels, correlation, nrmse_percent, overlay, residualTorque } from "./sample_runs.js";

export interface Sample {
  document: PageDocument;
  arrays: ArrayWriter;
}

const made = new Map<number, Sample>(); // by runs: each takes a second or two

/** A diagnosis with all kinds of blocks: Coulomb friction that the simulation lacks. */
export function diagnosisSample(runs = 6): Sample {
  const sample = made.get(runs) ?? newSample(runs);
  made.set(runs, sample);
  return sample;
}

function newSample(runs: number): Sample {
  const arrays = new ArrayWriter();
  const all = channels(runs).sort(
    (a, b) => nrmse_percent(b.measured, b.before) - nrmse_percent(a.measured, a.before),
  );
  const worst = all[0]!;
  const mean = (of: "before" | "after") =>
    (all.reduce((sum, channel) => sum + nrmse_percent(channel.measured, channel[of]), 0) / all.length).toPrecision(3);
  const [before, after] = [mean("before"), mean("after")];
  const document: PageDocument = {
    schema: "flexarm.page/1",
    program: "flexarm 0.1.0",
    command: "flexarm diagnose bench/measurement.toml --report diagnosis.html",
    title: "Diagnosis of bench/measurement.toml",
    date: "2026-11-29",
    verdict: {
      status: "good",
      word: "explained",
      sentence: `Explained by coulomb_friction (probability 0.99): the residuals are noise. NRMSE falls from ${before} to ${after} %.`,
    },
    results: [{ label: "Coulomb friction, torque", value: "0.00800000 ± 4.3e-07 N m, probability 0.99" }],
    next_step: "Simulate with the extended arm.",
    facts: [
      { label: "NRMSE before", value: `${before} %` },
      { label: "NRMSE after", value: `${after} %` },
      { label: "runs, channels", value: `${runs}, ${all.length}` },
    ],
    headline: {
      id: "headline",
      kind: "curves",
      title: `Worst channel: ${worst.sensor}, ${worst.run}`,
      caption: "Measured, simulated before and after, and the residuals on scales of their own.",
      x: { label: "time", unit: "s", scale: "linear" },
      choices: [],
      views: [{ ...overlay(worst, arrays), labels: [], shown: [2, 4] }],
    },
    sections: [
      {
        id: "channels",
        title: "Runs and channels",
        text: ["Each channel of each run, the one with the largest NRMSE first."],
        blocks: [
          {
            id: "overlay",
            kind: "curves",
            title: "Measured and simulated",
            caption: "",
            x: { label: "time", unit: "s", scale: "linear" },
            choices: ["run", "sensor"],
            views: all.map((channel) => overlay(channel, arrays)),
          },
          {
            id: "fits",
            kind: "table",
            title: "Fit of each channel",
            caption: "NRMSE, before and after.",
            columns: [
              { title: "run", unit: "", numeric: false },
              { title: "sensor", unit: "", numeric: false },
              { title: "NRMSE before", unit: "%", numeric: true },
              { title: "NRMSE after", unit: "%", numeric: true },
            ],
            rows: all.map((channel) => [
              channel.run,
              channel.sensor,
              nrmse_percent(channel.measured, channel.before).toPrecision(4),
              nrmse_percent(channel.measured, channel.after).toPrecision(4),
            ]),
          },
        ],
      },
      { id: "frequency", title: "Frequency response", text: [], blocks: [bodeBlock(arrays)] },
      {
        id: "residuals",
        title: "Residual analysis",
        text: [],
        blocks: [
          {
            id: "correlation",
            kind: "curves",
            title: "Autocorrelation of the residuals",
            caption: "Residuals that are noise stay within the bounds.",
            x: { label: "lag", unit: "samples", scale: "linear" },
            choices: ["run", "sensor"],
            views: all.slice(0, 3).map((channel) => correlation(channel, arrays, 60)),
          },
          {
            id: "residual-torque",
            kind: "scatter",
            title: "Residual hub torque over hub velocity",
            caption: "The torque that the simulation lacks changes its sign with the velocity.",
            choices: ["run"],
            views: all.filter((channel) => channel.sensor === "hub angle").map((channel) => residualTorque(channel, arrays)),
          },
        ],
      },
      {
        id: "roots",
        title: "Poles and zeros",
        text: [],
        blocks: [
          {
            id: "map",
            kind: "map",
            title: "Pole-zero map",
            caption: "Zeros in the right half plane limit the bandwidth of feedback from the tip.",
            x: { label: "Re s", unit: "rad/s", scale: "log" },
            y: { label: "Im s", unit: "rad/s", scale: "log" },
            points: mapPoints(),
          },
          sweepBlock(arrays),
        ],
      },
      {
        id: "causes",
        title: "Effects",
        text: ["Posterior probabilities of the effects that were fitted."],
        blocks: [
          {
            id: "ranking",
            kind: "ranking",
            chosen_word: "identified",
            title: "Posterior probability",
            caption: "",
            items: [
              {
                label: "coulomb_friction",
                share: 0.99,
                value: "0.99",
                chosen: true,
                details: [
                  { label: "torque", value: "0.008 ± 4.3e-07 N m" },
                  { label: "explained share", value: "100 %" },
                ],
              },
              { label: "stribeck_friction", share: 0.009, value: "0.009", chosen: false, details: [{ label: "delta BIC", value: "9.4" }] },
              { label: "viscous_friction", share: 0.0003, value: "0.0003", chosen: false, details: [] },
            ],
          },
        ],
      },
    ],
  };
  return { document, arrays };
}
