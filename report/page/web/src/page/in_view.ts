const pending = new Map<Element, () => void>();

// What is a little below the window is drawn before it is scrolled to.
const observer = new IntersectionObserver(
  (entries) => {
    for (const entry of entries) if (entry.isIntersecting) run(entry.target);
  },
  { rootMargin: "200px" },
);

function run(element: Element): void {
  const draw = pending.get(element);
  pending.delete(element);
  observer.unobserve(element);
  draw?.();
}

/** Calls `draw` once, when the element is in view or the page is printed. */
export function whenInView(element: Element, draw: () => void): void {
  pending.set(element, draw);
  observer.observe(element);
}

export function drawAll(): void {
  for (const element of [...pending.keys()]) run(element);
}
