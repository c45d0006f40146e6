"""Every notebook of docs/notebooks runs from a fresh kernel, and says what is stored in it. Exit status 77: skipped.

    test_notebooks.py [NAME...]  runs them, or those of these names, and compares
    test_notebooks.py --store    stores what they say now
"""

import glob
import math
import os
import re
import sys

try:
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
    from jupyter_client.kernelspec import NATIVE_KERNEL_NAME, KernelSpecManager, NoSuchKernel

    KernelSpecManager().get_kernel_spec(NATIVE_KERNEL_NAME)
except ImportError as missing:
    print(f"skipped: {missing}; install python3-nbconvert, python3-ipykernel and python3-matplotlib")
    sys.exit(77)
except NoSuchKernel as missing:
    print(f"skipped: {missing}; install python3-ipykernel")
    sys.exit(77)

SOURCE = os.environ.get("DRYCUT_SOURCE_DIR", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
LARGEST = 500_000  # bytes of a notebook with its pictures
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
TOLERANCE = 1e-6  # of a number; what stands after the comma is all that can differ


def executed(path):
    """The notebook at `path`, run in its folder by the kernel of this Python."""
    book = nbformat.read(path, as_version=4)
    for cell in book.cells:
        if cell.cell_type == "code":
            cell.outputs, cell.execution_count = [], None
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    nbclient.NotebookClient(book, timeout=600, resources={"metadata": {"path": os.path.dirname(path)}}).execute()
    for cell in book.cells:  # when it ran is not its content
        cell.metadata.pop("execution", None)
    book.metadata.get("language_info", {}).pop("version", None)
    return book


def shown(cell):
    """What a cell shows: its texts in one, and the kinds of its pictures."""
    text, pictures = "", []
    for output in cell.get("outputs", ()):
        if output.output_type == "stream" and output.name == "stderr":
            text += "stderr: "  # a warning does not belong in a notebook
        text += output.get("text", "") or output.get("data", {}).get("text/plain", "") + "\n"
        pictures += [kind for kind in output.get("data", {}) if kind.startswith("image/")]
    return text, pictures


def difference(stored, fresh):
    """In words, "" if there is none. Words must be equal, numbers agree."""
    if NUMBER.sub("#", stored) != NUMBER.sub("#", fresh):
        return f"stored:\n{stored}\nnow:\n{fresh}"
    for was, now in zip(NUMBER.findall(stored), NUMBER.findall(fresh)):
        if not math.isclose(float(was), float(now), rel_tol=TOLERANCE):
            return f"stored {was}, now {now} in\n{fresh}"
    return ""


def faults(path):
    stored = nbformat.read(path, as_version=4)
    fresh = executed(path)
    if os.path.getsize(path) > LARGEST:
        yield f"has {os.path.getsize(path)} bytes, {LARGEST} at most"
    for number, (was, now) in enumerate(zip(stored.cells, fresh.cells)):
        (old_text, old_pictures), (text, pictures) = shown(was), shown(now)
        if "stderr: " in old_text:
            yield f"cell {number}: a warning is stored: {old_text}"
        if old_pictures != pictures:
            yield f"cell {number}: pictures stored {old_pictures}, now {pictures}"
        if told := difference(old_text, text):
            yield f"cell {number}: {told}"


def main():
    books = sorted(glob.glob(os.path.join(SOURCE, "docs", "notebooks", "*.ipynb")))
    names = [name for name in sys.argv[1:] if name != "--store"]
    if names:
        books = [os.path.join(SOURCE, "docs", "notebooks", name + ".ipynb") for name in names]
    bad = not books
    for path in books:
        if "--store" in sys.argv:
            nbformat.write(executed(path), path)
            continue
        for fault in faults(path):
            bad = True
            print(f"{os.path.relpath(path, SOURCE)}: {fault}")
    if bad and books:
        print("look at the notebook; `make notebooks` stores what it says now")
    sys.exit(bad)


main()
