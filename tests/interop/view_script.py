"""Scripts that are changed in the viewer's page, with real keys in a headless Chromium.

With `plain` as second argument the page gets what programs serve that were built without the editor component.
"""

import base64
import json
import os
import pathlib
import sys

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import Simulator

SCENE = str(pathlib.Path(__file__).with_name("view_script.lua"))
KEYS = {"Enter": (13, "\r"), "Tab": (9, ""), "Escape": (27, ""), "Home": (36, ""), "End": (35, ""), "ArrowDown": (40, ""), "ArrowUp": (38, ""), "Backspace": (8, "")}
CTRL, SHIFT = 2, 8
SCRIPT = "[...swanilda.store.objects.values()].find(object => object.objectType == 'script')"
TEXT = "swanilda.script.editing.draft?.text"
TITLE = "document.querySelector('#script .inspected').textContent"
COUNT = "swanilda.source.request('run', {code: \"print(sim.getIntProperty(sim.handle_scene, 'signal.count', {noError = true}))\"})"
PENCIL = "!!document.querySelector('#script [title=\"Change the text\"]:not([hidden])')"
BUTTON = "[...document.querySelectorAll('#script button')].find(button => button.textContent == '{}')"


def press(browser, key, modifiers=0):
    code, text = KEYS.get(key) or (ord(key.upper()), "" if modifiers & CTRL else key)
    event = {"key": key, "modifiers": modifiers, "windowsVirtualKeyCode": code}
    browser.command("Input.dispatchKeyEvent", type="keyDown", **event, **({"text": text} if text and not modifiers & CTRL else {}))
    browser.command("Input.dispatchKeyEvent", type="keyUp", **event)


def write(browser, text):
    for letter in text:
        press(browser, "Enter") if letter == "\n" else browser.command("Input.insertText", text=letter)


def click(browser, expression):
    x, y = browser.evaluate(f"(({{left, top, width, height}}) => [left + width / 2, top + height / 2])({expression}.getBoundingClientRect())")
    for kind in ("mousePressed", "mouseReleased"):
        browser.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)


WITHOUT_COMPONENT = base64.b64encode(b"export const makeEditor = null;").decode()


def opened(sim, is_plain):
    browser = Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL)
    for domain in ("Page", "Runtime", "Log"):
        browser.command(f"{domain}.enable")
    if is_plain:
        browser.command("Fetch.enable", patterns=[{"urlPattern": "*/editor/editor.js"}])
    browser.command("Emulation.setDeviceMetricsOverride", width=1300, height=800, deviceScaleFactor=1, mobile=False)
    browser.open(sim.address)
    browser.shows(f"globalThis.swanilda?.store.objects.size && {SCRIPT}", "the script")
    return browser


def answers(browser):
    """Whether the page has asked for the component; it gets none."""
    asked = next((event["params"]["requestId"] for event in browser.events if event["method"] == "Fetch.requestPaused"), None)
    if asked:
        headers = [{"name": "Content-Type", "value": "text/javascript"}]
        browser.command("Fetch.fulfillRequest", requestId=asked, responseCode=200, responseHeaders=headers, body=WITHOUT_COMPONENT)
    return asked


def begins_to_edit(browser):
    browser.evaluate(f"swanilda.openScript({SCRIPT}.handle)")
    browser.shows(PENCIL, "the text")
    click(browser, "document.querySelector('#script [title=\"Change the text\"]')")
    browser.until(lambda: answers(browser) or browser.evaluate("!!swanilda.script.editing.editor"), "the editor")
    browser.shows("!!swanilda.script.editing.editor", "the editor")


def to_line(browser, number):
    press(browser, "Home", CTRL)
    for _ in range(number - 1):
        press(browser, "ArrowDown")


def names_are_completed(browser):
    to_line(browser, 5)
    press(browser, "End")
    write(browser, "\nsim.getObjectPosi")
    options = "[...document.querySelectorAll('.cm-tooltip-autocomplete li')].map(option => option.textContent)"
    browser.shows(f"{options}[0] == 'getObjectPosition'", "the completion")
    is_accessible(browser)
    browser.shows("document.querySelector('.cm-description code')?.textContent.startsWith('float[3] position = sim.getObjectPosition(')", "the signature")
    same("its sentence", browser.evaluate("document.querySelector('.cm-description p').textContent"), "Position of an object")
    accept(browser)
    browser.shows(f"{TEXT}.includes('\\nsim.getObjectPosition\\n')", "the name")
    write(browser, "(")
    browser.shows("document.querySelector('.cm-signature').textContent.startsWith('float[3] position')", "the line with the signature")
    write(browser, ") local own_name = 1 ow")
    browser.shows(f"{options}.includes('own_name')", "a word of the text")
    press(browser, "Escape")
    write(browser, " = require 'simI")
    browser.shows(f"{options}.includes('simIK')", "a module")
    press(browser, "Escape")
    press(browser, "Home")
    press(browser, "Home")
    press(browser, "End", SHIFT)
    press(browser, "Backspace")
    press(browser, "Backspace")
    same("the text", browser.evaluate(f"{TEXT} == swanilda.script.editing.draft.original"), True)


