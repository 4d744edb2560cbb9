import type { CurvesBlock, MapPoint, Role, SweepBlock } from "../../src/contract.js";
import { type Arm, hubZeros_rad_per_s, kPaperArm, modes } from "./arm.js";
import type { ArrayWriter } from "./array_writer.js";
import { hubResponse, magnitude, phase_deg } from "./frequency_response.js";
import { normal } from "./simulation.js";

const kHz = 1 / (2 * Math.PI);

/** Poles, zeros of the hub angle, and zeros of the tip acceleration, of which some are real. */
export function mapPoints(): MapPoint[] {
  const points: MapPoint[] = [];
  const add = (series: string, role: Role, factor: number, std: number) => {
    const root = (mark: "pole" | "zero", real: number, imaginary: number, sensor: string) => {
      const size = Math.hypot(real, imaginary);
      points.push({
        mark,
        non_minimum_phase: mark === "zero" && real > 0,
        series,
        role,
        real,
        imaginary,
        ...(std > 0 ? { real_std: std * 0.3 * size, imaginary_std: std * size } : {}),
        details: [
          { label: "frequency", value: `${(size * kHz).toPrecision(4)} Hz` },
          { label: "damping ratio", value: (-real / size).toPrecision(3) },
          ...(sensor === "" ? [] : [{ label: "sensor", value: sensor }]),
        ],
      });
    };
    const pair = (mark: "pole" | "zero", w: number, sensor: string) => {
      const zeta = kPaperArm.dampingRatio * factor;
      for (const sign of [1, -1]) root(mark, -zeta * w, sign * w * Math.sqrt(1 - zeta * zeta), sensor);
    };
    for (const mode of modes(kPaperArm, 3)) pair("pole", mode.omega_rad_per_s * factor, "");
    for (const w of hubZeros_rad_per_s(kPaperArm, 2)) pair("zero", w * factor, "hub angle");
    for (const real of [57.4409, 310.406]) {
      root("zero", real * factor, 0, "tip acceleration");
      root("zero", -real * factor, 0, "tip acceleration");
    }
  };
  add("measured", "measured", 0.985, 0.01);
  add("simulated", "before", 1, 0);
  return points;
}

/** Measured and modelled response of the hub angle, with coherence. */
export function bodeBlock(arrays: ArrayWriter): CurvesBlock {
  const draw = normal(5);
  const measured_Hz = Float64Array.from({ length: 240 }, (_, i) => 0.5 + i * 0.333);
  const model_Hz = Float64Array.from({ length: 1200 }, (_, i) => 0.5 * 160 ** (i / 1199));
  const std = (f: number) => 0.02 + 0.0005 * f;
  const response = (f: number, arm: Arm) => hubResponse(arm, f);
  const stiffer = { ...kPaperArm, rigidity_N_m2: kPaperArm.rigidity_N_m2 * 0.97 };
  const coherence = measured_Hz.map((f) => 1 / (1 + std(f) ** 2 / 0.02 + (Math.abs(f - 18) < 0.5 ? 0.4 : 0)));
  // A band that was not measured is a gap.
  const isMeasured = (f: number) => f < 44 || f > 48;
  const magnitudes = measured_Hz.map((f) => (isMeasured(f) ? magnitude(response(f, stiffer)) * (1 + std(f) * draw()) : NaN));
  const phases = measured_Hz.map((f) => (isMeasured(f) ? phase_deg(response(f, stiffer)) + 57 * std(f) * draw() : NaN));
  const x = arrays.f64(measured_Hz);
  const grid = arrays.f64(model_Hz);
  const line = (y: ArrayLike<number>) => ({ kind: "samples" as const, x: grid, y: arrays.f64(y) });
  return {
    id: "bode",
    kind: "curves",
    title: "Frequency response",
    caption: "Hub angle per torque. The band is one standard deviation of the measurement.",
    x: { label: "frequency", unit: "Hz", scale: "log" },
    choices: ["sensor"],
    views: [
      {
        labels: ["hub angle"],
        facts: [],
        panels: [
          {
            y: { label: "magnitude", unit: "rad/(N m)", scale: "log" },
            height: 2,
            series: [
              {
                label: "measured",
                role: "measured",
                draw: "line",
                data: { kind: "samples", x, y: arrays.f64(magnitudes), y_std: arrays.f64(magnitudes.map((m, i) => m * std(measured_Hz[i]!))) },
              },
              { label: "before", role: "before", draw: "line", data: line(model_Hz.map((f) => magnitude(response(f, kPaperArm)))) },
              { label: "after", role: "after", draw: "line", data: line(model_Hz.map((f) => magnitude(response(f, stiffer)))) },
            ],
            levels: [],
          },
          {
            y: { label: "phase", unit: "°", scale: "linear" },
            height: 1,
            series: [
              { label: "measured", role: "measured", draw: "points", data: { kind: "samples", x, y: arrays.f64(phases) } },
              { label: "before", role: "before", draw: "line", data: line(model_Hz.map((f) => phase_deg(response(f, kPaperArm)))) },
            ],
            levels: [],
          },
          {
            y: { label: "coherence", unit: "", scale: "linear", range: [0, 1] },
            height: 0.7,
            series: [{ label: "coherence", role: "coherence", draw: "line", data: { kind: "samples", x, y: arrays.f64(coherence) } }],
            levels: [],
          },
        ],
      },
    ],
  };
}

const kRoles: Role[] = ["first", "second", "third", "fourth", "fifth", "sixth"];

/** Poles and zeros of the hub angle over the payload. */
export function sweepBlock(arrays: ArrayWriter): SweepBlock {
  const count = 101;
  const masses = Array.from({ length: count }, (_, i) => (0.5 * i) / (count - 1));
  const arms = masses.map((payload_kg) => ({ ...kPaperArm, payload_kg }));
  const poles = arms.map((arm) => modes(arm, 3).map((mode) => mode.omega_rad_per_s));
  const zeros = arms.map((arm) => hubZeros_rad_per_s(arm, 3));
  const track = (label: string, mark: "pole" | "zero", role: Role, omegas: number[]) => {
    const zeta = omegas.map((_, i) => kPaperArm.dampingRatio * (1 + i / count));
    return {
      label,
      mark,
      role,
      real: arrays.f64(omegas.map((w, i) => -zeta[i]! * w)),
      imaginary: arrays.f64(omegas.map((w, i) => w * Math.sqrt(1 - zeta[i]! ** 2))),
      frequency: arrays.f64(omegas.map((w) => w * kHz)),
    };
  };
  return {
    id: "sweep-payload",
    kind: "sweep",
    title: "Poles and zeros over the payload mass",
    caption: "The slider sets the payload. The trail shows where the roots come from.",
    parameter: { label: "payload mass", unit: "kg", scale: "linear" },
    values: { start: 0, step: 0.005, count },
    x: { label: "Re s", unit: "rad/s", scale: "linear" },
    y: { label: "Im s", unit: "rad/s", scale: "linear" },
    frequency: { label: "natural frequency", unit: "Hz", scale: "linear" },
    tracks: [0, 1, 2].flatMap((i) => [
      track(`pole ${i + 1}`, "pole", kRoles[2 * i]!, poles.map((all) => all[i]!)),
      track(`zero ${i + 1} of the hub angle`, "zero", kRoles[2 * i + 1]!, zeros.map((all) => all[i]!)),
    ]),
    events: [{ value: 0.15, text: "payload as heavy as the beam" }],
  };
}
