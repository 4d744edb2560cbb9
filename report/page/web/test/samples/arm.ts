/** A single-link flexible arm: uniform beam, hub inertia, point mass at the tip. Its modes are roots
 * of the frequency equation in closed form. */
export interface Arm {
  length_m: number;
  rigidity_N_m2: number;
  massPerLength_kg_per_m: number;
  hubInertia_kg_m2: number;
  payload_kg: number;
  dampingRatio: number;
}

/** The arm of the paper (data/), with damping. */
export const kPaperArm: Arm = {
  length_m: 0.96,
  rigidity_N_m2: 3.6918,
  massPerLength_kg_per_m: 0.164858,
  hubInertia_kg_m2: 5.86e-4,
  payload_kg: 0,
  dampingRatio: 0.01,
};

export interface Mode {
  omega_rad_per_s: number;
  hubSlope: number; // of the shape with modal mass I_T
  tipValue_m: number;
}

/** omega of a nondimensional wave number lambda. */
function omega(arm: Arm, lambda: number): number {
  return (lambda / arm.length_m) ** 2 * Math.sqrt(arm.rigidity_N_m2 / arm.massPerLength_kg_per_m);
}

/** y = a sin + b sinh + c (cos - cosh): rows for the hub, the moment and the shear at the tip. */
function conditions(arm: Arm, lambda: number, isClamped: boolean): [number, number, number][] {
  const mass = arm.massPerLength_kg_per_m * arm.length_m;
  const epsilon = arm.hubInertia_kg_m2 / (mass * arm.length_m ** 2);
  const eta = arm.payload_kg / mass;
  const [s, c, sh, ch] = [Math.sin(lambda), Math.cos(lambda), Math.sinh(lambda), Math.cosh(lambda)];
  return [
    isClamped ? [1, 1, 0] : [epsilon * lambda ** 3, epsilon * lambda ** 3, -2],
    [-s, sh, -c - ch],
    [-c + eta * lambda * s, ch + eta * lambda * sh, s - sh + eta * lambda * (c - ch)],
  ];
}

function determinant([a, b, c]: [number, number, number][]): number {
  return (
    a![0] * (b![1] * c![2] - b![2] * c![1]) -
    a![1] * (b![0] * c![2] - b![2] * c![0]) +
    a![2] * (b![0] * c![1] - b![1] * c![0])
  );
}

/** The first wave numbers: of the poles with a free hub, of the hub's zeros with a clamped one. */
function waveNumbers(arm: Arm, count: number, isClamped: boolean): number[] {
  const f = (lambda: number) => determinant(conditions(arm, lambda, isClamped)) / Math.cosh(lambda);
  const roots: number[] = [];
  const step = 0.02;
  for (let low = 0.4; roots.length < count && low < 30; low += step) {
    if (f(low) * f(low + step) >= 0) continue;
    let [a, b] = [low, low + step];
    for (let i = 0; i < 60; ++i) {
      const middle = (a + b) / 2;
      if (f(a) * f(middle) <= 0) b = middle;
      else a = middle;
    }
    roots.push((a + b) / 2);
  }
  return roots;
}

export function totalInertia_kg_m2(arm: Arm): number {
  const beam = (arm.massPerLength_kg_per_m * arm.length_m ** 3) / 3;
  return arm.hubInertia_kg_m2 + beam + arm.payload_kg * arm.length_m ** 2;
}

export function modes(arm: Arm, count: number): Mode[] {
  return waveNumbers(arm, count, false).map((lambda) => {
    const [hub, moment] = conditions(arm, lambda, false);
    // The shape is at right angles to both rows.
    const a = hub![1] * moment![2] - hub![2] * moment![1];
    const b = hub![2] * moment![0] - hub![0] * moment![2];
    const c = hub![0] * moment![1] - hub![1] * moment![0];
    const shape = (x: number) =>
      a * Math.sin(lambda * x) + b * Math.sinh(lambda * x) + c * (Math.cos(lambda * x) - Math.cosh(lambda * x));
    const slope = (lambda * (a + b)) / arm.length_m;
    const points = 400;
    let integral = 0;
    for (let i = 0; i < points; ++i) integral += (shape((i + 0.5) / points) ** 2 * arm.length_m) / points;
    const modalMass =
      arm.massPerLength_kg_per_m * integral + arm.payload_kg * shape(1) ** 2 + arm.hubInertia_kg_m2 * slope ** 2;
    const scale = Math.sqrt(totalInertia_kg_m2(arm) / modalMass);
    return { omega_rad_per_s: omega(arm, lambda), hubSlope: slope * scale, tipValue_m: shape(1) * scale };
  });
}

/** Zeros of the hub angle: the arm clamped at the hub. */
export function hubZeros_rad_per_s(arm: Arm, count: number): number[] {
  return waveNumbers(arm, count, true).map((lambda) => omega(arm, lambda));
}
