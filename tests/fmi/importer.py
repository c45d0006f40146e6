"""FMUs as an importer sees them: loaded by ctypes, version 2.0 or 3.0."""
import ctypes as c
import subprocess
import xml.etree.ElementTree as xml
import zipfile
from pathlib import Path

OK, ERROR = 0, 3


def write_fmu(program, scenario, version, out, *more):
    """Has drycut write it, and unpacks it beside."""
    done = subprocess.run([program, "fmu", str(scenario), "--fmi", str(version), "--out", str(out), *more],
                          capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return unpack(out, Path(str(out)[:-4]))


def unpack(fmu, folder):
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return Folder(folder)


class Folder:
    """An unpacked FMU: its description and its library."""

    def __init__(self, folder):
        self.path = Path(folder).resolve()
        self.root = xml.parse(self.path / "modelDescription.xml").getroot()
        self.version = int(self.root.get("fmiVersion")[0])
        self.model = self.root.find("CoSimulation").get("modelIdentifier")
        self.token = self.root.get("guid" if self.version == 2 else "instantiationToken")
        self.binary = self.path / "binaries" / ("linux64" if self.version == 2 else "x86_64-linux") / f"{self.model}.so"
        self.variables = {}
        for element in self.root.find("ModelVariables"):
            typed = element[0] if self.version == 2 else element
            row = {**element.attrib, **typed.attrib, "type": typed.tag}
            if row["type"] == "String" and self.version == 3:
                row["start"] = element.find("Start").get("value")
            self.variables[row["name"]] = row

    def reference(self, name):
        return int(self.variables[name]["valueReference"])


LOG2 = c.CFUNCTYPE(None, c.c_void_p, c.c_char_p, c.c_int, c.c_char_p, c.c_char_p, c.c_char_p)
LOG3 = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p, c.c_char_p)


class Callbacks(c.Structure):
    _fields_ = [("logger", LOG2), ("allocate", c.c_void_p), ("free", c.c_void_p), ("finished", c.c_void_p),
                ("environment", c.c_void_p)]


class Instance:
    """An instance; `said` has what it logged, `status` what its last call came to."""

    def __init__(self, folder, token=None, resources=None, early=False):
        self.folder, self.said, self.status = folder, [], OK
        self.library = c.CDLL(str(folder.binary))
        token = (token or folder.token).encode()
        where = resources or (folder.path / "resources")
        if folder.version == 2:
            self.log = LOG2(lambda env, name, status, category, text, first: self.said.append(first.decode()))
            self.callbacks = Callbacks(self.log, None, None, None, None)
            make = self.library.fmi2Instantiate
            make.restype = c.c_void_p
            uri = where if isinstance(where, str) else where.as_uri()
            self.handle = make(b"machine", 1, token, uri.encode(), c.byref(self.callbacks), 0, 0)
        else:
            self.log = LOG3(lambda env, status, category, text: self.said.append(text.decode()))
            make = self.library.fmi3InstantiateCoSimulation
            make.restype = c.c_void_p
            self.handle = make(b"machine", token, (str(where) + "/").encode(), c.c_bool(False), c.c_bool(False),
                               c.c_bool(False), c.c_bool(early), None, c.c_size_t(0), None, self.log, None)

    def call(self, name, *arguments):
        function = getattr(self.library, f"fmi{self.folder.version}{name}")
        self.status = function(c.c_void_p(self.handle), *arguments)
        return self.status

    def initialise(self, start=0.0):
        none = c.c_double(0)
        if self.folder.version == 2:
            self.call("SetupExperiment", 0, none, c.c_double(start), 0, none)
            begun = self.call("EnterInitializationMode")
        else:
            begun = self.call("EnterInitializationMode", c.c_bool(False), none, c.c_double(start), c.c_bool(False), none)
        if begun == OK:
            self.call("ExitInitializationMode")
        return self.status

    # The function's name and the number's type by that of the variable.
    def access(self, name):
        kind = self.folder.variables[name]["type"]
        two = self.folder.version == 2
        types = {"Real": c.c_double, "Float64": c.c_double, "Integer": c.c_int, "Int32": c.c_int, "Int64": c.c_int64,
                 "Boolean": c.c_int if two else c.c_bool, "String": c.c_char_p}
        return kind, types[kind], (c.c_uint32 * 1)(self.folder.reference(name))

    def set(self, name, value):
        kind, ctype, vr = self.access(name)
        one = c.c_size_t(1)
        value = value.encode() if isinstance(value, str) else value
        return self.call(f"Set{kind}", vr, one, (ctype * 1)(value), one)

    def get(self, name):
        kind, ctype, vr = self.access(name)
        one, value = c.c_size_t(1), (ctype * 1)()
        self.call(f"Get{kind}", vr, one, value, one)
        return value[0].decode() if kind == "String" and value[0] else value[0]

    def step(self, at, size):
        if self.folder.version == 2:
            return self.call("DoStep", c.c_double(at), c.c_double(size), 1)
        self.event, self.end, self.early, self.reached = c.c_bool(), c.c_bool(), c.c_bool(), c.c_double()
        return self.call("DoStep", c.c_double(at), c.c_double(size), c.c_bool(True), c.byref(self.event), c.byref(self.end),
                         c.byref(self.early), c.byref(self.reached))

    def state_name(self, name):  # they are spelt otherwise in 2.0
        return name.replace("FMUState", "FMUstate").replace("Deserialize", "DeSerialize") if self.folder.version == 2 else name

    def save(self):
        """The state as bytes."""
        state, size = c.c_void_p(), c.c_size_t()
        assert self.call(self.state_name("GetFMUState"), c.byref(state)) == OK, self.said
        assert self.call(self.state_name("SerializedFMUStateSize"), state, c.byref(size)) == OK
        buffer = (c.c_uint8 * size.value)()
        assert self.call(self.state_name("SerializeFMUState"), state, buffer, size) == OK
        assert self.call(self.state_name("FreeFMUState"), c.byref(state)) == OK and state.value is None
        return bytes(buffer)

    def restore(self, kept):
        state = c.c_void_p()
        buffer = (c.c_uint8 * len(kept)).from_buffer_copy(kept)
        assert self.call(self.state_name("DeserializeFMUState"), buffer, c.c_size_t(len(kept)), c.byref(state)) == OK
        restored = self.call(self.state_name("SetFMUState"), state)
        self.call(self.state_name("FreeFMUState"), c.byref(state))
        self.status = restored
        return restored

    def free(self):
        free = getattr(self.library, f"fmi{self.folder.version}FreeInstance")
        free(c.c_void_p(self.handle))
        self.handle = None
