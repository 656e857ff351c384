"""Curves over a live run: numbers of properties at every step, put there by a button or by dragging, saved as files."""

import json
import math
import pathlib
import sys
import tempfile
import xml.etree.ElementTree

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import click, found, key, middle, mouse, press, run, with_text
from simulator import Simulator

CODE = """
slide = sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0)
sim.setObjectAlias(slide, 'slide')
ball = sim.createDummy(0.05)
sim.setObjectAlias(ball, 'ball')
sim.setObjectParent(ball, slide, true)
script = sim.createScript(sim.scripttype_simulation, 'function sysCall_actuation() sim.setJointPosition(sim.getObject("/slide"), 0.4 * math.sin(sim.getSimulationTime())) end')
"""
CURVE = "swanilda.curves.curves.find(curve => curve.name.startsWith({!r}))"


def choose(browser, name):
    browser.evaluate(f"swanilda.select([...swanilda.store.objects.values()].find(object => object.alias == '{name}').handle)")
    browser.shows(f"{found('.inspected')}.textContent == '{name}' && {found('.essentials [data-name=alias] input')}?.value == '{name}'", name)


def a_button_puts_a_number_on_the_curves(browser):
    choose(browser, "slide")
    press(browser, "[data-name=jointPosition] .plot-button")
    browser.shows("!document.getElementById('curves').hidden", "the pane")
    same("the button", browser.evaluate(f"{found('[data-name=jointPosition] .plot-button')}.ariaPressed"), "true")
    browser.evaluate("document.activeElement.blur()")  # Space presses buttons
    key(browser, " ")
    curve = CURVE.format("slide position")
    browser.shows(f"{curve}?.x.length > 20", "the curve")
    key(browser, " ")
    browser.shows("swanilda.store.scene.state == 'paused'", "the pause")
    times, values, step = browser.evaluate(f"[{curve}.x, {curve}.y, swanilda.store.scene.timeStep]")
    moving = range(times.index(next(time for time in times if time > 0)) + 1, len(times))
    same("every step", all(abs(times[i] - times[i - 1] - step) < 1e-9 for i in moving), True)
    same("its values", all(min(abs(values[i] - 0.4 * math.sin(times[i] - k * step)) for k in (0, 1)) < 1e-6 for i in moving), True)


def rows_are_dragged_to_the_pane(browser):
    """The position of an object: three numbers."""
    choose(browser, "ball")
    browser.command("Input.setInterceptDrags", enabled=True)
    start = middle(browser, found(".pose-block .plot-button"))
    mouse(browser, "mouseMoved", start, "none")
    mouse(browser, "mousePressed", start)
    mouse(browser, "mouseMoved", [start[0] + 10, start[1]], buttons=1)
    mouse(browser, "mouseMoved", [start[0] + 40, start[1]], buttons=1)
    data = browser.until(lambda: browser.evaluate("1") and next((event["params"]["data"] for event in browser.events if event["method"] == "Input.dragIntercepted"), None), "the drag")
    at = middle(browser, found("#curves canvas"))
    for kind in ("dragEnter", "dragOver", "drop"):
        browser.command("Input.dispatchDragEvent", type=kind, x=at[0], y=at[1], data=data)
    mouse(browser, "mouseReleased", at)
    browser.command("Input.setInterceptDrags", enabled=False)
    browser.shows("swanilda.curves.curves.map(curve => curve.name).join() == 'slide position,ball position x,ball position y,ball position z'", "the curves")
    browser.evaluate("document.activeElement.blur()")
    key(browser, ".")
    browser.shows(f"{CURVE.format('ball position z')}.x.length > 1", "the step")
    same("along the joint", browser.evaluate(f"(([a, b]) => Math.abs(a.y.at(-1) - b.y.at(-1)) < 1e-9)([{CURVE.format('ball position z')}, {CURVE.format('slide position')}])"), True)


def curves_are_saved(browser):
    with tempfile.TemporaryDirectory() as folder:
        browser.command("Browser.setDownloadBehavior", behavior="allow", downloadPath=folder)
        saved = lambda suffix: next((path for path in pathlib.Path(folder).glob(f"*.{suffix}") if path.stat().st_size), None)
        click(browser, middle(browser, with_text(".curve-tools button", "CSV")))
        table = browser.until(lambda: saved("csv"), "the table").read_text().splitlines()
        same("columns", table[0], "time,slide position [m],ball position x [m],ball position y [m],ball position z [m]")
        same("rows", len(table) - 1, browser.evaluate("new Set(swanilda.curves.curves.flatMap(curve => curve.x)).size"))
        same("numbers", len([float(cell) for cell in table[-1].split(",")]), 5)
        click(browser, middle(browser, with_text(".curve-tools button", "SVG")))
        picture = xml.etree.ElementTree.parse(browser.until(lambda: saved("svg"), "the picture"))
        lines = picture.findall(".//{http://www.w3.org/2000/svg}polyline")
        same("lines", len(lines), 4)
        same("points", len(lines[0].get("points").split()), browser.evaluate("swanilda.curves.curves[0].x.length"))
        texts = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
        same("the legend", "slide position [m]" in texts and "time in s" in texts, True)


def what_is_not_followed_is_not_sent(browser):
    click(browser, middle(browser, with_text(".curve-tools button", "Clear")))
    browser.shows("document.getElementById('curves').hidden && swanilda.plots.followed.length == 0", "nothing is followed")
    browser.evaluate("swanilda.store.on('samples', () => (globalThis.late = true))")
    run(browser, "1")
    browser.evaluate("globalThis.late = false")
    key(browser, ".")
    browser.shows("swanilda.store.scene.state == 'paused'", "a step")
    run(browser, "1")
    same("no numbers", browser.evaluate("globalThis.late"), False)


def lists_that_are_none_are_refused(browser):
    for items in ("5", "[{}]", "[{handle: 1, name: 'x', index: -1}]", "new Array(257).fill({handle: 1, name: 'mass'})"):
        answer = f"swanilda.source.request('sample', {{items: {items}}}).then(() => 'taken', error => error.message)"
        same(items, browser.evaluate(answer) != "taken", True)


def main():
    with Simulator("--empty", "--paused", "--no-open", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=1000, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")
        run(browser, CODE)
        browser.shows("swanilda.store.objects.size >= 3", "the objects")
        a_button_puts_a_number_on_the_curves(browser)
        rows_are_dragged_to_the_pane(browser)
        curves_are_saved(browser)
        is_accessible(browser)
        what_is_not_followed_is_not_sent(browser)
        lists_that_are_none_are_refused(browser)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
