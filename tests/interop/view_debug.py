"""Breakpoints in the viewer's page: mouse and keys in a headless Chromium, beside a page that only looks on.

The first run is captured and played again: breakpoints change nothing of a run.
"""

import json
import pathlib
import sys

from websockets.sync.client import connect

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import CODES, MODIFIERS, click, found, key, middle, press, with_text
from simulator import Simulator

SCENE = str(pathlib.Path(__file__).with_name("view_debug.lua"))
SCRIPT = "[...swanilda.store.objects.values()].find(object => object.objectType == 'script')"
STOP = "swanilda.store.stopped?.line"
MARKED = "document.querySelector('#script .code-line.stopped')?.dataset.line"
VARIABLES = "Object.fromEntries([...document.querySelectorAll('.debug-variables .variable')].map(row => [row.querySelector('.variable-name').textContent, row.querySelector('.variable-value')?.textContent]))"
TEXT = "swanilda.script.editing.draft?.text"
CODES.update({"F8": ("F8", 119), "F9": ("F9", 120), "F10": ("F10", 121), "F11": ("F11", 122), "Home": ("Home", 36), "End": ("End", 35)})


class Other:
    """A page that no browser shows."""

    def __init__(self, address):
        self.socket = connect(address.replace("http", "ws", 1) + "stream", origin=address.rsplit("/", 2)[0], max_size=None)
        self.seen = {}
        self.count = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.socket.close()

    def _next(self):
        message = self.socket.recv(20)
        if isinstance(message, bytes):
            return {}
        message = json.loads(message)
        self.seen.update({name: message[name] for name in ("stopped", "scene") if name in message})
        return message

    def ask(self, do, **members):
        self.count += 1
        self.socket.send(json.dumps({"id": self.count, "do": do, **members}))
        while (message := self._next()).get("type") != "reply" or message["id"] != self.count:
            pass
        return message.get("result", message.get("error"))

    def sees(self, line):
        while (self.seen.get("stopped") or {}).get("line") != line:
            self._next()


def opened(sim):
    browser = Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL)
    for domain in ("Page", "Runtime", "Log"):
        browser.command(f"{domain}.enable")
    browser.command("Emulation.setDeviceMetricsOverride", width=1300, height=800, deviceScaleFactor=1, mobile=False)
    browser.open(sim.address)
    browser.shows(f"globalThis.swanilda?.store.objects.size && {SCRIPT} && swanilda.store.scene.debugger", "the script")
    browser.evaluate(f"swanilda.openScript({SCRIPT}.handle)")
    browser.shows("document.querySelectorAll('#script .code-line').length > 5", "the text")
    return browser


def stops_at(browser, line):
    browser.shows(f"{STOP} == {line} && {MARKED} == {line}", f"a stop in line {line}")


def presses_number(browser, line):
    """A click on the number of a line that is read."""
    click(browser, middle(browser, f"document.querySelector('#script .code-line:nth-child({line}) .line-number')"))


def has_breakpoints(browser, *lines):
    browser.shows(f"JSON.stringify(swanilda.store.breakpoints.flatMap(script => script.lines.map(each => each.at ?? each.line))) == '{json.dumps(list(lines), separators=(',', ':'))}'", f"breakpoints in {lines}")


def stops_and_steps(browser, other):
    presses_number(browser, 14)
    has_breakpoints(browser, 14)
    browser.shows("document.querySelector('#script .breakpoint.waiting')?.dataset.line == 14", "one for a text that is not loaded")
    browser.evaluate("swanilda.ask('play')")
    stops_at(browser, 15)
    has_breakpoints(browser, 15)
    browser.shows("document.querySelector('#script .breakpoint:not(.waiting)')?.dataset.line == 15", "the next line with code")
    browser.shows(f"({VARIABLES}).step == '1'", "a local variable")
    same("what stands still is no busy script", browser.evaluate("swanilda.store.busy"), None)
    other.sees(15)
    same("its handle", other.seen["stopped"]["handle"], browser.evaluate(f"{SCRIPT}.handle"))
    is_accessible(browser)
    key(browser, "F11")
    stops_at(browser, 4)
    browser.shows(f"({VARIABLES}).a == '0' && ({VARIABLES}).b == '1'", "the arguments")
    browser.shows("document.querySelector('.debug-tools select').options.length >= 2", "the calls")
    other.sees(4)
    key(browser, "F11", "Shift")
    stops_at(browser, 16)
    press(browser, ".debug-tools button[title^='Over']")
    stops_at(browser, 17)
    other.sees(17)


