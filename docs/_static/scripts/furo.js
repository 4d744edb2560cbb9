// In place of the theme's script, which Debian ships as a module: browsers refuse modules from files.
// The switch between the reader's setting, light and dark.
const modes = ["auto", "light", "dark"];

function show(mode) {
  document.body.dataset.theme = mode;
  try {
    localStorage.setItem("theme", mode);
  } catch {
    // Storage is switched off: the choice lasts for the page.
  }
}

for (const button of document.getElementsByClassName("theme-toggle")) {
  button.addEventListener("click", () => {
    const next = modes.indexOf(document.body.dataset.theme) + 1;
    show(modes[next % modes.length]);
  });
}
