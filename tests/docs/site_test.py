#!/usr/bin/env python3
"""site_test.py SITE whole|search|looks: the site of docs/, which this builds in the folder SITE.

whole   it is built without a warning; no dead link, anchor or picture without a text; nothing is asked for from elsewhere
search  what a reader types finds its page, from a file as well as from a server (headless Chromium, no server here)
looks   on a desk and a phone, light and dark: contrast, names for screen readers, nothing wider than the window; the switch between
        light and dark"""
import html.parser
import json
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse
from pathlib import Path

from pages import DOCS, ROOT

SITE = Path(sys.argv[1]).resolve()
SKIPPED = 77
LOOKED_AT = ["index", "first_line", "camming4_codes", "glossary", "plcopen", "scenarios", "architecture", "reference/CAMMING4",
             "reference/commands"]
FOUND_BY = {"softening": "camming4_codes.html", "rowex": "glossary.html", "splice": "print_marks.html",
            "ARRSYS": "reference/CNF.html", "D8140": "reference/LX3VP.html"}


def build():
    """What Sphinx has to say against it."""
    shutil.rmtree(SITE, ignore_errors=True)  # pages that are gone
    done = subprocess.run(["/usr/bin/sphinx-build", "-q", "-W", "--keep-going", "-b", "html", "-d", SITE / ".doctrees", DOCS, SITE],
                          capture_output=True, text=True)
    return [line for line in done.stderr.splitlines() if line.strip()] or (["sphinx-build failed"] if done.returncode else [])


