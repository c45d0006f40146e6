"""The verbs of the command line: made of the program's own table."""

from __future__ import annotations

import inspect
import json
import keyword
import os
from dataclasses import dataclass, field
from types import SimpleNamespace
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


def _name(word: str) -> str:
    name = word.replace("-", "_")
    return name + "_" if keyword.iskeyword(name) else name


def _word(value: object) -> str:
    return str(os.fspath(value)) if isinstance(value, os.PathLike) else text(value)


def _written(file: str) -> tuple[int, int]:
    """Differs from what it was before where the file was written since then."""
    try:
        found = os.stat(file)
        return found.st_ino, found.st_mtime_ns
    except OSError:
        return 0, 0


def _verdict(file: str) -> dict[str, Any] | None:
    try:
        with open(file, encoding="utf-8") as stream:
            return dict(json.load(stream))
    except (OSError, ValueError):
        return None


def _arguments(options: list[Option]) -> dict[str, Option]:
    """As Python calls them: "--max-travel" is max_travel, "--from" from_, "--table" beside TABLE table_."""
    arguments: dict[str, Option] = {}
    for option in sorted(options, key=lambda one: (not one.positional, not one.required)):
        name = _name(option.name.lstrip("-"))
        arguments[name + "_" if name in arguments else name] = option
    return arguments


def _page(name: str, about: str, arguments: dict[str, Option]) -> str:
    lines = [f"drycut {name}. {about}", ""]
    for argument, option in arguments.items():
        default = f" (default: {option.default})" if option.default else ""
        lines.append(f"{argument}  {option.meaning}{default}")
    return "\n".join([*lines, "", "Gives a Ran: status, text, notes, verdict."])


def _made(name: str, about: str, options: list[Option]) -> Callable[..., Ran]:
    arguments = _arguments(options)
    kinds = inspect.Parameter
    parameters = [kinds(argument, kinds.POSITIONAL_OR_KEYWORD if option.positional else kinds.KEYWORD_ONLY,
                        default=kinds.empty if option.required else None)
                  for argument, option in arguments.items()]
    signature = inspect.Signature(parameters)

    def verb(*args: object, **given: object) -> Ran:
        values = signature.bind(*args, **given).arguments
        words = [word for argument, value in values.items() for word in arguments[argument].words(value)]
        folder = values.get("out") or next((one.default for one in options if one.name == "--out"), "")
        file = os.path.join(_word(folder), "verdict.json")
        before = _written(file)
        status, out, err = _core.command([name, *words])
        if status == INTERRUPTED:
            raise KeyboardInterrupt
        if status == 2:
            raise BadInput(err.strip())
        if status > 1:
            raise Diverged(err.strip())
        return Ran(status, out, err, _verdict(file) if _written(file) != before else None)

    verb.__name__ = verb.__qualname__ = name
    verb.__doc__ = _page(name, about, arguments)
    verb.__signature__ = signature  # type: ignore[attr-defined]
    return verb


#: A function a verb, by its name.
verbs = SimpleNamespace(**{_name(name): _made(name, about, [Option(*option) for option in options])
                           for name, about, options in _core.verbs()})
