"""A recording as one HTML file, opened from the disk in a headless Chromium."""

import tempfile

import recordings
from browser import Browser, program
from compare import same

with tempfile.TemporaryDirectory() as folder, Browser(program()) as browser:
    browser.command("Runtime.enable")
    page = recordings.exported(folder, "--html", "a.html")
    browser.open(page.as_uri())
    browser.shows("globalThis.swanilda?.source?.complete", "the whole recording")
    same("no errors", [e["params"] for e in browser.events if e.get("method") == "Runtime.exceptionThrown"], [])
    same("the scene", browser.evaluate("swanilda.store.scene.name"), "recordings_scene.lua")
    browser.shows("document.getElementById('tree-pane').textContent.includes('Ball')", "the tree")
    browser.evaluate("swanilda.source.seek(1.2)")
    browser.shows("Math.abs(swanilda.store.scene.time - 1.2) < 0.06", "the time")
    browser.evaluate("swanilda.source.seek(0.4)")
    browser.shows("Math.abs(swanilda.store.scene.time - 0.4) < 0.06", "the time before")
    same("the marks", browser.evaluate("swanilda.source.index.marks.some(mark => mark.kind === 'error')"), True)
    browser.evaluate("swanilda.source.seek(swanilda.source.end_time)")
    browser.shows("document.getElementById('console').textContent.includes('oh')", "the console")
