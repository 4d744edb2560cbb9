/** The block's id, and of several views what this one is: "overlay-run-1-hub-angle". */
export function fileName(block: { id: string; views: unknown[] }, labels: string[]): string {
  if (block.views.length < 2) return block.id;
  const words = labels.map((label) => label.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, ""));
  return [block.id, ...words.filter((word) => word !== "")].join("-");
}