def others_are_answered(browser, other):
    same("the text of the script", other.ask("script", handle=browser.evaluate(f"{SCRIPT}.handle"))["language"], "lua")
    refused = other.ask("select", handles=[])
    same(f"a request that has to wait: {refused}", refused.endswith("stands still in line 17: let it go on first"), True)


def values_open(browser):
    """Tables, which stay open from stop to stop."""
    for name in ("Globals", "robot"):
        press_variable(browser, name)
    browser.shows(f"({VARIABLES}).name == '\"bee\"'", "what is in a table")
    key(browser, "F8")
    stops_at(browser, 15)
    browser.shows(f"({VARIABLES}).name == '\"bee\"' && ({VARIABLES}).step == '2'", "the same at the next stop")
    press_variable(browser, "Globals")


def press_variable(browser, name):
    button = f"[...document.querySelectorAll('button.variable')].find(row => row.querySelector('.variable-name').textContent == '{name}')"
    browser.shows(f"!!{button}", name)
    browser.evaluate(f"{button}.scrollIntoView({{block: 'nearest'}})")
    click(browser, middle(browser, button))


def goes_on(browser):
    presses_number(browser, 15)
    has_breakpoints(browser)
    browser.evaluate("document.getElementById('scene').focus()")
    key(browser, " ")
    browser.shows("swanilda.store.stopped === null && swanilda.store.scene.state == 'running'", "it goes on")
    browser.shows("document.querySelector('#script .code-line.stopped') === null && document.querySelector('.debug').hidden", "nothing is marked")


def a_captured_run(browser, other):
    stops_and_steps(browser, other)
    others_are_answered(browser, other)
    values_open(browser)
    browser.evaluate("document.querySelector('.console-input input').focus()")
    browser.command("Input.insertText", text="total")
    key(browser, "Enter")
    browser.shows("document.querySelector('.console-lines').textContent.includes('the run is captured')", "why nothing is evaluated")
    goes_on(browser)


def edits(browser):
    press(browser, '#script [title="Change the text"]')
    browser.shows("!!swanilda.script.editing.editor?.view", "the editor")
    click(browser, middle(browser, "document.querySelector('.cm-content')"))


def to_line(browser, line):
    key(browser, "Home", "Control")
    for _ in range(line - 1):
        key(browser, "ArrowDown")


def lines_of_editor(browser):
    return browser.evaluate("swanilda.script.editing.editor.breakpoints().map(({line}) => line).join()")


def breakpoints_move_with_their_lines(browser):
    """By the mouse beside the lines, and by F9; what is written above them moves them when it is saved."""
    edits(browser)
    click(browser, gutter_at(browser, 15))
    has_breakpoints(browser, 15)
    to_line(browser, 4)
    key(browser, "F9")
    has_breakpoints(browser, 4, 15)
    key(browser, "F9")
    has_breakpoints(browser, 15)
    to_line(browser, 8)
    browser.command("Input.insertText", text="-- a\n-- b\n")
    browser.shows(f"{TEXT}.includes('-- b')", "more lines")
    same("it moves", lines_of_editor(browser), "17")
    has_breakpoints(browser, 15)
    key(browser, "s", "Control")
    has_breakpoints(browser, 17)
    browser.evaluate("swanilda.ask('play')")
    browser.shows(f"{STOP} == 17 && document.querySelector('.cm-line.cm-stopped')?.textContent.includes('total = add')", "a stop in the editor")


def gutter_at(browser, line):
    """Where the breakpoint of a line stands."""
    x = middle(browser, "document.querySelector('.cm-breakpoints')")[0]
    row = f"[...document.querySelectorAll('.cm-lineNumbers .cm-gutterElement')].find(element => element.textContent == '{line}')"
    return [x, middle(browser, row)[1]]


def expressions_are_about_the_stop(browser):
    browser.evaluate("document.querySelector('.console-input input').focus()")
    for text in ("step * 100 + total", "total = 70"):
        browser.command("Input.insertText", text=text)
        key(browser, "Enter")
    browser.shows("[...document.querySelectorAll('.console-lines .text')].some(line => line.textContent == '100' || /^\\d+0\\d$/.test(line.textContent))", "the value")
    key(browser, "F10")
    browser.shows(f"{STOP} == 18", "the next line")
    browser.shows("document.querySelector('.cm-line.cm-stopped')?.textContent.includes('setInt')", "it is marked")


