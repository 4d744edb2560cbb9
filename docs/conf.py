"""The manual as a site: scripts/manual builds it."""

import re
from pathlib import Path

project = "flexarm"
author = "The flexarm authors"
copyright = "2026, the flexarm authors"  # noqa: A001: Sphinx's name
version = re.search(r"project\(flexarm VERSION (\S+)",
                    Path(__file__).parent.with_name("CMakeLists.txt").read_text(encoding="utf-8"))[1]
release = version

extensions = ["myst_parser", "sphinx_copybutton"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
nitpicky = True

# Equations by KaTeX, without a network: Sphinx loads `mathjax_path` where a page has equations.
html_static_path = ["_static", "/usr/share/javascript/katex"]
html_css_files = ["katex.min.css", "output.css"]
html_js_files = [("katex.min.js", {"priority": 100}), ("contrib/auto-render.js", {"priority": 110})]
mathjax_path = "render-equations.js"
mathjax_options = {"defer": "defer"}

html_theme = "furo"
html_title = f"flexarm {version}"
html_show_sphinx = False
html_copy_source = False
html_show_sourcelink = False
# A reader copies the commands, not the prompt and not the output.
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True
