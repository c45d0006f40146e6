#!/usr/bin/env python3
"""docs_test.py PROGRAM words|links|commands [PAGE...]: what the pages of docs/ say is so.

words     every command, option, scene, page, device and make target that they name exists; every YAML block is well formed, and one
          of a scenario's sections fits the program's schema
links     no dead link, file or anchor; every picture has a text
commands  every block ```sh runs, in order, a folder a page, as it stands; a YAML block that begins with `# name.yaml` is written to
          that file first; the lines of the block without a language behind it are in the output (`...` is any text); the status
          is 0, or 1 where they tell of a failure"""
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from pathlib import Path

from pages import DOCS, ROOT, anchors, blocks, commands, links, pages, prose

PROGRAM = Path(sys.argv[1]).resolve()
# Blocks that need what a test has not.
NOT_RUN = {"clusters": "Dask and Slurm: make cluster", "sizing": "hundreds of runs", "tuning": "hundreds of runs",
           "ci": "runs in a line's own repository", "new_line": "the tutorial begins so"}


def run(*words, **more):
    return subprocess.run(words, capture_output=True, text=True, **more)


# words


@cache
def subcommands():
    return set(re.findall(r"^  ([a-z]+)(?:  |$)", run(PROGRAM, "--help").stdout, re.MULTILINE)) | {"work", "reference"}


@cache
def options(command):
    return set(re.findall(r"(--?[a-z][\w-]*)", run(PROGRAM, command, "--help").stdout)) | {"--help"}


@cache
def known(*words):
    return run(PROGRAM, *words).returncode == 0


def of_command(words):
    """What is wrong with a command line of drycut."""
    command, rest = words[1], words[2:]
    if command not in subcommands():
        return [f"there is no drycut {command}"]
    wrong = [f"drycut {command} has no {word.split('=')[0]}" for word in rest
             if re.fullmatch(r"--?[a-z][\w-]*(=.*)?", word) and word.split("=")[0] not in options(command)]
    rest = rest[:rest.index(">")] if ">" in rest else rest
    names = [word for word in rest if not word.startswith("-")]
    if command in ("devices", "plants", "help") and names and names[0] not in ("NAME", "TOPIC", "COMMAND", "CODE") and not names[0].endswith(".fmu"):
        if not known(command, *[word for word in ("--motors", "--motor-template", "--units") if word in rest], names[0]):
            wrong.append(f"drycut {command} knows no {names[0]}")
    return wrong


@cache
def targets():
    return set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))


def words(page):
    wrong = []
    for line, number in commands(page):
        line = line.split(" #")[0].split("; echo")[0].split(" | ")[0]
        line = re.split(r"\s(?:--over|--vary|…|\.\.\.)$", line)[0]
        try:
            parts = shlex.split(line)
        except ValueError:
            continue  # shortened
        if parts[0] == "make":
            found = [] if len(parts) == 1 or parts[1] in targets() or "=" in parts[1] else [f"there is no make {parts[1]}"]
        else:
            found = of_command([part for part in parts if part not in ("…", "...")])
        wrong += [f"{page.name}:{number}: {what}" for what in found]
    text = page.read_text()
    for path in set(re.findall(r"(?<![\w/.-])((?:scenes|docs|tests|examples)/[\w/.-]+\.\w+)", text)):
        if not (ROOT / path).exists() and not re.search(r"line\.yaml$|/[A-Z]+\.", path):
            wrong.append(f"{page.name}: there is no {path}")
    return wrong + yaml_of(page) + (scenes_of(page) if page.name == "scenes.md" else [])


def scenes_of(page):
    """The table of scenes has them all, and no others."""
    listed = set()
    for row in re.findall(r"^\| (`[^|]*) \|", page.read_text(), re.MULTILINE):
        names = re.findall(r"`([^`]*)`", row)
        listed |= {names[0]} | {names[0] + name if name.startswith("_") else name for name in names[1:]}
    there = {scene.stem for scene in (ROOT / "scenes").glob("*.yaml")}

    def shown(name):  # `commissioning_counter`, `_output`: the ending stands in place of the last word
        return name in there or any(name.startswith(first) and first.rsplit("_", 1)[0] + name[len(first):] in there
                                    for first in listed if "_" in first)

    wrong = [f"scenes.md: there is no scene {name}" for name in sorted(listed) if not shown(name)]
    full = listed | {first.rsplit("_", 1)[0] + name[len(first):] for name in listed for first in listed
                     if "_" in first and name.startswith(first + "_")}
    return wrong + [f"scenes.md: {name} is not listed" for name in sorted(there - full)]


@cache
def schema():
    return json.loads(run(PROGRAM, "check", "--schema").stdout)


