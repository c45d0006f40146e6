# How Sphinx makes the site of these pages: make docs.
import re
from pathlib import Path

root = Path(__file__).resolve().parent.parent
project = "Drycut"
release = version = re.search(r"project\(drycut VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text()).group(1)
language = "en"

extensions = ["myst_parser"]
exclude_patterns = ["notebooks"]  # their own page format; python.md links to them
myst_heading_anchors = 4  # links such as live.md#modbus
suppress_warnings = ["misc.highlighting_failure"]  # shortened examples: `...` is no word of any language
highlight_language = "text"

html_theme = "furo"
html_title = f"Drycut {version}"
html_static_path = ["site"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
pygments_style = "xcode"  # contrast of 4.5 and more; so is github-dark
pygments_dark_style = "github-dark"
html_show_sourcelink = html_copy_source = False
html_show_copyright = html_show_sphinx = False

# Pages that are a list of pages carry it into the site's contents.
LISTS = {"reference/devices", "reference/plants", "decisions/README"}


def add_contents(app, name, source):
    pages = []
    if name in LISTS:
        pages = re.findall(r"^- \[[^\]]+\]\(([\w-]+)\.md\)", source[0], re.MULTILINE)
    if name == "index":  # what it does not name comes last
        named = set(source[0].split()) | {"index"}
        pages = sorted({page.stem for page in Path(app.srcdir).glob("*.md")} - named)
    if pages:
        caption = ":caption: More\n" if name == "index" else ":hidden:\n"
        source[0] += "\n```{toctree}\n" + caption + "\n" + "\n".join(pages) + "\n```\n"


def leave_out_module(app, page, template, context, doctree):
    context["script_files"] = [file for file in context["script_files"] if "furo.js" not in str(getattr(file, "filename", file))]


def setup(app):
    app.connect("source-read", add_contents)
    app.connect("html-page-context", leave_out_module, priority=900)
