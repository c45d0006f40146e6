"""Scenarios run: whole, and step by step."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from . import _core
from ._problems import Path, Settings, check_folder, settings
from ._tables import Table, frame, table

if TYPE_CHECKING:
    import pandas  # type: ignore[import]


class Event(NamedTuple):
    """Something that happened: in a plant, a device, a task or the timeline.

    time    [s] since the beginning of the run; it may lie inside a step
    source  "knife"
    name    "cut"
    values  {"length": 800.012, "mismatch": 5.1, ...}, in the units that events.csv gives
    text    of a remark, else ""
    """

    time: float
    source: str
    name: str
    values: dict[str, float]
    text: str


class _Check(NamedTuple):
    name: str
    expectation: str
    passed: bool
    margin: float | None
    unit: str
    at: float | None
    detail: str


class Check(_Check):
    """What a check of the scenario came to: a tuple of the first seven, the others are its attributes.

    name         as the scenario has it
    expectation  "each cut: abs(length - 800) <= 0.1, from 4 s"
    passed       True where it holds
    margin       how far the worst moment was from the limit; negative: beyond it; None: there is none to tell
    unit         of the margin, "" = a pure number
    at           the worst moment [s]; None: not known
    detail       in words
    failed_at    when it failed first [s]; None: it did not, or that can be said at the end only
    used         share of the limit at the worst moment, above 1: beyond it; None: not known
    tolerances   limits that it sets for values of events: dicts with event, value, low, high, from, until [s]
    idle         it failed for it found nothing to judge
    doubt        though it passed: why it may have judged nothing; "" = none
    too_few      from when on there were too few of the events that it counts [s]; None: there were not
    names        of what it looks at: "length", "AxisX.follerr"
    deadline     its limit is a time by which something has come
    throughout   where it held at none of its instants: what there was; "" else
    so_far       it held until the run stopped, with more to judge: `passed` is no verdict then
    """

    failed_at: float | None
    used: float | None
    tolerances: list[dict[str, Any]]
    idle: bool
    doubt: str
    too_few: float | None
    names: list[str]
    deadline: bool
    throughout: str
    so_far: bool

    def __new__(cls, *args: Any, **named: Any) -> "Check":
        check = super().__new__(cls, *args, **{key: named.pop(key) for key in cls._fields if key in named})
        check.__dict__.update(named)
        return check


@dataclass
class Covered:
    """What of a program's file has run.

    lines      how often, by line: those that can run
    branches   by line, for each decision how often each of its ways was taken: held and did not hold; of a CASE its
               bodies and none of them
    functions  how often each was called, by name
    never      the lines that never ran: "3, 7-9"
    """

    lines: dict[int, int]
    branches: dict[int, list[list[int]]]
    functions: dict[str, int]
    never: str


@dataclass
class Run:
    """What drycut.run() gives.

    passed   every check held and the simulation came to its end
    failure  why the simulation itself stopped before, "" if it did not
    checks   a Check each
    events   an Event each, in the order of time
    trace    numpy structured array, shape (instants,): field `time` [s], then a float64 field a recorded channel
    units    of the fields of `trace`, "" = a pure number
    notes    what a reader should know that is no fault
    outcome  all that came of it, as in checks.json: end [s], cause, warnings, alarms, drives with their figures; and of
             each drive points and cycle_points, numpy arrays, shape (points, 2): speed [rad/s] and torque [N m] at
             record instants; mean speed and rms torque of each cycle
    coverage  with coverage=True, by file of the controller's programs: a Covered each
    """

    passed: bool
    failure: str
    checks: list[Check]
    events: list[Event]
    trace: Table
    units: dict[str, str]
    notes: list[str]
    outcome: dict[str, Any] = field(default_factory=dict)
    coverage: dict[str, Covered] = field(default_factory=dict)

    def frame(self) -> "pandas.DataFrame":
        """The trace as a pandas DataFrame over time [s]; units in its `attrs["units"]`. Needs pandas."""
        return frame(self.trace, self.units, "time")


def run(file: Path, set: Settings | None = None, *, out: Path | None = None, pictures: bool = True,
        coverage: bool = False) -> Run:
    """Runs a scenario from time zero to its end.

    file  scenario (.yaml)
    set   overrides, {"plants.web.speed": "80 m/min"}
    out   folder for what `drycut run` puts into the scenario's own, the same bytes: trace.csv and events.csv or
          trace.h5, checks.json, report.html, plots and film, and retentive values into their file; else nothing is
          drawn or written
    pictures  False: no frames, plots or report, as --no-pictures
    coverage  True: count what of the controller's programs runs, as --coverage

    Raises BadInput with all problems of the scenario and its programs.
    """
    check_folder(out)
    got = _core.run(file, settings(set), out, pictures, coverage)
    outcome = got["outcome"]
    return Run(passed=outcome["passed"], failure=outcome["failure"], checks=[Check(**check) for check in outcome["checks"]],
               events=[Event(*event) for event in got["events"]], trace=table(got["columns"], got["units"]),
               units=got["units"], notes=got["notes"], outcome=outcome,
               coverage={file: Covered(**covered) for file, covered in got["coverage"].items()})


class Simulation(_core.Simulation):
    """A scenario put together and run step by step: the controller with its program, the machine, wires, timeline
    and checks as run() has them. One object is one run from time zero; the same calls give the same numbers. One
    thread at a time works on it."""

    def __init__(self, file: Path, set: Settings | None = None):
        """Reads the scenario (.yaml) with its overrides. Raises BadInput with all problems."""
        super().__init__(file, settings(set))
        self._made_of = (os.path.abspath(file), settings(set))

    # Named once more, so that help() tells of them here.
    step = _core.Simulation.step
    advance = _core.Simulation.advance
    read = _core.Simulation.read
    write = _core.Simulation.write

    def unit(self, name: str) -> str:
        """Of what is read or written under a name; "" = a pure number."""
        return super().unit(name)

    def names(self) -> list[str]:
        """All names that read() takes."""
        return super().names()

    @property
    def time(self) -> float:
        """[s] since the beginning of the run."""
        return super().time

    @property
    def step_length(self) -> float:
        """[s] of a step."""
        return super().step_length

    @property
    def duration(self) -> float:
        """[s] that run() would run; a program may go on beyond it."""
        return super().duration

    def save(self) -> bytes:
        """This moment, for any file or process: restore() of this object, or of another one of the same scenario,
        `set` and build of Drycut, comes back to it and goes on as if nothing had been between. A Simulation can be
        pickled, too: into a worker process, for one."""
        return super().save()

    def restore(self, moment: bytes) -> None:
        """Comes back to a moment of save(), from whatever moment this has come to. take_events() gives what happens
        from then on. Raises BadInput, which says what differs, for bytes that are no such moment; then nothing has
        changed."""
        super().restore(moment)

    def __reduce__(self) -> tuple[Any, ...]:
        return _at_moment, (*self._made_of, self.save())

    def take_events(self) -> list[Event]:  # type: ignore[override]
        """What happened since the last call."""
        return [Event(*event) for event in super().take_events()]

    def checks(self) -> list[Check]:  # type: ignore[override]
        """The checks of the scenario as if the run ended now."""
        return [Check(**check) for check in super().checks()]


def _at_moment(file: str, set: Settings, moment: bytes) -> Simulation:
    """What a pickled Simulation becomes."""
    line = Simulation(file, set)
    line.restore(moment)
    return line
