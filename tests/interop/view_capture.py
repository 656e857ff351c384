"""A capture in a headless Chromium: its timeline, and how it goes on live with a changed property and a changed script."""

import pathlib
import subprocess
import sys
import tempfile

from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import Simulator

SCENE = pathlib.Path(__file__).parent / "view_capture.lua"
BALL = "[...swanilda.store.objects.values()].find(object => object.alias == 'ball')"
FRAME = "swanilda.store.scene.frame"
BUTTON = "document.querySelector('#bar button[aria-label=\"{}\"]')"
GO_ON = "document.querySelector('#bar .go-on')"
LINES = "[...document.querySelectorAll('.console-lines .text')].map(text => text.textContent)"


def key(browser, name):
    browser.evaluate(f"document.body.dispatchEvent(new KeyboardEvent('keydown', {{key: '{name}', bubbles: true}}))")


def at(browser, frame):
    """What the page shows at a frame."""
    browser.shows(f"{FRAME} === {frame}", f"frame {frame}")
    browser.shows("!swanilda.store.dirty.size", "a picture")
    return browser.evaluate(f"[swanilda.store.poses.get({BALL}.handle)[0], document.querySelector('.time-now').textContent, {LINES}]")


def moments_come_back(browser):
    slider = "swanilda.bar.timeline.slider"
    last = browser.evaluate("swanilda.store.timeline.frames - 1")
    shown = []
    for frame in (10, 4):
        browser.evaluate(f"{slider}.value = {frame}, {slider}.dispatchEvent(new Event('input'))")
        shown.append(at(browser, frame))
    same("the ball came back", shown[0][0] > shown[1][0], True)
    same("the console as well", len(shown[0][2]) - len(shown[1][2]), 6)
    key(browser, ",")
    before = at(browser, 3)
    browser.evaluate(BUTTON.format("One step (.)") + ".click()")
    same("a step back and one ahead", (at(browser, 4), before[0] < shown[1][0]), (shown[1], True))
    same("what screen readers say", browser.evaluate(f"[{slider}.ariaLabel, {slider}.getAttribute('aria-valuetext')]"), ["Moment of the capture", "0.20 seconds"])
    browser.evaluate(f"swanilda.source.track.seek({last})")
    at(browser, last)
    same("the end is said", browser.evaluate("document.querySelector('#bar .state').textContent"), "The capture ends here.")


def marks_are_gone_to(browser):
    key(browser, "p")
    browser.shows(f"{LINES}.at(-1).includes('too far')", "the error")
    same("the script has it", browser.evaluate("[...swanilda.store.objects.values()].filter(object => object.error).length"), 1)
    key(browser, "p")
    browser.shows("document.querySelector('.time-now').textContent === '0.550 s'", "the message")
    same("no error yet", browser.evaluate("[...swanilda.store.objects.values()].filter(object => object.error).length"), 0)


def nothing_is_changed(browser):
    refused = browser.evaluate("swanilda.source.request('run', {code: '1'}).catch(error => error.message)")
    same("code", refused, "this is a capture: go on from here first")
    same("the line for Lua", browser.evaluate("document.querySelector('.console-input input').disabled"), True)
    browser.evaluate(f"swanilda.select({BALL}.handle, false)")
    browser.shows("document.querySelector('[data-name=alias] output')?.textContent.includes('ball')", "the properties to read")


def goes_on(browser):
    x = browser.evaluate(f"swanilda.store.poses.get({BALL}.handle)[0]")
    browser.evaluate(f"{GO_ON}.click()")
    browser.shows("swanilda.store.scene.mode === 'live' && !swanilda.store.dirty.size", "the simulation")
    same("no timeline", browser.evaluate(f"[swanilda.bar.timeline.slider.checkVisibility(), {GO_ON}.checkVisibility(), document.querySelector('#bar .state').textContent]"), [False, False, "paused"])
    same("the same moment", browser.evaluate(f"swanilda.store.poses.get({BALL}.handle)[0]"), x)
    same("its lines", browser.evaluate(f"{LINES}.filter(line => line.includes('step at')).length"), 11)
    browser.shows("document.querySelector('[data-name=\"customData.speed\"] input') != null", "the properties to write")
    browser.evaluate("""(() => { const input = document.querySelector('[data-name="customData.speed"] input'); input.value = -1; input.dispatchEvent(new Event('change')) })()""")
    browser.evaluate(BUTTON.format("One step (.)") + ".click()")
    browser.shows(f"swanilda.store.poses.get({BALL}.handle)[0] < -0.4", "the other way")


def the_script_is_changed(browser):
    browser.evaluate("swanilda.openScriptOf([...swanilda.store.objects.values()].find(object => object.objectType === 'script').handle)")
    browser.shows("document.querySelector('#script .code-line') != null", "the script")
    browser.evaluate("document.querySelector('#script [aria-label=\"Change the text\"]').click()")
    browser.shows("swanilda.script.editing.editor != null", "the editor")
    same("its text", browser.evaluate("swanilda.script.editing.draft.text.includes('too far')"), True)
    browser.evaluate("swanilda.script.editing.editor.setText(\"print('another')\\nfunction sysCall_init() end\")")
    browser.evaluate("swanilda.script.editing.saveButton.click()")
    browser.shows(f"{LINES}.includes('another')", "the new script")
    browser.shows("swanilda.script.editing.closeButton.textContent == 'Close'", "nothing to save")
    browser.evaluate("swanilda.script.editing.closeButton.click()")
    browser.shows("document.querySelector('#script .code-line').textContent.includes('another')", "its text")


with tempfile.TemporaryDirectory() as folder:
    capture = str(pathlib.Path(folder, "run.swc"))
    subprocess.run([sys.argv[1], "run", "--quiet", "--time", "2", "--capture", capture, SCENE], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with Simulator("--no-open", capture, command="view") as sim, Browser(program(), WITH_WEBGL) as browser:
        browser.command("Runtime.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1100, height=700, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows(f"globalThis.swanilda?.store.timeline?.complete && {BALL} != null", "the timeline")
        moments_come_back(browser)
        marks_are_gone_to(browser)
        nothing_is_changed(browser)
        goes_on(browser)
        the_script_is_changed(browser)
        same("no errors", [e["params"] for e in browser.events if e.get("method") == "Runtime.exceptionThrown"], [])
