import type { Role } from "../contract.js";

/** Stroke of each role, as in the SVG figures (report/figures/overlay_style.cpp, diagnosis_figures.cpp):
 * what is measured is broad and pale below, what coincides with it is narrow on top. The colours are
 * in style/colours.css under --NAME. */
export const kRoleStyles: Record<Role, { width: number; dash: number[] }> = {
  measured: { width: 3.5, dash: [] },
  before: { width: 1.4, dash: [] },
  after: { width: 1.4, dash: [] },
  residual_before: { width: 1.2, dash: [] },
  residual_after: { width: 1.2, dash: [] },
  bound: { width: 1.2, dash: [6, 4] },
  noise: { width: 1.4, dash: [2, 3] },
  coherence: { width: 1.4, dash: [] },
  first: { width: 4, dash: [] },
  second: { width: 1.6, dash: [] },
  third: { width: 1.6, dash: [8, 4] },
  fourth: { width: 1.8, dash: [2, 3] },
  fifth: { width: 1.6, dash: [8, 3, 2, 3] },
  sixth: { width: 1.6, dash: [12, 3] },
};

/** Name of the role's colour in the style sheet. */
export function colourName(role: Role): string {
  return `role-${role.replaceAll("_", "-")}`;
}
