"""The client of a Dask cluster for `drycut --on dask://HOST:PORT`, which starts it and speaks with it in lines of
JSON on standard input and output:

    in   {"bundle": NAME, "bytes": BASE64}              what chunks of that name are asked with
         {"chunk": N, "bundle": NAME, "items": TEXT}    a chunk to run
    out  {"workers": N}                                 how many chunks can run at the same time
         {"chunk": N, "lines": [LINE, ...]}             what `drycut work` has written
         {"chunk": N, "lines": [...], "end": WHY}       and it has ended; WHY is "" if it has done all
         {"fatal": WHY}                                 it cannot go on

At the end of its input it cancels what runs, removes what lies at the workers and ends.
Dask decides where a chunk runs, and runs it again elsewhere when its worker is lost.
"""
import sys

try:
    from distributed import Client, get_worker
except ImportError:
    sys.exit(77)
import base64
import contextlib
import json
import logging
import os
import queue
import signal
import threading
import warnings

SECONDS = 5  # within which a scheduler answers


def keep(data):
    return data


def work(chunk, name, data, items, program, topic):
    """Runs at a worker: `drycut work` on one chunk. Its lines are sent as they come, and returned."""
    import contextlib
    import os
    import shutil
    import signal
    import subprocess
    import tempfile
    import time

    worker = get_worker()
    if not os.access(program, os.X_OK):
        program = shutil.which("drycut")
    if program is None:
        return ['{"refused": "there is no drycut at %s"}' % worker.address], "there is no drycut"
    if not hasattr(worker, "drycut"):
        worker.drycut = {}  # by topic: files and processes; None: it has been forgotten
    mine = worker.drycut.setdefault(topic, (set(), set()))
    forgotten = [], "the study has ended"
    if mine is None:
        return forgotten
    files, children = mine
    file = os.path.join(worker.local_directory, "drycut-" + name)
    if not os.path.exists(file):
        with tempfile.NamedTemporaryFile(dir=worker.local_directory, prefix="drycut-", delete=False) as part:
            part.write(data)
        os.replace(part.name, file)
    files.add(file)
    if worker.drycut[topic] is None:  # meanwhile, which did not see this file
        with contextlib.suppress(FileNotFoundError):
            os.remove(file)
        return forgotten
    with tempfile.TemporaryFile() as given, tempfile.TemporaryFile() as said:
        given.write(items.encode())
        given.seek(0)
        child = subprocess.Popen([program, "work", file], stdin=given, stdout=subprocess.PIPE, stderr=said, text=True)
        children.add(child)
        if worker.drycut[topic] is None:
            child.kill()
        lines, waiting, sent = [], [], 0.0
        for line in child.stdout:
            waiting.append(line.rstrip("\n"))
            if time.monotonic() - sent > 0.2:
                worker.log_event(topic, {"chunk": chunk, "at": len(lines), "lines": waiting})
                lines, waiting, sent = lines + waiting, [], time.monotonic()
        lines += waiting
        status = child.wait()
        children.discard(child)
        if '{"end":true}' in lines[-1:]:
            return lines, ""
        said.seek(0)
        last = said.read().decode(errors="replace").strip().splitlines()[-1:]
        how = f"signal {-status} ({signal.strsignal(-status)})" if status < 0 else f"status {status}"
        return lines, ": ".join([f"its process at {worker.address} ended with {how}"] + last)


def forget(topic, dask_worker):
    """Runs at every worker: nothing of this study is left."""
    import contextlib
    import os

    if not hasattr(dask_worker, "drycut"):
        dask_worker.drycut = {}
    files, children = dask_worker.drycut.get(topic) or ((), ())
    dask_worker.drycut[topic] = None
    for child in list(children):
        child.kill()
    for file in list(files):
        with contextlib.suppress(FileNotFoundError):
            os.remove(file)


def read_orders(orders):
    for line in sys.stdin:
        orders.put(json.loads(line))
    orders.put(None)


def say(**message):
    print(json.dumps(message), flush=True)


def main(address, program):
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    logging.getLogger("distributed").setLevel(logging.CRITICAL)
    warnings.simplefilter("ignore")
    try:
        client = Client(address.replace("dask://", "tcp://"), timeout=SECONDS, set_as_default=False)
    except (OSError, TimeoutError, ValueError):
        return say(fatal=f"no scheduler answers there within {SECONDS} s")

    def workers():
        return sum(worker["nthreads"] for worker in client.scheduler_info()["workers"].values())

    topic = f"drycut-{client.id}"
    orders = queue.Queue()
    bundles, running, told = {}, {}, {}
    lock = threading.Lock()
    client.subscribe_topic(topic, lambda event: orders.put({"told": event[1]}))
    count = workers()
    say(workers=count)
    if count == 0:
        print(f"drycut: {address} has no workers yet; waiting for one", file=sys.stderr, flush=True)
    threading.Thread(target=read_orders, args=(orders,), daemon=True).start()

    with contextlib.suppress(BrokenPipeError):  # whoever asked has been killed
        while True:
            try:
                order = orders.get(timeout=1)
            except queue.Empty:
                order = {}
                if client.status != "running":
                    say(fatal=f"the scheduler at {address} has gone")
                    break
            if order is None:
                break
            if workers() != count:
                count = workers()
                say(workers=count)
            if "bytes" in order:
                # A task rather than scattered data: when the worker that has it is lost, Dask makes it again.
                key = "drycut-bundle-" + order["bundle"]
                bundles[order["bundle"]] = client.submit(keep, base64.b64decode(order["bytes"]), key=key)
            elif "items" in order:
                chunk, name = order["chunk"], order["bundle"]
                future = client.submit(work, chunk, name, bundles[name], order["items"], program, topic,
                                       key=f"{topic}-{chunk}", pure=False)
                running[chunk] = future
                future.add_done_callback(lambda future, chunk=chunk: orders.put({"done": chunk}))
            elif "told" in order:
                chunk, at, lines = (order["told"][key] for key in ("chunk", "at", "lines"))
                if chunk in running:
                    told[chunk] = at + len(lines)  # from 0 again where Dask has started it elsewhere
                    say(chunk=chunk, lines=lines)
            elif "done" in order:
                chunk = order["done"]
                future = running.pop(chunk, None)
                if future is None:
                    continue
                if future.status == "finished":
                    lines, why = future.result()
                    say(chunk=chunk, lines=lines[told.pop(chunk, 0):], end=why)
                elif client.status != "running":
                    say(fatal=f"the scheduler at {address} has gone")
                    break
                elif future.status == "cancelled":
                    say(chunk=chunk, lines=[], end="Dask cancelled it")
                else:
                    error = future.exception()
                    say(chunk=chunk, lines=[], end=f"{type(error).__name__}: {str(error).splitlines()[0]}")
                future.release()

    futures = list(running.values()) + list(bundles.values())
    for farewell in (lambda: client.cancel(futures), lambda: client.run(forget, topic),
                     lambda: client.unsubscribe_topic(topic), lambda: client.close(timeout=SECONDS)):
        try:
            farewell()
        except Exception:  # whoever has gone needs no clearing up
            pass
    os._exit(0)


main(*sys.argv[1:])
