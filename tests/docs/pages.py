"""The pages of docs/ as the tests read them: code blocks, code in the text, links, anchors."""
import re
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
FENCE = re.compile(r"^(```+)([^\n`]*)\n(.*?)^\1[ \t]*$", re.MULTILINE | re.DOTALL)


@dataclass
class Block:
    language: str
    text: str
    line: int  # where it begins


def pages(with_reference=False):
    found = sorted(DOCS.glob("*.md")) + sorted(DOCS.glob("decisions/*.md")) + [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]
    return found + sorted(DOCS.glob("reference/*.md")) if with_reference else found


def blocks(page):
    text = page.read_text()
    return [Block(m[2].strip(), m[3], text.count("\n", 0, m.start()) + 1) for m in FENCE.finditer(text)]


def prose(page):
    """The text without its blocks, line by line as it was."""
    return FENCE.sub(lambda m: "\n" * m[0].count("\n"), page.read_text())


def commands(page):
    """Command lines of drycut and make in blocks and in the text, each with the line where it stands."""
    found = []
    for block in blocks(page):
        if block.language not in ("sh", "console", ""):
            continue
        text = block.text.replace("\\\n", " " * 2)
        for number, line in enumerate(text.split("\n")):
            line = re.sub(r"^\s*(\$ )?(\w+=\S+ )*(build/)?", "", line)
            if re.match(r"(drycut|make) [a-z-]", line) or line == "make":
                found.append((line, block.line + 1 + number))
    text = prose(page)
    for m in re.finditer(r"`((?:build/)?drycut [a-z][^`]*|make [a-z][^`]*)`", text):
        found.append((re.sub(r"\s+", " ", m[1].removeprefix("build/")), text.count("\n", 0, m.start()) + 1))
    return found


def slug(heading):
    """A heading's anchor, as GitHub and the site make it."""
    heading = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
    return re.sub(r"[^\w\- ]", "", heading).replace(" ", "-")


def anchors(page):
    return {slug(m[1]) for m in re.finditer(r"^#+ (.+)$", prose(page), re.MULTILINE)}


def links(page):
    text = re.sub(r"`[^`\n]*`", lambda m: " " * len(m[0]), prose(page))
    for m in re.finditer(r"(!?)\[([^\]]*)\]\(([^)\s]+)\)", text):
        yield m[1] == "!", m[2], m[3], text.count("\n", 0, m.start()) + 1
