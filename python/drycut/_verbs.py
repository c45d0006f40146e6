"""The verbs of the command line that have no class of their own: made of the program's own table."""

from __future__ import annotations

import inspect
import json
import os
from dataclasses import dataclass, field
from typing import Any, Callable, Mapping, NamedTuple

from . import _core
from ._problems import BadInput, Diverged, text

INTERRUPTED = 130


@dataclass
class Ran:
    """What a verb gives.

    passed   status 0
    status   0 all passed, 1 a check failed
    text     what the command prints
    notes    what it tells on standard error
    verdict  verdict.json of the folder that it wrote into, as a dict; None: it wrote none
    """

    status: int
    text: str
    notes: str
    verdict: dict[str, Any] | None = field(default=None)

    @property
    def passed(self) -> bool:
        return self.status == 0


class Option(NamedTuple):
    """An option of a verb, as the command line has it.

    name        "--max-travel"
    positional  it has no dashes
    flag        it has no value
    several     it may be given more than once
    required    it must be given
    default     as text, "" = none
    meaning     what it is for
    """

    name: str
    positional: bool
    flag: bool
    several: bool
    required: bool
    default: str
    meaning: str

    @property
    def argument(self) -> str:
        """As Python calls it: "--max-travel" is max_travel, "--from" from_."""
        name = self.name.lstrip("-").replace("-", "_")
        return name + "_" if name in ("from", "import", "in", "is") else name

    def words(self, value: object) -> list[str]:
        """The words of a command line that give it this value."""
        if value is None or value is False:
            return []
        if self.flag:
            return [self.name]
        if isinstance(value, Mapping):
            values = [f"{key}={text(item)}" for key, item in value.items()]
        elif isinstance(value, (list, tuple)):
            values = [_word(item) for item in value]
        else:
            values = [_word(value)]
        if self.positional:
            return values
        return [f"{self.name}={value}" for value in values]


def _word(value: object) -> str:
    return str(os.fspath(value)) if isinstance(value, os.PathLike) else text(value)


def _verdict(folder: str) -> dict[str, Any] | None:
    try:
        with open(os.path.join(folder, "verdict.json"), encoding="utf-8") as file:
            return dict(json.load(file))
    except (OSError, ValueError):
        return None


def _page(name: str, about: str, options: list[Option]) -> str:
    lines = [f"drycut {name}. {about}", ""]
    for option in options:
        default = f" (default: {option.default})" if option.default else ""
        lines.append(f"{option.argument}  {option.meaning}{default}")
    return "\n".join([*lines, "", "Gives a Ran: status, text, notes, verdict."])


def _made(name: str, about: str, options: list[Option]) -> Callable[..., Ran]:
    by_name = {option.argument: option for option in options}
    kinds = inspect.Parameter
    parameters = [kinds(option.argument, kinds.POSITIONAL_OR_KEYWORD if option.positional else kinds.KEYWORD_ONLY,
                        default=kinds.empty if option.required else None)
                  for option in sorted(options, key=lambda one: (not one.positional, not one.required))]
    signature = inspect.Signature(parameters)

    def verb(*args: object, **given: object) -> Ran:
        values = signature.bind(*args, **given).arguments
        words = [word for argument, value in values.items() for word in by_name[argument].words(value)]
        status, out, err = _core.command([name, *words])
        if status == INTERRUPTED:
            raise KeyboardInterrupt
        if status == 2:
            raise BadInput(err.strip())
        if status > 1:
            raise Diverged(err.strip())
        folder = values.get("out") or next((one.default for one in options if one.name == "--out"), "")
        return Ran(status, out, err, _verdict(_word(folder)) if folder else None)

    verb.__name__ = verb.__qualname__ = name
    verb.__doc__ = _page(name, about, options)
    verb.__signature__ = signature  # type: ignore[attr-defined]
    return verb


def made() -> dict[str, Callable[..., Ran]]:
    """A function a verb, by name."""
    return {name: _made(name, about, [Option(*option) for option in options])
            for name, about, options in _core.verbs()}