def yaml_of(page):
    import jsonschema
    import yaml
    sections = set(schema()["else"]["else"]["then"]["properties"])
    wrong = []
    for block in blocks(page):
        if block.language != "yaml":
            continue
        # Several values of one key, a line each, are examples of it.
        lines = [line for line in block.text.split("\n") if re.match(r"\w", line)]
        keys = [line.split(":")[0] for line in lines]
        parts = [block.text] if len(set(keys)) == len(keys) else lines
        for part in parts:
            try:
                value = yaml.safe_load(part)
            except yaml.YAMLError as error:
                wrong.append(f"{page.name}:{block.line}: {error}")
                continue
            if isinstance(value, dict) and set(value) <= sections:
                part_of_one = {"extends": "another.yaml", **value}  # then no section is missing
                wrong += [f"{page.name}:{block.line}: {'.'.join(map(str, error.path))}: {error.message[:200]}"
                          for error in jsonschema.Draft202012Validator(schema()).iter_errors(part_of_one)]
    return wrong


# links


def dead(page):
    wrong = []
    for picture, text, target, line in links(page):
        where = f"{page.relative_to(ROOT)}:{line}"
        if picture and not text.strip():
            wrong.append(f"{where}: the picture {target} has no text")
        if re.match(r"[a-z]+:", target):
            continue
        name, _, anchor = target.partition("#")
        file = (page.parent / name).resolve() if name else page
        if not file.exists():
            wrong.append(f"{where}: there is no {target}")
        elif anchor and file.suffix == ".md" and anchor not in anchors(file):
            wrong.append(f"{where}: {file.name} has no heading for #{anchor}")
    return wrong


# commands


def missing(expected, output):
    """Lines of `expected` that are not in `output`, in their order."""
    at = 0
    for line in expected.splitlines():
        pattern = ".*".join(re.escape(part) for part in line.strip().split("..."))
        found = re.compile(r"^\s*" + pattern + r"\s*$", re.MULTILINE).search(output, at)
        if not found:
            yield line
        else:
            at = found.end()


def told_behind(found, number):
    """The output that the page shows directly behind a block, "" = none."""
    block, behind = found[number], found[number + 1] if number + 1 < len(found) else None
    near = behind and behind.line - (block.line + block.text.count("\n") + 1) <= 2
    return behind.text if near and behind.language == "" else ""


def runs(page):
    found = blocks(page)
    if not any(block.language == "sh" for block in found) or page.parent != DOCS or page.stem in NOT_RUN:
        return []
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        here = Path(folder)
        (here / "scenes").symlink_to(ROOT / "scenes")
        tools = here / ".bin"
        tools.mkdir()
        (tools / "drycut").symlink_to(PROGRAM)
        environment = dict(os.environ, HOME=folder, PATH=f"{tools}:{os.environ['PATH']}", COLUMNS="0")
        environment.pop("GITHUB_ACTIONS", None)
        for number, block in enumerate(found):
            name = re.match(r"# (\S+\.yaml)\n", block.text)
            if block.language == "yaml" and name:
                (here / name[1]).write_text(block.text)
            elif block.language == "sh":
                # As in a shell, a line that fails does not keep the next one back; unless the page looks at the status, one must not fail.
                strict = [] if "$?" in block.text else ["-e"]
                done = subprocess.run(["bash", *strict, "-c", "trap 'pwd > ~/.here' EXIT\n" + block.text], cwd=here, env=environment,
                                      stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                output = done.stdout
                told = told_behind(found, number)
                if done.returncode not in ((0, 1) if "FAILED" in told or "RED" in told else (0,)):
                    wrong.append(f"{page.name}:{block.line}: status {done.returncode}\n{output[-1500:]}")
                    break
                here = Path((Path(folder) / ".here").read_text().strip())
                wrong += [f"{page.name}:{block.line}: not in the output: {line}\n{output[-1500:]}"
                          for line in missing(told, output)]
    return wrong


def main():
    kind, chosen = sys.argv[2], sys.argv[3:]
    what = {"words": words, "links": dead, "commands": runs}[kind]
    if kind == "words":
        try:
            import jsonschema  # noqa: F401
            import yaml  # noqa: F401
        except ImportError:
            print("skipped without python3-jsonschema and python3-yaml")
            return 77
    if kind == "commands" and not shutil.which("bash"):
        print("skipped without bash")
        return 77
    every = [page for page in pages(kind == "links") if not chosen or page.stem in chosen]
    with ThreadPoolExecutor(os.cpu_count() if kind == "commands" else 1) as workers:
        wrong = [line for lines in workers.map(what, every) for line in lines]
    print("\n".join(wrong) or f"{len(every)} pages")
    return 1 if wrong else 0


sys.exit(main())
