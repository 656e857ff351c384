"""Interfaces in QML in a headless Chromium: pictures of a process with PySide6, inputs by mouse and keys, events both ways."""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import LIMIT, ROOT, Simulator

PYTHON = sys.argv[2]  # has PySide6; the one that runs this has not

DIALS = """import QtQuick
import QtQuick.Controls
ApplicationWindow {
    title: "Dials"; width: 320; height: 300; visible: true
    function add(data) { names.append({name: data.name}); simBridge.sendEvent("count", names.count) }
    function turn(on) { spin.running = on }
    onClosing: simBridge.sendEvent("closing")
    onWidthChanged: simBridge.sendEvent("width", width)
    Rectangle { anchors.fill: parent; color: "white" }
    Button { x: 10; y: 10; width: 100; height: 30; text: "Press"; onClicked: simBridge.sendEvent("pressed", {n: 1}) }
    Button { x: 120; y: 10; width: 100; height: 30; text: "Fail"; onClicked: nothing.at.all }
    Slider { x: 10; y: 50; width: 200; height: 30; to: 10; stepSize: 1; onMoved: simBridge.sendEvent("slid", value) }
    TextField { x: 10; y: 90; width: 200; height: 30; onAccepted: simBridge.sendEvent("typed", text) }
    ListView { x: 10; y: 130; width: 200; height: 80; model: ListModel { id: names } delegate: Rectangle { width: 200; height: 20; color: "blue" } }
    Rectangle { x: 240; y: 200; width: 40; height: 40; color: "red"; NumberAnimation on rotation { id: spin; running: false; from: 0; to: 360; duration: 1500; loops: Animation.Infinite } }
    MouseArea { x: 220; y: 50; width: 100; height: 100; acceptedButtons: Qt.AllButtons
        onWheel: (wheel) => simBridge.sendEvent("wheel", wheel.angleDelta.y)
        onDoubleClicked: simBridge.sendEvent("double") }
}
"""
CODE = """simQML = require 'simQML'
engine = simQML.createEngine()
function received(_, name, data) print('event', name, type(data) == 'table' and data.n or data) end
simQML.setEventHandler(engine, 'received')
simQML.loadData(engine, [==[%s]==])
print('version', simQML.qtVersion()[1])"""
CANVAS = "document.querySelector('.window canvas.drawn')"


def run(browser, code):
    return browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(code)}}})")


def pixel(x, y):
    return f"[...{CANVAS}.getContext('2d').getImageData({x}, {y}, 1, 1).data].join()"


def mouse(browser, kind, x, y, buttons=0, **more):
    left, top = browser.evaluate(f"(({{left, top}}) => [left, top])({CANVAS}.getBoundingClientRect())")
    browser.command("Input.dispatchMouseEvent", type=kind, x=left + x, y=top + y, button=more.pop("button", "left"), buttons=buttons, **{"clickCount": 1, **more})


def click(browser, x, y):
    mouse(browser, "mousePressed", x, y, 1)
    mouse(browser, "mouseReleased", x, y)


def press(browser, key, text="", **more):
    browser.command("Input.dispatchKeyEvent", type="keyDown", key=key, text=text, **more)
    browser.command("Input.dispatchKeyEvent", type="keyUp", key=key, **more)


def an_interface_is_drawn(browser, sim):
    run(browser, CODE % DIALS)
    sim.printed("version, 6")
    browser.shows(f"{CANVAS}?.width == 320 && {CANVAS}.height == 300", "the canvas")
    same("the title", browser.evaluate(f"{CANVAS}.closest('.window').querySelector('h2').textContent"), "Dials")
    browser.shows(f"{pixel(260, 220)} == '255,0,0,255'", "the red square")
    same("the ground", browser.evaluate(pixel(300, 280)), "255,255,255,255")


def a_button_is_clicked(browser, sim):
    click(browser, 60, 25)
    sim.printed("event, pressed, 1")


def a_slider_is_dragged(browser, sim):
    mouse(browser, "mousePressed", 18, 65, 1)
    for x in range(40, 120, 10):
        mouse(browser, "mouseMoved", x, 65, 1)
    mouse(browser, "mouseReleased", 110, 65)
    sim.printed("event, slid, 5")
    same("nothing more than a slider", [line for line in sim.lines if line.get("text", "").startswith("event, pressed")], [])


def a_list_grows_by_events(browser, sim):
    browser.shows(f"{pixel(100, 140)} == '255,255,255,255'", "no line")
    run(browser, "simQML.sendEvent(engine, 'add', {name = 'one'}) simQML.sendEvent(engine, 'add', {name = 'two'})")
    sim.printed("event, count, 2")
    browser.shows(f"{pixel(100, 140)} == '0,0,255,255' && {pixel(100, 165)} == '0,0,255,255'", "two lines")
    same("no third one", browser.evaluate(pixel(100, 185)), "255,255,255,255")


def an_animation_moves(browser):
    corner = pixel(237, 197)  # outside of the square, until it has turned
    same("before", browser.evaluate(pixel(260, 194)), "255,255,255,255")
    run(browser, "simQML.sendEvent(engine, 'turn', true)")
    for _ in range(2):  # it comes and goes
        browser.shows(f"{pixel(260, 194)} != '255,255,255,255'", "a corner")
        browser.shows(f"{pixel(260, 194)} == '255,255,255,255'", "a side")
    same("the corner of its box", browser.evaluate(corner), "255,255,255,255")
    run(browser, "simQML.sendEvent(engine, 'turn', false)")