class Reader(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.ids, self.links, self.asked, self.pictures = set(), [], [], []
        self.feed(text)

    def handle_starttag(self, tag, pairs):
        has = dict(pairs)
        self.ids |= {has[key] for key in ("id", "name") if has.get(key)}
        if tag == "a" and has.get("href"):
            self.links.append(has["href"])
        if tag == "img":
            self.pictures.append((has.get("src", ""), has.get("alt")))
        if tag in ("script", "img", "source", "iframe") and has.get("src"):
            self.asked.append(has["src"])
        if tag == "link" and has.get("rel") not in ("canonical",) and has.get("href"):
            self.asked.append(has["href"])


def whole():
    wrong = build()
    read = {page: Reader(page.read_text()) for page in SITE.rglob("*.html")}
    for page, one in read.items():
        name = page.relative_to(SITE)
        for link in one.links + one.asked:
            url = urllib.parse.urlparse(link)
            if url.scheme or url.netloc:
                if link in one.asked and url.scheme != "data":
                    wrong.append(f"{name}: asks for {link}")
                continue
            target = (page.parent / urllib.parse.unquote(url.path)).resolve() if url.path else page
            if not target.exists():
                wrong.append(f"{name}: dead link {link}")
            elif url.fragment and target in read and urllib.parse.unquote(url.fragment) not in read[target].ids:
                wrong.append(f"{name}: dead anchor {link}")
        wrong += [f"{name}: no text for {source}" for source, text in one.pictures if not (text or "").strip()]
    for style in SITE.rglob("*.css"):
        wrong += [f"{style.name}: asks for {url}" for url in re.findall(r"url\(['\"]?(https?:[^)'\"]+)", style.read_text())]
    if len(read) < 90:
        wrong.append(f"only {len(read)} pages")
    return wrong


HARNESS = """<!doctype html><html lang="en"><title>.</title><body><iframe id="page"></iframe><script>
const page = document.getElementById("page"), found = [], pause = ms => new Promise(done => setTimeout(done, ms));
const open = url => new Promise(done => { page.onload = done; page.src = url; });
const until = async condition => { for (let i = 0; i < 200 && !condition(); ++i) await pause(20); };
(async () => {
  try { %s } catch (error) { found.push("script: " + error.stack); }
  document.body.innerHTML = "<pre id=done></pre>";
  document.getElementById("done").textContent = JSON.stringify(found);
})();
</script></body></html>"""


def in_browser(script):
    """What the script found, run in Chromium beside the site's pages."""
    with tempfile.TemporaryDirectory() as home:
        harness = Path(home) / "harness.html"
        harness.write_text(HARNESS % script)
        done = subprocess.run(["chromium", "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--no-first-run",
                               "--allow-file-access-from-files", "--window-size=1400,1000", f"--user-data-dir={home}/profile",
                               "--virtual-time-budget=120000", "--dump-dom", harness.as_uri()], capture_output=True, text=True, timeout=1200)
    answer = re.search(r'<pre id="done">(.*?)</pre>', done.stdout, re.DOTALL)
    return json.loads(html.unescape(answer[1])) if answer else ["no answer: " + done.stderr[-500:]]


def search():
    return in_browser("""
  page.width = 1280; page.height = 900;
  for (const [word, wanted] of Object.entries(%s)) {
    await open(%s);
    const field = page.contentDocument.querySelector("input[name=q]");
    field.value = word;
    const opened = new Promise(done => page.onload = done);
    field.form.submit();
    await opened;
    const links = () => [...page.contentDocument.querySelectorAll("#search-results li a")].map(a => a.getAttribute("href"));
    await until(() => links().some(href => href.split(/[?#]/)[0] === wanted));
    if (!links().some(href => href.split(/[?#]/)[0] === wanted))
      found.push(word + " does not find " + wanted + " but " + links());
  }""" % (json.dumps(FOUND_BY), json.dumps((SITE / "index.html").as_uri())))


def looks():
    header = (ROOT / "tests/scenes/page_checks.hpp").read_text()
    checks = [re.search(name + r' = R"js\((.*?)\)js"', header, re.DOTALL)[1] for name in ("kFaintText", "kNameless")]
    return in_browser("""
  await open(%s);
  const first = page.contentDocument;
  for (const wanted of ["dark", "light", "auto"]) {
    first.querySelector(".theme-toggle").click();
    if (first.body.dataset.theme !== wanted) found.push("the switch gives " + first.body.dataset.theme + ", not " + wanted);
  }
  for (const [width, height] of [[1280, 900], [390, 844]])
    for (const theme of ["light", "dark"])
      for (const url of %s) {
        page.width = width; page.height = height;
        await open(url);
        const inside = page.contentWindow, where = url.split("/").pop() + " " + width + " " + theme + ": ";
        inside.document.body.dataset.theme = theme;
        await pause(300);
        for (const check of %s) for (const what of inside.eval(check)) found.push(where + what);
        const whole = inside.document.documentElement;
        if (whole.scrollWidth > whole.clientWidth) found.push(where + "wider than the window by " + (whole.scrollWidth - whole.clientWidth));
      }""" % (json.dumps((SITE / "index.html").as_uri()), json.dumps([(SITE / f"{name}.html").as_uri() for name in LOOKED_AT]), json.dumps(checks)))


def main():
    kind = sys.argv[2]
    for needed in ["/usr/bin/sphinx-build"] + (["chromium"] if kind != "whole" else []):
        if not shutil.which(needed):
            print(f"skipped without {Path(needed).name}: make docs installs Sphinx")
            return SKIPPED
    if subprocess.run(["/usr/bin/python3", "-c", "import furo, myst_parser"], capture_output=True).returncode:
        print("skipped without furo and python3-myst-parser: make docs")
        return SKIPPED
    if kind == "looks" and not (ROOT / "tests/scenes/page_checks.hpp").exists():
        print("skipped without tests/scenes/page_checks.hpp")
        return SKIPPED
    if kind != "whole" and not (SITE / "index.html").exists():
        build()
    wrong = {"whole": whole, "search": search, "looks": looks}[kind]()
    print("\n".join(wrong[:60]) or "nothing to complain of")
    return 1 if wrong else 0


sys.exit(main())
