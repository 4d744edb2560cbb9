import { type Arm, modes, totalInertia_kg_m2 } from "./arm.js";

/** Hub angle over torque at i omega: rigid body and modes. */
export function hubResponse(arm: Arm, frequency_Hz: number): { real: number; imaginary: number } {
  const w = 2 * Math.PI * frequency_Hz;
  const inertia = totalInertia_kg_m2(arm);
  let real = -1 / (inertia * w * w);
  let imaginary = 0;
  for (const mode of modes(arm, 4)) {
    const a = mode.omega_rad_per_s ** 2 - w * w;
    const b = 2 * arm.dampingRatio * mode.omega_rad_per_s * w;
    const gain = mode.hubSlope ** 2 / inertia / (a * a + b * b);
    real += gain * a;
    imaginary -= gain * b;
  }
  return { real, imaginary };
}

export function magnitude({ real, imaginary }: { real: number; imaginary: number }): number {
  return Math.hypot(real, imaginary);
}

/** Between -360 and 0 degrees. */
export function phase_deg({ real, imaginary }: { real: number; imaginary: number }): number {
  const angle = (Math.atan2(imaginary, real) * 180) / Math.PI;
  return angle > 0 ? angle - 360 : angle;
}