def accept(browser):
    """Takes the chosen completion; one that has only just appeared is not meant by the key."""
    browser.evaluate("new Promise(done => setTimeout(done, 150))")
    press(browser, "Enter")


def callbacks_are_completed_whole(browser):
    press(browser, "End", CTRL)
    write(browser, "\nsysCall_sens")
    browser.shows("document.querySelector('.cm-tooltip-autocomplete li[aria-selected]')?.textContent == 'sysCall_sensing'", "the callback")
    accept(browser)
    browser.shows(f"{TEXT}.endsWith('function sysCall_sensing()\\n    \\nend')", "its frame")
    press(browser, "z", CTRL)
    press(browser, "z", CTRL)
    browser.shows(f"!{TEXT}.includes('sensing()')", "undone")


def errors_are_marked_at_their_lines(browser):
    to_line(browser, 5)
    press(browser, "End")
    write(browser, "\nif then")
    mark = "[...document.querySelectorAll('.cm-line')].findIndex(line => line.querySelector('.cm-lintRange-error')) + 1"
    browser.shows(f"{mark} == 6", "the line of the error in the syntax")
    for _ in range(8):
        press(browser, "Backspace")
    browser.shows(f"{mark} == 0", "no error")


def errors_in_python_are_marked_at_their_columns(browser):
    """As Python's compiler finds them, which runs nothing."""
    make = "h = sim.createScript(sim.scripttype_customization, '#python\\ndef sysCall_init():\\n    pass\\n', 0, 'python') sim.setObjectAlias(h, 'snake')"
    browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(make)}}})")
    edits(browser, "snake")
    press(browser, "End", CTRL)
    write(browser, "b = = 2")
    mark = "[...document.querySelectorAll('.cm-line')].flatMap((line, i) => [...line.querySelectorAll('.cm-lintRange-error')].map(({textContent}) => [i + 1, textContent]))"
    browser.shows(f"JSON.stringify({mark}) == '[[4,\"=\"]]'", "the column of the error")
    for _ in range(4):
        press(browser, "Backspace")
    browser.shows(f"JSON.stringify({mark}) != '[[4,\"=\"]]'", "another error, or none")
    write(browser, " 2")
    browser.shows(f"{mark}.length == 0", "no error")
    click(browser, BUTTON.format("Discard"))


def search_finds(browser):
    press(browser, "f", CTRL)
    browser.shows("!!document.querySelector('.cm-search input')", "the search")
    for letter in "count":
        press(browser, letter)
    browser.shows("document.querySelectorAll('.cm-searchMatch').length >= 2", "what was found")
    press(browser, "Escape")


def replaces(browser, old, new):
    """Changes a text that occurs once, by keys."""
    lines = browser.evaluate(TEXT).split("\n")
    line = next(number for number, text in enumerate(lines, 1) if old in text)
    to_line(browser, line)
    press(browser, "End")
    press(browser, "Home", SHIFT)
    press(browser, "Home", SHIFT)
    press(browser, "Backspace")
    write(browser, lines[line - 1].replace(old, new).strip() if "    " not in lines[line - 1] else lines[line - 1].replace(old, new))


def is_saved_while_the_simulation_runs(browser, sim):
    browser.evaluate("swanilda.ask('play')")
    browser.until(lambda: browser.evaluate(COUNT) == "1", "the script")
    time = browser.evaluate("swanilda.store.scene.time")
    click(browser, "document.querySelector('#script .script-editing textarea, #script .cm-content')")
    replaces(browser, "count = 1", "count = 2")
    same("the mark in the title", browser.evaluate(TITLE)[0], "●")
    press(browser, "s", CTRL)
    browser.until(lambda: browser.evaluate(COUNT) == "2", "the new text")
    browser.shows(f"!{TITLE}.startsWith('●')", "no mark")
    same("it runs on", browser.evaluate(f"swanilda.store.scene.state == 'running' && swanilda.store.scene.time > {time}"), True)


def errors_of_the_run_are_marked(browser):
    replaces(browser, "count = 2", "count = 2 + nothing")
    press(browser, "Enter", CTRL)
    browser.shows("document.querySelector('.script-error').textContent.startsWith('Line 4: ')", "the error")
    if not browser.evaluate("!!document.querySelector('.plain-editor')"):
        browser.shows("document.querySelector('.cm-lintRange-error')?.closest('.cm-line').textContent.includes('nothing')", "its line")
    replaces(browser, "count = 2 + nothing", "count = 2")
    press(browser, "s", CTRL)
    browser.shows("document.querySelector('.script-error').hidden", "no error")
    browser.evaluate("swanilda.ask('play')")  # an error pauses


