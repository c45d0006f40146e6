#!/usr/bin/env python3
"""How the house hangs together, counted over the product's C++: which room includes which, how long chains of includes
are, how many headers a source reaches, how many type names mean two things."""
import re
import statistics
import sys
from collections import defaultdict
from pathlib import Path

HOUSE = Path(__file__).resolve().parents[2]

# Every folder is a room. From below: a room includes only those that stand before it.
LAYERS = """
include/drycut base
devices devices/axis devices/cam devices/camming4 devices/epicpos devices/oopos2 devices/modbus devices/qmove
devices/lx3vp devices/plcopen devices/plcopen/st devices/plcopen/controller
plants renders renders/loaded
sim sim/fmi/machine sim/fmi/host sim/record sim/record/hdf5 sim/scenario sim/fmi/foreign sim/controllers sim/recordings sim/loop sim/fmi/line sim/fmi/binary
sim/cams sim/cams/camming4 sim/cams/lx3vp sim/cams/mc_camin sim/studies sim/report
sim/studies/cluster sim/studies/bode sim/studies/fit sim/studies/tune sim/studies/sweep sim/studies/size sim/studies/faults sim/studies/compare
sim/studies/why sim/studies/design sim/live sim/live/modbus sim/fmi sim/cli python
""".split()
# Controllers, machines and pictures know nothing of each other, and the loop's library draws nothing.
APART = ["devices", "plants", "renders"]
DRAWS_NOTHING = ["sim", "sim/fmi/machine", "sim/fmi/line", "sim/fmi/binary", "sim/fmi/host", "sim/fmi/foreign", "sim/fmi", "sim/record", "sim/record/hdf5", "sim/scenario", "sim/controllers", "sim/recordings",
                 "sim/loop"]

LONGEST_CHAIN = 13  # files, the first one included
MEDIAN_REACHED = 11  # own headers that a source reads, however deep
NAMES_TWICE = 15


def room_of(file):
    return file.rsplit("/", 1)[0]


def may_include(room, other):
    house, there = room.split("/")[0], other.split("/")[0]
    return (LAYERS.index(other) < LAYERS.index(room) and not (house in APART and there in APART and house != there)
            and not (room in DRAWS_NOTHING and there == "renders"))


def own_includes(files):
    """What each file includes of `files`, by its path from the house or from include/."""
    found = {}
    for file, text in files.items():
        named = re.findall(r'^#include [<"]([^>"]+)[>"]', text, re.MULTILINE)
        found[file] = [path for name in named for path in (name, "include/" + name) if path in files]
    return found


def longest_chain(includes):
    chains = {}

    def chain(file):
        if file not in chains:
            chains[file] = [file]  # of a circle
            chains[file] = [file] + max((chain(to) for to in includes[file]), key=len, default=[])
        return chains[file]

    return max((chain(file) for file in includes), key=len)


def reached(file, includes):
    seen, rest = set(), [file]
    while rest:
        new = [to for to in includes[rest.pop()] if to not in seen]
        seen.update(new)
        rest += new
    return seen


def without_texts(text):
    """The code alone: no comments, texts, lines of the preprocessor."""
    skipped = r'R"(\w*)\((?:.|\n)*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'|//[^\n]*|/\*(?:.|\n)*?\*/'
    return re.sub(r"^[ \t]*#[^\n]*", "", re.sub(skipped, " ", text), flags=re.MULTILINE)


def types_of(text):
    """The names of the classes, structs and enums that a file defines in a namespace, one without a name among them. What
    stands inside a type or a function does not count: it is known by its owner's name, as in Token::Kind."""
    names, open_braces, head = [], [], ""
    for part in re.split(r"([{};])", without_texts(text)):
        if part == "{":
            is_namespace = re.search(r"\bnamespace\b[^()=]*$", head) is not None
            named = re.search(r"\b(?:struct|class|enum(?:\s+class|\s+struct)?)\s+(\w+)(?:\s+final)?\s*(?::[^:].*)?$",
                              head.strip(), re.DOTALL)
            if named and all(open_braces):
                names.append(named.group(1))
            open_braces.append(is_namespace)
        elif part == "}":
            open_braces.pop()
        head = "" if part in "{};" else part
    return names


def check_counting():
    text = """
    namespace a { struct One final : Base<int> { enum class Kind { x, y }; int f() { struct In {}; return 0; } }; }
    namespace { enum class Two : bool { no, yes }; struct Only; }  // struct NoneA {}
    template <> struct fmt::formatter<a::One> { }; auto text = "struct NoneB {"; struct One value{};
    """
    assert types_of(text) == ["One", "Two"], types_of(text)
    assert not may_include("plants", "devices/cam") and not may_include("sim/loop", "renders")
    assert may_include("sim/loop", "plants") and not may_include("sim/loop", "sim/cli")
    assert longest_chain({"a": ["b", "c"], "b": ["c"], "c": []}) == ["a", "b", "c"]
    assert reached("a", {"a": ["b"], "b": ["c"], "c": []}) == {"b", "c"}


def main():
    check_counting()
    files = {}
    for top in sorted({room.split("/")[0] for room in LAYERS}):
        for path in sorted((HOUSE / top).rglob("*.[ch]pp")):
            files[path.relative_to(HOUSE).as_posix()] = path.read_text()
    includes = own_includes(files)
    faults = []

    arrows = defaultdict(set)
    for file, named in includes.items():
        room = room_of(file)
        if room not in LAYERS:
            faults.append(f"{file}: {room} is no room; give it a place in LAYERS")
            continue
        for to in named:
            other = room_of(to)
            if other == room or other not in LAYERS:
                continue
            arrows[room].add(other)
            if not may_include(room, other):
                faults.append(f"{file}: includes {to}; {room} may not include {other}")
    faults += [f"{room}: no files; take it out of LAYERS" for room in LAYERS
               if room not in {room_of(file) for file in files}]
    mutual = [(a, b) for a in arrows for b in arrows[a] if a < b and a in arrows.get(b, ())]

    chain = longest_chain(includes)
    if len(chain) > LONGEST_CHAIN:
        faults.append(f"a chain of {len(chain)} files, more than {LONGEST_CHAIN}: " + " -> ".join(chain))
    counts = [len(reached(file, includes)) for file in files if file.endswith(".cpp")]
    median = statistics.median(counts)
    if median > MEDIAN_REACHED:
        faults.append(f"a source reaches {median} own headers in the median, more than {MEDIAN_REACHED}")

    places = defaultdict(list)
    for file, text in files.items():
        for name in types_of(text):
            places[name].append(file)
    twice = {name: where for name, where in sorted(places.items()) if len(where) > 1}
    if len(twice) > NAMES_TWICE:
        faults += [f"{name} is a type in {', '.join(where)}" for name, where in twice.items()]

    print("\n".join(faults + [f"{len(files)} files in {len(LAYERS)} rooms; {len(mutual)} pairs of rooms include each other",
                              f"longest chain of includes: {len(chain)} files",
                              f"own headers that a source reaches: {median:g} in the median, {max(counts)} at most",
                              f"{len(places)} type names, {len(twice)} of two things: {', '.join(twice)}"]))
    return 1 if faults else 0


sys.exit(main())
