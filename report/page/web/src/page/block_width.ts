const kMostWidth = 1240; // px, as in style/page.css
const kSidebar = 240;
const kWideFrom = 861;

/** Width that a block will have, before it is in the page. */
export function blockWidth(): number {
  const width = document.documentElement.clientWidth;
  if (width < kWideFrom) return width - 29;
  return Math.min(width, kMostWidth) - 40 - kSidebar;
}
