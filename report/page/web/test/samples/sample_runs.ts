import type { CurvesView, Fact, ScatterBlock, Series } from "../../src/contract.js";
import { kPaperArm } from "./arm.js";
import type { ArrayWriter } from "./array_writer.js";
import { type Motion, normal, rms, simulated } from "./simulation.js";

export const kSamples = 4000;
export const kStep_s = 0.0025;
export const kFriction_N_m = 0.008;
const kFound_N_m = 0.0080001;

const kSensors = [
  { name: "hub angle", unit: "rad", noise: 5e-4, of: (motion: Motion) => motion.hubAngle_rad },
  { name: "tip acceleration", unit: "m/s²", noise: 2e-2, of: (motion: Motion) => motion.tipAcceleration_m_per_s2 },
];

/** Torque of a run: reversed ever faster from run to run, first after half an interval, so that the arm swings about a place. */
export function torqueOf(run: number): (t: number) => number {
  const size = 0.03 + 0.008 * run;
  const frequency_Hz = 0.4 * (1 + 0.5 * run);
  return (t) => (t > 9 ? 0 : Math.cos(2 * Math.PI * frequency_Hz * t) >= 0 ? size : -size);
}

export interface Channel {
  run: string;
  sensor: string;
  unit: string;
  measured: Float64Array;
  before: Float64Array;
  after: Float64Array;
  velocity: Float64Array;
  noise: number;
}

/** Measured and simulated motions of the paper's arm; the simulation lacks friction at first. */
export function channels(runs: number): Channel[] {
  return Array.from({ length: runs }, (_, run) => {
    const torque = torqueOf(run);
    const truth = simulated(kPaperArm, kFriction_N_m, torque, kSamples, kStep_s);
    const before = simulated(kPaperArm, 0, torque, kSamples, kStep_s);
    const after = simulated(kPaperArm, kFound_N_m, torque, kSamples, kStep_s);
    return kSensors.map((sensor, i) => {
      const draw = normal(1000 * run + i + 1);
      return {
        run: `run ${run + 1}`,
        sensor: sensor.name,
        unit: sensor.unit,
        measured: sensor.of(truth).map((value) => value + sensor.noise * draw()),
        before: sensor.of(before),
        after: sensor.of(after),
        velocity: truth.hubVelocity_rad_per_s,
        noise: sensor.noise,
      };
    });
  }).flat();
}

export function difference(a: Float64Array, b: Float64Array): Float64Array {
  return a.map((value, i) => value - b[i]!);
}

export function nrmse_percent(measured: Float64Array, simulation: Float64Array): number {
  const mean = measured.reduce((sum, value) => sum + value, 0) / measured.length;
  return (100 * rms(difference(measured, simulation))) / rms(measured.map((value) => value - mean));
}

const kTime = { start: 0, step: kStep_s, count: kSamples };

/** Measured, before, after, and the residuals below. */
export function overlay(channel: Channel, arrays: ArrayWriter): CurvesView {
  const line = (label: string, role: Series["role"], y: Float64Array): Series => ({
    label,
    role,
    draw: "line",
    data: { kind: "samples", x: kTime, y: arrays.i16(y) },
  });
  const fit = (y: Float64Array) => `${(100 - nrmse_percent(channel.measured, y)).toPrecision(3)} %`;
  return {
    labels: [channel.run, channel.sensor],
    facts: [
      { label: "fit before", value: fit(channel.before) },
      { label: "fit after", value: fit(channel.after) },
    ],
    panels: [
      {
        y: { label: channel.sensor, unit: channel.unit, scale: "linear" },
        height: 2,
        series: [
          line("measured", "measured", channel.measured),
          line("before", "before", channel.before),
          line("after", "after", channel.after),
        ],
        levels: [],
      },
      {
        y: { label: "residual before", unit: channel.unit, scale: "linear" },
        height: 1,
        series: [line("residual before", "residual_before", difference(channel.measured, channel.before))],
        levels: [],
      },
      {
        y: { label: "residual after", unit: channel.unit, scale: "linear" },
        height: 1,
        series: [line("residual after", "residual_after", difference(channel.measured, channel.after))],
        levels: [
          { label: "one standard deviation of the noise", role: "bound", y: channel.noise },
          { label: "one standard deviation of the noise", role: "bound", y: -channel.noise },
        ],
      },
    ],
  };
}

/** Normalised autocorrelation of the residuals up to a lag. */
export function correlation(channel: Channel, arrays: ArrayWriter, lags: number): CurvesView {
  const of = (residual: Float64Array) => {
    const power = residual.reduce((sum, value) => sum + value * value, 0);
    return Float64Array.from({ length: lags + 1 }, (_, lag) => {
      let sum = 0;
      for (let i = 0; i + lag < residual.length; ++i) sum += residual[i]! * residual[i + lag]!;
      return sum / power;
    });
  };
  const bound = 2.576 / Math.sqrt(channel.measured.length);
  const panel = (label: string, role: Series["role"], simulation: Float64Array): CurvesView["panels"][number] => ({
    y: { label: `autocorrelation, ${label}`, unit: "", scale: "linear" },
    height: 1,
    series: [
      {
        label: `residual ${label}`,
        role,
        draw: "stems",
        data: {
          kind: "samples",
          x: { start: 0, step: 1, count: lags + 1 },
          y: arrays.f64(of(difference(channel.measured, simulation))),
        },
      },
    ],
    levels: [bound, -bound].map((y) => ({ label: "99 % bounds", role: "bound" as const, y })),
  });
  return {
    labels: [channel.run, channel.sensor],
    facts: [],
    panels: [panel("before", "residual_before", channel.before), panel("after", "residual_after", channel.after)],
  };
}

/** Torque that the simulation lacks, over the velocity of the hub. */
export function residualTorque(channel: Channel, arrays: ArrayWriter): ScatterBlock["views"][number] {
  const draw = normal(77);
  const every = 2;
  const velocity = channel.velocity.filter((_, i) => i % every === 0);
  const torque = velocity.map((v) => -kFriction_N_m * Math.tanh(v / 2e-3) + 0.0012 * draw());
  const most = velocity.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
  const facts: Fact[] = [{ label: "Coulomb term", value: "0.007971 ± 0.0004 N m" }];
  return {
    labels: [channel.run],
    facts,
    panels: [
      {
        x: { label: "hub velocity", unit: "rad/s", scale: "linear" },
        y: { label: "residual hub torque", unit: "N m", scale: "linear" },
        equal_scales: false,
        series: [
          { label: "residual hub torque", role: "residual_before", draw: "points", x: arrays.f32(velocity), y: arrays.f32(torque) },
          {
            label: "Coulomb term",
            role: "after",
            draw: "line",
            x: arrays.f64([-most, -1e-6, 1e-6, most]),
            y: arrays.f64([kFound_N_m, kFound_N_m, -kFound_N_m, -kFound_N_m]),
          },
        ],
      },
    ],
  };
}
