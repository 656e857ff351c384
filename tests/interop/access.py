"""What axe finds on a page, where npm can install it."""

import pathlib
import shutil
import subprocess

from compare import same

FOLDER = pathlib.Path(__file__).parents[2] / "target/tmp/axe"


def is_accessible(browser):
    """No findings."""
    script = FOLDER / "node_modules/axe-core/axe.min.js"
    if not script.exists() and shutil.which("npm"):
        subprocess.run(["npm", "install", "--silent", "--prefix", FOLDER, "axe-core@4.10.3"], capture_output=True)
    if not script.exists():
        return
    browser.evaluate(script.read_text())
    found = browser.evaluate("""axe.run().then(({violations}) => violations
        .map(({id, nodes}) => id + ': ' + nodes.map(({html}) => html.slice(0, 160)).join(' | ')))""")
    same("findings", found, [])