def unsaved_texts_survive(browser):
    replaces(browser, "count = 2", "count = 3")
    click(browser, "document.querySelector('#script .panel-close')")
    browser.shows("document.getElementById('script').hidden", "the panel closed")
    browser.evaluate(f"swanilda.openScript({SCRIPT}.handle)")
    browser.shows(f"{TEXT}.includes('count = 3') && {TITLE}.startsWith('●')", "the text")


def two_pages_do_not_lose_their_work(browser, other):
    """`browser` has `count = 3`, not saved."""
    begins_to_edit(other)
    click(other, "document.querySelector('#script .script-editing textarea, #script .cm-content')")
    replaces(other, "count = 2", "count = 4")
    press(other, "s", CTRL)
    other.until(lambda: other.evaluate(COUNT) == "4", "the text of the other page")
    browser.shows("[...document.querySelectorAll('.script-conflict .other')].map(line => line.textContent).join().includes('count = 4')", "theirs")
    same("mine", "count = 3" in browser.evaluate(TEXT), True)
    press(browser, "s", CTRL)
    same("not overwritten", browser.evaluate(COUNT), "4")
    click(browser, BUTTON.format("Keep mine"))
    browser.until(lambda: browser.evaluate(COUNT) == "3", "mine")
    other.shows(f"{TEXT}.includes('count = 3')", "a page without changes follows")
    replaces(other, "count = 3", "count = 5")
    replaces(browser, "count = 3", "count = 6")
    press(browser, "s", CTRL)
    other.shows("!document.querySelector('.script-conflict').hidden", "the notice of the other page")
    click(other, BUTTON.format("Take theirs"))
    other.shows(f"{TEXT}.includes('count = 6')", "theirs")
    same("nothing to save", other.evaluate(TITLE)[0] == "●", False)


def edits(browser, alias):
    """Begins to edit another script, whose editor has come before."""
    script = f"[...swanilda.store.objects.values()].find(object => object.alias == '{alias}')"
    browser.shows(f"!!{script}", "another script")
    browser.evaluate(f"swanilda.openScript({script}.handle)")
    browser.shows(f"{TITLE} == '/{alias}' && {PENCIL}", "its text")
    click(browser, "document.querySelector('#script [title=\"Change the text\"]')")
    browser.shows("!!swanilda.script.editing.editor", "the editor")


def ends_of_lines_stay(browser):
    """As in a text from Windows."""
    make = "h = sim.createScript(sim.scripttype_customization, 'a = 1\\r\\nb = 2\\r\\n') sim.setObjectAlias(h, 'windows')"
    browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(make)}}})")
    edits(browser, "windows")
    press(browser, "End")
    write(browser, "0\n")
    same("the text", browser.evaluate(TEXT), "a = 10\r\n\r\nb = 2\r\n")
    click(browser, BUTTON.format("Discard"))


def keys_leave_the_text(browser):
    """Escape, then Tab."""
    click(browser, "document.querySelector('#script .cm-content')")
    press(browser, "Escape")
    press(browser, "Tab")
    same("outside", browser.evaluate("document.activeElement.closest('.cm-content')"), None)


def says_nothing(browser):
    errors = [event["params"]["entry"]["text"] for event in browser.events if event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error"]
    same("errors in the browser's console", errors, [])
    same("exceptions", [event["params"] for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


def main():
    is_plain = sys.argv[2:] == ["plain"]
    with Simulator(SCENE, "--paused", "--no-open", "--empty", command="view") as sim:
        sim.address = sim.line(lambda line: line["type"] == "viewing", "the address")["url"]
        with opened(sim, is_plain) as browser, opened(sim, is_plain) as other:
            begins_to_edit(browser)
            has_component = not browser.evaluate("!!document.querySelector('.plain-editor')")
            if is_plain or "CI" in os.environ:  # elsewhere the program may be built without it
                same("whether there is the component", has_component, not is_plain)
            is_accessible(browser)
            if has_component:
                names_are_completed(browser)
                callbacks_are_completed_whole(browser)
                errors_are_marked_at_their_lines(browser)
                search_finds(browser)
                keys_leave_the_text(browser)
                ends_of_lines_stay(browser)
                errors_in_python_are_marked_at_their_columns(browser)
                begins_to_edit(browser)
            is_saved_while_the_simulation_runs(browser, sim)
            errors_of_the_run_are_marked(browser)
            unsaved_texts_survive(browser)
            two_pages_do_not_lose_their_work(browser, other)
            for page in (browser, other):
                says_nothing(page)


main()