def conditions_hold(browser):
    handle = browser.evaluate(f"{SCRIPT}.handle")
    browser.evaluate(f"swanilda.source.request('breakpoints', {{handle: {handle}, breakpoints: [{{line: 18, condition: 'total >= 90'}}]}})")
    browser.shows("!!document.querySelector('.cm-breakpoints .conditional')", "its look")
    key(browser, "F8")
    browser.shows(f"{STOP} == 18 && swanilda.store.scene.steps > 10", "where it is true")
    browser.shows("document.querySelector('#notice').textContent.startsWith('Stopped at a breakpoint in ')", "the notice")


def a_stop_ends_it(browser):
    browser.evaluate("document.getElementById('scene').focus()")
    key(browser, " ", "Shift")
    browser.shows("swanilda.store.scene.state == 'stopped' && swanilda.store.stopped === null", "the simulation ends")


def undo_keeps_breakpoints(browser):
    """The memory of scripts is another one."""
    handle = browser.evaluate(f"{SCRIPT}.handle")
    browser.evaluate("swanilda.studio.edits.ask('add', {kind: 'dummy', position: [0, 0, 0]})")
    browser.evaluate(f"swanilda.source.request('breakpoints', {{handle: {handle}, breakpoints: [{{line: 18}}]}})")
    browser.evaluate("swanilda.studio.edits.back('undo')")
    browser.shows("swanilda.store.scene.redo != null", "it is undone")
    browser.evaluate("swanilda.ask('play')")
    browser.shows(f"{STOP} == 18", "a stop")


def loops_that_do_not_end_are_stopped(browser):
    handle = browser.evaluate(f"{SCRIPT}.handle")
    clear = f"swanilda.source.request('breakpoints', {{handle: {handle}, breakpoints: []}})"
    browser.evaluate(clear)
    key(browser, "F8")
    browser.shows("swanilda.store.stopped === null", "it goes on")
    make = "loop = sim.createScript(sim.scripttype_customization, 'function sysCall_nonSimulation()\\\\n  n = 0\\\\n  while not done do\\\\n    n = n + 1\\\\n  end\\\\nend\\\\nfunction sysCall_actuation() sysCall_nonSimulation() end') sim.setObjectAlias(loop, 'loop')"
    browser.evaluate(f"swanilda.source.request('run', {{code: '{make.replace(chr(39), chr(92) + chr(39))}'}})")
    loop = "[...swanilda.store.objects.values()].find(object => object.alias == 'loop')"
    browser.shows(f"!!{loop}", "the script")
    handle = browser.evaluate(f"{loop}.handle")
    browser.evaluate(f"swanilda.source.request('run', {{code: 'sim.initScript({handle})'}}).catch(() => {{}}); 0")
    browser.shows("swanilda.store.busy?.includes('has been running')", "it does not end")
    browser.evaluate(f"swanilda.script.debugging.set({handle}, [{{line: 4}}])")
    browser.shows(f"{STOP} == 4 && swanilda.store.stopped.title == '/loop'", "a stop in the loop")
    browser.evaluate("swanilda.script.debugging.evaluate('done = true')")
    browser.evaluate(f"swanilda.script.debugging.set({handle}, [])")
    browser.evaluate("swanilda.script.debugging.go('continue')")
    browser.shows("swanilda.store.stopped === null && swanilda.store.busy === null", "it ends")


def stands_still(browser):
    """What the script will print when it goes on."""
    handle = browser.evaluate(f"{SCRIPT}.handle")
    browser.evaluate(f"swanilda.script.debugging.set({handle}, [{{line: 18}}])")
    browser.shows(f"{STOP} == 18", "a stop")
    return int(browser.evaluate("swanilda.script.debugging.evaluate('total')")) + 1


def says_nothing(browser):
    errors = [event["params"]["entry"]["text"] for event in browser.events if event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error"]
    same("errors in the browser's console", errors, [])
    same("exceptions", [event["params"] for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


def main():
    arguments = ["--paused", "--no-open", "--empty", "--as=simulation"]
    for is_captured in (True, False):
        with Simulator(SCENE, *arguments, command="view", replayed=is_captured) as sim:
            sim.address = sim.line(lambda line: line["type"] == "viewing", "the address")["url"]
            with opened(sim) as browser, Other(sim.address) as other:
                if is_captured:
                    a_captured_run(browser, other)
                    says_nothing(browser)
                    continue
                other.socket.close()
                breakpoints_move_with_their_lines(browser)
                expressions_are_about_the_stop(browser)
                conditions_hold(browser)
                a_stop_ends_it(browser)
                undo_keeps_breakpoints(browser)
                loops_that_do_not_end_are_stopped(browser)
                says_nothing(browser)
                total = stands_still(browser)
            sim.printed(f"total {total}")  # without pages it goes on


main()
