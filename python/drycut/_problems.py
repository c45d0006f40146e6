"""What goes wrong, and what the other files share."""

from __future__ import annotations

import os
from typing import Callable, Mapping, NamedTuple, Optional, Sequence, Union

import numpy as np

from . import _core

Path = Union[str, "os.PathLike[str]"]
#: {"plants.web.speed": "80 m/min", "controller.qmove.set.AxisX.pgain": 40}
Settings = Mapping[str, object]
#: called with how many of how many runs are done
Progress = Optional[Callable[[int, int], object]]


class Problem(NamedTuple):
    """One fault of an input.

    file    or the argument that is wrong: "set", "over"
    line    from 1
    column  from 1; of an argument in its text as the command line has it, PATH=VALUE
    what    what is wrong
    remedy  what would be right
    code    its kind, the same in every release: "scenario.unknown-key"; `drycut help CODE` tells more
    """

    file: str
    line: int
    column: int
    what: str
    remedy: str
    code: str


class BadInput(ValueError):
    """What was given does not fit. `problems` has all of them, of files and arguments; it is empty where a single call
    to a Simulation was wrong."""

    def __init__(self, message: str, problems: Sequence[tuple[str, int, int, str, str, str]] = ()):
        super().__init__(message)
        self.problems = [Problem(*problem) for problem in problems]


class Diverged(RuntimeError):
    """The simulation itself cannot go on."""


_core.set_exceptions(BadInput, Diverged)


def refuse(code: str, argument: str, what: str, remedy: str) -> BadInput:
    """The error to raise where an argument does not fit."""
    return BadInput(f"{argument}:1:1: {what}; {remedy} [{code}]", [(argument, 1, 1, what, remedy, code)])


def check_folder(out: Path | None) -> None:
    if out is not None and not os.fspath(out):
        raise refuse("option.missing", "out", "it is empty", "name a folder")


def text(value: object) -> str:
    """A value as the command line takes it."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    return repr(float(value)) if isinstance(value, np.floating) else str(value)


def settings(given: Settings | None) -> dict[str, str]:
    return {path: text(value) for path, value in (given or {}).items()}