def keys_enter_text(browser, sim):
    click(browser, 100, 105)
    same("the focus", browser.evaluate(f"document.activeElement == {CANVAS}"), True)
    for letter in "aB":
        press(browser, letter, letter)
    press(browser, "Enter", "\r")
    sim.printed("event, typed, aB")
    same("the dialog of keys", browser.evaluate("document.querySelector('dialog.help')?.open ?? false"), False)
    press(browser, "F6")
    same("the way out", browser.evaluate(f"document.activeElement == {CANVAS}.closest('.window').querySelector('.window-grip')"), True)


def the_wheel_and_double_clicks(browser, sim):
    mouse(browser, "mouseWheel", 270, 100, deltaX=0, deltaY=100, button="none")
    sim.printed("event, wheel, -120")
    click(browser, 270, 100)
    click(browser, 270, 100)
    sim.printed("event, double")


def errors_have_their_line(browser, sim):
    click(browser, 170, 25)
    line = next(number for number, line in enumerate(DIALS.split("\n"), 1) if "nothing.at.all" in line)
    same("the place", f"data.qml:{line}: ReferenceError: nothing is not defined" in sim.logged("ReferenceError"), True)
    run(browser, "print('wrong', select(2, pcall(simQML.loadData, simQML.createEngine(), 'import QtQuick\\nItem {\\n  width: 3 4\\n}')))")
    same("the place", "data.qml:3:12" in sim.printed("wrong"), True)


def windows_are_resized_and_closed(browser, sim):
    browser.evaluate(f"Object.assign({CANVAS}.closest('.window').style, {{width: '402px', height: '360px'}})")
    sim.printed("event, width, 400")
    browser.shows(f"{CANVAS}.width == 400", "its picture")
    browser.evaluate(f"[...{CANVAS}.closest('.window').querySelectorAll('header button')].at(-1).click()")
    sim.printed("event, closing")
    browser.shows(f"{CANVAS}.closest('.window').hidden", "the end")
    run(browser, "simQML.destroyEngine(engine)")
    browser.shows(f"!{CANVAS}", "nothing is left")


def descendants(pid):
    """The processes that a process has started, and those have."""
    parents = {}
    for entry in pathlib.Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                parents.setdefault(int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1]), []).append(int(entry.name))
            except OSError:
                pass  # it has ended
    found, waiting = [], [pid]
    while waiting:
        below = parents.get(waiting.pop(), [])
        found += below
        waiting += below
    return found


def is_alive(pid):
    try:
        return pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


def nothing_outlives_the_simulator(browser, sim):
    run(browser, CODE % DIALS)
    browser.shows(f"!!{CANVAS}", "the canvas")
    processes = descendants(sim.process.pid)
    same("a guardian and an interface", len(processes), 2)
    os.kill(processes[-1], 9)
    same("a death", sim.logged("has ended").split(": ", 1)[1], "The process of the interface has ended (exit status: 137).")
    browser.shows(f"!{CANVAS}", "no window")
    run(browser, "simQML.sendEvent(engine, 'add', {name = 'none'}) " + CODE % DIALS)
    browser.shows(f"!!{CANVAS}", "another one")
    processes = descendants(sim.process.pid)
    sim.process.kill()
    browser.until(lambda: not any(map(is_alive, processes)), "the end of the processes")


def run_alone(*options):
    """What a run says that loads an interface in a script."""
    with tempfile.TemporaryDirectory() as folder:
        scene = pathlib.Path(folder, "scene.lua")
        scene.write_text(f"sim = require 'sim'\nfunction sysCall_init()\n{CODE % DIALS}\nend")
        line = [sys.argv[1], "run", str(scene), "--steps", "1", *options]
        return subprocess.run(line, capture_output=True, cwd=ROOT, timeout=LIMIT, text=True)


def says_why_not():
    denied = run_alone("--no-unsafe", "-D", f"python={PYTHON}")
    same("not permitted", f"running '{PYTHON}' is not allowed: run with --allow-run" in denied.stdout + denied.stderr, True)
    lacking = run_alone("-D", f"python={sys.executable}")
    said = "No module named 'PySide6'. QML needs PySide6: install it with 'pip install swanilda[qml]', or name a Python that has it with -D python=PATH."
    same("lacking", said in lacking.stdout + lacking.stderr, True)
    same("both go on", (denied.returncode, lacking.returncode), (0, 0))


def main():
    options = ("--paused", "--no-open", "--empty", "-D", f"python={PYTHON}")
    chromium = program() or sys.exit("there is no Chromium")
    with Simulator(*options, command="view") as sim, Browser(chromium, WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1000, height=700, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open'", "the page")
        an_interface_is_drawn(browser, sim)
        a_button_is_clicked(browser, sim)
        a_slider_is_dragged(browser, sim)
        a_list_grows_by_events(browser, sim)
        an_animation_moves(browser)
        keys_enter_text(browser, sim)
        the_wheel_and_double_clicks(browser, sim)
        errors_have_their_line(browser, sim)
        if len(sys.argv) > 3:
            import base64
            open(sys.argv[3], "wb").write(base64.b64decode(browser.command("Page.captureScreenshot")["data"]))
        windows_are_resized_and_closed(browser, sim)
        nothing_outlives_the_simulator(browser, sim)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])
    says_why_not()


main()
