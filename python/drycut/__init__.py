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
    line.read("knife.motor.speed"), line.unit("knife.motor.speed")

run         a scenario from its beginning to its end, with its trace
Simulation  the same step by step: read and write by name while it runs
cam         a cam table judged and sampled without a machine
bode        the frequency response of a position loop, with its margins
tune        values with the least metric that keep all limits
sweep       a scenario at every point of a grid or a sample
envelope    the largest value at which everything holds, at every point of a grid
fit         values of a machine from recordings of the real one
read_recording  such a recording, as numpy arrays

Every other verb of the command line has a function of its name, with the options as arguments (--max-travel is
max_travel, --from from_; a flag is True, what may be repeated a list, `set` a dict): drycut.size(), drycut.compare(),
drycut.check() and so on (import is import_); help(drycut.size) says what it takes. It gives a Ran: status, text, verdict. `verbs` has
all of them likewise: drycut.verbs.run(["a.yaml", "b.yaml"], jobs=2).

Overrides (`set`) are those of the command line's --set: a path in the scenario and a value with its unit as
text, or a number. What does not fit raises BadInput, whose `problems` tell file, line and column, or the argument.
Long calls let other threads run: two simulations in two threads take two cores. Ctrl-C ends them.
"""

from typing import TYPE_CHECKING, Callable

from ._cams import Cam, Finding, cam
from ._core import version as __version__
from ._fits import Channel, Fit, FitValue, Recording, Replay, fit, read_recording
from ._loops import Bode, Margin, bode
from ._problems import BadInput, Diverged, Problem
from ._runs import Check, Covered, Event, Run, Simulation, run
from ._studies import Sweep, Tuning, envelope, sweep, tune
from ._verbs import Ran
from ._verbs import verbs as verbs

__all__ = ["BadInput", "Bode", "Cam", "Channel", "Check", "Covered", "Diverged", "Event", "Finding", "Fit", "FitValue", "Margin",
           "Problem", "Ran", "Recording", "Replay", "Run", "Simulation", "Sweep", "Tuning", "bode", "cam", "envelope",
           "fit", "read_recording", "run", "sweep", "tune"]

if TYPE_CHECKING:
    def __getattr__(name: str) -> Callable[..., Ran]: ...

for _name, _verb in vars(verbs).items():
    if _name not in globals():
        globals()[_name] = _verb
        __all__.append(_name)

# They are of this package, whichever of its files they stand in.
for _name in __all__:
    globals()[_name].__module__ = __name__
