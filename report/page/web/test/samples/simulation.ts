import { type Arm, modes, totalInertia_kg_m2 } from "./arm.js";

export interface Motion {
  step_s: number;
  torque_N_m: Float64Array;
  hubAngle_rad: Float64Array;
  hubVelocity_rad_per_s: Float64Array;
  tipAcceleration_m_per_s2: Float64Array;
}

const kModes = 3;
const kInnerSteps = 8;
const kSlidingVelocity_rad_per_s = 2e-3; // below it friction grows with the velocity

/** Motion of the arm from rest under a torque that is held over each sample, with Coulomb friction at
 * the hub. Modal equations by the leapfrog rule. */
export function simulated(arm: Arm, friction_N_m: number, torque: (t: number) => number, count: number, step_s: number): Motion {
  const inertia = totalInertia_kg_m2(arm);
  const flexible = modes(arm, kModes);
  const parts = [{ omega_rad_per_s: 0, hubSlope: 1, tipValue_m: arm.length_m }, ...flexible];
  const q = new Float64Array(parts.length);
  const v = new Float64Array(parts.length);
  const motion: Motion = {
    step_s,
    torque_N_m: new Float64Array(count),
    hubAngle_rad: new Float64Array(count),
    hubVelocity_rad_per_s: new Float64Array(count),
    tipAcceleration_m_per_s2: new Float64Array(count),
  };
  const h = step_s / kInnerSteps;
  const sum = (numbers: Float64Array, of: (part: (typeof parts)[number]) => number) =>
    parts.reduce((total, part, i) => total + of(part) * numbers[i]!, 0);
  const acceleration = new Float64Array(parts.length);
  const update = (applied: number) => {
    const velocity = sum(v, (part) => part.hubSlope);
    const effective = applied - friction_N_m * Math.tanh(velocity / kSlidingVelocity_rad_per_s);
    parts.forEach((part, i) => {
      const w = part.omega_rad_per_s;
      acceleration[i] = (part.hubSlope * effective) / inertia - w * w * q[i]! - 2 * arm.dampingRatio * w * v[i]!;
    });
  };
  for (let n = 0; n < count; ++n) {
    const applied = torque(n * step_s);
    update(applied);
    motion.torque_N_m[n] = applied;
    motion.hubAngle_rad[n] = sum(q, (part) => part.hubSlope);
    motion.hubVelocity_rad_per_s[n] = sum(v, (part) => part.hubSlope);
    motion.tipAcceleration_m_per_s2[n] = sum(acceleration, (part) => part.tipValue_m);
    for (let k = 0; k < kInnerSteps; ++k) {
      update(applied);
      parts.forEach((_, i) => {
        v[i]! += h * acceleration[i]!;
        q[i]! += h * v[i]!;
      });
    }
  }
  return motion;
}

/** Normal numbers of a fixed seed. */
export function normal(seed: number): () => number {
  let state = seed >>> 0;
  const uniform = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return (state + 0.5) / 2 ** 32;
  };
  return () => Math.sqrt(-2 * Math.log(uniform())) * Math.cos(2 * Math.PI * uniform());
}

export function rms(numbers: Float64Array): number {
  return Math.sqrt(numbers.reduce((sum, value) => sum + value * value, 0) / numbers.length);
}
