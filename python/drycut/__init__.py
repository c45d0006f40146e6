"""Virtual commissioning of cut-to-length lines, from Python.

    import drycut

    run = drycut.run("scenes/rotary_knife.yaml", set={"plants.web.speed": "80 m/min"})
    run.passed                          # True where every check holds
    run.trace["knife.motor.torque"]     # numpy array, a number a record instant
    run.units["knife.motor.torque"]     # 'N m'
    [cut.values["length"] for cut in run.events if cut.name == "cut"]

    line = drycut.Simulation("scenes/rotary_knife.yaml")
    line.advance(3.0)                   # seconds of the machine
    line.write("panel.start", 1)
    line.read("knife.speed"), line.unit("knife.speed")

run        a scenario from its beginning to its end, with its trace
Simulation the same step by step: read and write by name while it runs
cam        a cam table judged and sampled without a machine
bode       the frequency response of a position loop, with its margins

Overrides (`set`) are those of the command line's --set: a path in the scenario and a value with its unit as
text, or a number. What does not fit raises BadInput, whose `problems` tell file, line and column. Long calls let
other threads run: two simulations in two threads take two cores.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Mapping, NamedTuple, Sequence

import numpy as np

from . import _core

if TYPE_CHECKING:
    import pandas

__all__ = ["BadInput", "Bode", "Cam", "Check", "Diverged", "Event", "Finding", "Margin", "Problem", "Run",
           "Simulation", "bode", "cam", "run"]
__version__: str = _core.version

Path = "str | os.PathLike[str]"


class Problem(NamedTuple):
    """One fault of an input text."""

    file: str
    line: int  #: from 1
    column: int  #: from 1
    what: str  #: what is wrong
    remedy: str  #: what would be right


class BadInput(ValueError):
    """What was given does not fit. `problems` has all of them, of files and overrides; it is empty where the call
    itself was wrong."""

    def __init__(self, message: str, problems: Sequence[tuple] = ()):
        super().__init__(message)
        self.problems = [Problem(*problem) for problem in problems]


class Diverged(RuntimeError):
    """The simulation itself cannot go on."""


_core.set_exceptions(BadInput, Diverged)


class Event(NamedTuple):
    """Something that happened: in a plant, a device, a task or the timeline."""

    time: float  #: [s] since the beginning of the run; it may lie inside a step
    source: str  #: "knife"
    name: str  #: "cut"
    values: dict[str, float]  #: in the units that events.csv gives
    text: str  #: of a remark, else ""


class Check(NamedTuple):
    """What a check of the scenario came to."""

    name: str
    expectation: str  #: "each cut: abs(length - 800) <= 0.1, from 4 s"; "" of Simulation.checks()
    passed: bool
    margin: float | None  #: how far the worst moment was from the limit; negative: beyond it
    unit: str  #: of the margin
    at: float | None  #: [s] the worst moment
    detail: str


@dataclass
class Run:
    """What drycut.run() gives."""

    passed: bool  #: every check held and the simulation came to its end
    failure: str  #: why the simulation itself stopped before, "" if it did not
    checks: list[Check]
    events: list[Event]
    trace: np.ndarray  #: structured, shape (instants,): field `time` [s], then a float64 field a recorded channel
    units: dict[str, str]  #: of the fields of `trace`, "" = a pure number
    notes: list[str]  #: what a reader should know that is no fault

    def frame(self) -> "pandas.DataFrame":
        """The trace as a pandas DataFrame over time [s]; units in its `attrs["units"]`. Needs pandas."""
        import pandas

        frame = pandas.DataFrame({name: self.trace[name] for name in self.trace.dtype.names if name != "time"},
                                 index=pandas.Index(self.trace["time"], name="time [s]"))
        frame.attrs["units"] = dict(self.units)
        return frame


class Margin(NamedTuple):
    """A margin and where it is."""

    value: float
    frequency: float  #: [Hz]


@dataclass
class Bode:
    """What drycut.bode() gives."""

    wire: str  #: the analogue reference that was measured through
    loop: str  #: "closed"; "open", "restless", "runaway" or "unstable": then there are no points
    frequency: np.ndarray  #: [Hz], shape (points,)
    open_loop: np.ndarray  #: complex L, as the controller closes it, sampling and hold included; shape (points,)
    error: np.ndarray  #: its relative standard error; shape (points,)
    phase_margin: Margin | None  #: [deg]; None: not met between the first and the last frequency
    gain_margin: Margin | None  #: [dB]
    gain_margin_down: Margin | None  #: of less gain, below 0 [dB]
    peak_sensitivity: Margin | None  #: largest |1 / (1 + L)|
    bandwidth: float | None  #: of the closed position loop at -3 dB [Hz]
    doubts: list[str] = field(default_factory=list)  #: what keeps the measurement from being trusted

    @property
    def closed_loop(self) -> np.ndarray:
        """L / (1 + L), shape (points,)."""
        return self.open_loop / (1 + self.open_loop)


class Finding(NamedTuple):
    """One thing found in a cam."""

    grade: str  #: "error", "limit", "warning", "caution", "remark"
    number: int  #: of the device's error or warning, 0 = it has none
    where: str  #: "sector 4 (135 DZC)", "row 12"; "" = of the whole cam
    text: str
    remedy: str


@dataclass
class Cam:
    """What drycut.cam() gives."""

    device: str  #: "camming4", "lx3vp", "mc_camin"
    sound: bool  #: neither an error nor a violated limit
    findings: list[Finding]
    points: np.ndarray  #: structured, shape (points,): master, slave, velocity, acceleration, jerk, row; over the master
    unit: str  #: of the table's master
    report: str  #: as `drycut cam` prints it


def _settings(given: Mapping[str, object] | None) -> dict[str, str]:
    def text(value: object) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        return repr(float(value)) if isinstance(value, np.floating) else str(value)

    return {path: text(value) for path, value in (given or {}).items()}


def _table(columns: Mapping[str, np.ndarray], units: Mapping[str, str] | None = None) -> np.ndarray:
    kinds = [(name, np.dtype(values.dtype, metadata={"unit": units[name]}) if units else values.dtype)
             for name, values in columns.items()]
    table = np.empty(len(next(iter(columns.values()))), dtype=kinds)
    for name, values in columns.items():
        table[name] = values
    return table


def run(file: Path, set: Mapping[str, object] | None = None) -> Run:
    """Runs a scenario from time zero to its end, without pictures and files.

    file  scenario (.yaml)
    set   overrides, {"plants.web.speed": "80 m/min"}

    Raises BadInput with all problems of the scenario and its programs.
    """
    got = _core.run(file, _settings(set))
    return Run(passed=got["passed"], failure=got["failure"], checks=[Check(*check) for check in got["checks"]],
               events=[Event(*event) for event in got["events"]], trace=_table(got["columns"], got["units"]),
               units=got["units"], notes=got["notes"])


class Simulation:
    """A scenario put together and run step by step: the controller with its program, the machine, wires, timeline
    and checks as run() has them. One object is one run from time zero; the same calls give the same numbers."""

    def __init__(self, file: Path, set: Mapping[str, object] | None = None):
        """Reads the scenario (.yaml). Raises BadInput with all problems."""
        self._line = _core.Simulation(file, _settings(set))
        # Past the methods below, which tell what they do: a call less each, and programs call them every step.
        self.step = self._line.step
        self.advance = self._line.advance
        self.read = self._line.read
        self.write = self._line.write

    def step(self) -> None:
        """One step of the machine, `step_length` long. Raises Diverged."""

    def advance(self, seconds: float) -> None:
        """So many seconds, 0 or more, rounded to whole steps. Raises Diverged; BadInput for other numbers."""

    def read(self, name: str) -> float:
        """The number under a name as it is now, in unit(name). Raises BadInput if nothing has this name."""

    def write(self, name: str, value: float) -> None:
        """Sets what a timeline may set: a plant's setting, a panel switch (0, 1), a value of the controller, which
        takes it as from an HMI. In unit(name). Raises BadInput if nothing has this name, it can only be read, or the
        number is beyond its range."""

    def unit(self, name: str) -> str:
        """Of what is read or written under a name; "" = a pure number."""
        return self._line.unit(name)

    def names(self) -> list[str]:
        """All names that read() takes."""
        return self._line.names()

    @property
    def time(self) -> float:
        """[s] since the beginning of the run."""
        return self._line.time

    @property
    def step_length(self) -> float:
        """[s] of a step."""
        return self._line.step_length

    @property
    def duration(self) -> float:
        """[s] that run() would run; a program may go on beyond it."""
        return self._line.duration

    def take_events(self) -> list[Event]:
        """What happened since the last call."""
        return [Event(*event) for event in self._line.take_events()]

    def checks(self) -> list[Check]:
        """The checks of the scenario as if the run ended now."""
        return [Check(*check) for check in self._line.checks()]


def cam(file: Path, *, device: str = "", master_speed: float | None = None, max_velocity: float | None = None,
        max_acceleration: float | None = None, at: Sequence[float] = (), loops: int = 1) -> Cam:
    """Validates and samples a cam table without a machine.

    file              cam table (.csv, .tab)
    device            "camming4", "lx3vp" or "mc_camin"; else by the table's header
    master_speed      what depends on it is judged too, in the table's own unit (see `drycut cam --help`)
    max_velocity      limit of the slave, with master_speed
    max_acceleration  limit of the slave, with master_speed
    at                master positions to sample at, in the table's unit; else 1000 a pass and every boundary
    loops             times round, for a cam that comes back to its beginning

    Raises BadInput with all problems of the table.
    """
    got = _core.cam(file, device, master_speed, max_velocity, max_acceleration, list(at), loops)
    return Cam(device=got["device"], sound=got["sound"], findings=[Finding(*each) for each in got["findings"]],
               points=_table(got["columns"]), unit=got["unit"], report=got["report"])


def bode(file: Path, set: Mapping[str, object] | None = None, *, wire: str = "", at: str | None = None,
         lowest: float | None = None, highest: float | None = None, points: int = 40, amplitude: float = 0.1,
         settle: float = 0.5) -> Bode:
    """Measures the frequency response of a closed position loop: a sine is added to the analogue reference.

    file       scenario (.yaml)
    set        overrides of it
    wire       analogue reference, "knife.servo.reference"; not needed where there is one
    at         "6 s": the scenario runs undisturbed until then; else to its end
    lowest     frequency [Hz], else 1, and lower to the crossover
    highest    frequency [Hz], else half the sampling frequency
    points     frequencies between them, evenly in decades
    amplitude  of the sine [V]
    settle     before each measurement [s]

    Raises BadInput if the request does not fit the scenario, Diverged if the simulation cannot go on.
    """
    got = _core.bode(file, _settings(set), wire, at, lowest, highest, points, amplitude, settle)
    for name in ("phase_margin", "gain_margin", "gain_margin_down", "peak_sensitivity"):
        got[name] = Margin(*got[name]) if got[name] else None
    return Bode(**got)
