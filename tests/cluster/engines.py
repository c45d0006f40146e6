"""A Dask cluster and a Slurm cluster on this machine, as processes on loopback, for tests and for trying things out:

    engines.py dask|slurm [ARGUMENT...]     starts one, runs the arguments as a command, ends it; the command finds
                                            the address in $DRYCUT_ON and, of Slurm, its configuration in $SLURM_CONF
"""
import contextlib
import os
import resource
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PATIENCE = 60  # seconds for a process to come up
PYTHON = next((p for p in ("python3", "/usr/bin/python3") if shutil.which(p) and
               subprocess.run([p, "-c", "import distributed"], capture_output=True).returncode == 0), None)


def wait_for(condition, what, patience=PATIENCE):
    """The value of `condition()` as soon as it is true."""
    end = time.monotonic() + patience
    while time.monotonic() < end:
        value = condition()
        if value:
            return value
        time.sleep(0.02)  # between two looks
    raise TimeoutError(what)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def listens(port):
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


class Processes:
    """Child processes, each in a group of its own, that end with us."""

    def __init__(self, folder):
        self.folder = folder
        self.children = []

    def start(self, *words, cpu_seconds=None, **more):
        def limit():
            if cpu_seconds:  # of each process that it starts
                resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, resource.RLIM_INFINITY))

        with open(os.path.join(self.folder, f"{len(self.children)}.log"), "w") as log:
            child = subprocess.Popen(words, stdout=log, stderr=log, stdin=subprocess.DEVNULL, start_new_session=True,
                                     preexec_fn=limit, **more)
        self.children.append(child)
        return child

    def stop(self):
        for child in reversed(self.children):
            with contextlib.suppress(ProcessLookupError):
                os.killpg(child.pid, signal.SIGTERM)
        for child in self.children:
            try:
                child.wait(10)
            except subprocess.TimeoutExpired:
                os.killpg(child.pid, signal.SIGKILL)
                child.wait()

    def said(self):
        texts = []
        for name in sorted(os.listdir(self.folder)):
            if name.endswith(".log"):
                with open(os.path.join(self.folder, name)) as file:
                    texts.append(file.read())
        return "\n".join(texts)


class Dask:
    """A scheduler and workers of one thread."""
    missing = "" if PYTHON else "python3-distributed"

    def __init__(self, workers=2, cpu_seconds=None):
        self.folder = tempfile.mkdtemp()
        self.processes = Processes(self.folder)
        self.port = free_port()
        self.address = f"dask://127.0.0.1:{self.port}"
        self.cpu_seconds = cpu_seconds
        self.cli = "distributed.cli.dask_"
        self.processes.start(PYTHON, "-m", self.cli + "scheduler", "--host", "127.0.0.1", "--port", str(self.port),
                             "--no-dashboard", "--no-show", cwd=self.folder)
        wait_for(lambda: listens(self.port), "the scheduler")
        self.workers = [self.add_worker() for _ in range(workers)]
        wait_for(lambda: self.processes.said().count("Registered to") >= workers, "the workers")

    def add_worker(self):
        """A worker in a folder of its own; a limit of processor time is its children's."""
        folder = tempfile.mkdtemp(dir=self.folder)
        child = self.processes.start(PYTHON, "-m", self.cli + "worker", f"tcp://127.0.0.1:{self.port}", "--nthreads",
                                     "1", "--no-dashboard", "--no-nanny", "--host", "127.0.0.1",
                                     "--local-directory", folder, "--preload",
                                     "import signal; signal.signal(signal.SIGXCPU, lambda *_: None)",
                                     cwd=folder, cpu_seconds=self.cpu_seconds)
        child.folder = folder
        return child

    def left_behind(self):
        """Files of ours at the workers."""
        return [os.path.join(where, name) for where, _, names in os.walk(self.folder) for name in names
                if name.startswith("drycut-")]

    def environment(self):
        return {"DRYCUT_ON": self.address}

    def stop(self):
        self.processes.stop()
        shutil.rmtree(self.folder, ignore_errors=True)


SLURM_CONF = """
ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ctld_port}
SlurmdPort={slurmd_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/builtin
SchedulerParameters=batch_sched_delay=0,sched_min_interval=50000,defer
PropagateResourceLimits=CPU
MpiDefault=none
SwitchType=switch/none
ReturnToService=2
KillWait=2
MinJobAge=60
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP
PartitionName=closed Nodes={host} Default=NO MaxTime=INFINITE State=DOWN
"""


class Slurm:
    """munged, slurmctld and a slurmd with two processors, as root."""
    missing = ("" if all(shutil.which(p) for p in ("munged", "slurmctld", "slurmd", "sbatch"))
               else "slurm-wlm and munge") or ("" if os.getuid() == 0 else "to be root")

    def __init__(self, **_):  # limits are those of whoever submits
        self.folder = tempfile.mkdtemp()
        os.chmod(self.folder, 0o755)
        self.processes = Processes(self.folder)
        for name in ("state", "spool"):
            os.mkdir(os.path.join(self.folder, name))
        key = os.path.join(self.folder, "munge.key")
        with open(os.open(key, os.O_CREAT | os.O_WRONLY, 0o600), "wb") as file:
            file.write(os.urandom(128))
        self.conf = os.path.join(self.folder, "slurm.conf")
        host = socket.gethostname().split(".")[0]
        with open(self.conf, "w") as file:
            file.write(SLURM_CONF.format(host=host, folder=self.folder, ctld_port=free_port(),
                                         slurmd_port=free_port()))
        self.socket = os.path.join(self.folder, "munge.socket")
        self.processes.start("munged", "--foreground", "--force", "--key-file", key, "--socket", self.socket,
                             "--pid-file", os.path.join(self.folder, "munge.pid"), "--log-file",
                             os.path.join(self.folder, "munge.log"), "--seed-file",
                             os.path.join(self.folder, "munge.seed"))
        wait_for(lambda: os.path.exists(self.socket), "munged")
        self.address = "slurm"
        environment = {**os.environ, **self.environment()}
        self.processes.start("slurmctld", "-D", "-f", self.conf, env=environment)
        self.processes.start("slurmd", "-D", "-f", self.conf, "-N", host, env=environment)
        wait_for(lambda: "idle" in self.ask("sinfo", "--noheader", "--partition=main", "--format=%t"), "slurmd")

    def environment(self):
        return {"SLURM_CONF": self.conf}

    def ask(self, *words):
        return subprocess.run(words, env={**os.environ, **self.environment()}, capture_output=True, text=True).stdout

    def queue(self):
        return self.ask("squeue", "--noheader", "--array")

    def stop(self):
        self.ask("scancel", "--user=root")
        self.processes.stop()
        shutil.rmtree(self.folder, ignore_errors=True)


def main(kind, *command):
    engine = {"dask": Dask, "slurm": Slurm}[kind]
    if engine.missing:
        sys.exit(f"{kind} needs {engine.missing}")
    running = engine()
    try:
        environment = {**os.environ, **running.environment(), "DRYCUT_ON": running.address}
        return subprocess.run(command or [os.environ.get("SHELL", "sh")], env=environment).returncode
    finally:
        running.stop()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
