"""The viewer's page in a headless Chromium."""

import base64
import json
import os
import pathlib
import sys

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import Simulator

FOLDER = pathlib.Path(__file__).parent
PICTURE = FOLDER / "view_picture.png"
TOLERANCE = 6  # mean difference of a colour, of 255
OBJECT = "[...swanilda.store.objects.values()].find(object => object.alias == '{}')"
TREE = "[...document.querySelectorAll('[role=treeitem] .name')].map(name => name.textContent)"
PLACE = "(() => {{ const o = {}, p = swanilda.renderer.screenPosition(swanilda.store.poses.get(o.handle)); const c = swanilda.renderer.canvas.getBoundingClientRect(); return [p[0] + c.left, p[1] + c.top] }})()"


def page_opens(browser, sim):
    address = sim.line(lambda line: line["type"] == "viewing", "the address")["url"]
    browser.command("Emulation.setDeviceMetricsOverride", width=1000, height=700, deviceScaleFactor=1, mobile=False)
    browser.open(address)
    browser.shows(f"{TREE}.includes('box')", "the tree")
    same("the title", browser.evaluate("document.title").endswith("Swanilda"), True)
    browser.shows("swanilda.renderer.resources.busy === false && swanilda.renderer.matrices != null", "the scene")
    same("what is there", browser.evaluate("document.getElementById('stage').clientWidth > 0.7 * innerWidth"), True)
    return address


def looks_as_before(browser):
    """The scene beside a small picture of it; `UPDATE=1` takes a new one."""
    browser.shows("!swanilda.renderer.quality.moving", "rest")
    browser.evaluate("new Promise(done => setTimeout(done, 600))")
    box = browser.evaluate("(({left, top, width, height}) => [left, top, width, height])(document.getElementById('scene').getBoundingClientRect())")
    clip = {**dict(zip(("x", "y", "width", "height"), box)), "scale": 0.25}
    taken = browser.command("Page.captureScreenshot", format="png", clip=clip)["data"]
    if os.environ.get("UPDATE"):
        PICTURE.write_bytes(base64.b64decode(taken))
    kept = base64.b64encode(PICTURE.read_bytes()).decode()
    difference = browser.evaluate(f"""(async () => {{
        const pixels = async (data) => {{
            const image = new Image();
            image.src = 'data:image/png;base64,' + data;
            await image.decode();
            const canvas = new OffscreenCanvas(64, 48).getContext('2d');
            canvas.drawImage(image, 0, 0, 64, 48);
            return canvas.getImageData(0, 0, 64, 48).data;
        }};
        const [a, b] = [await pixels('{taken}'), await pixels('{kept}')];
        return a.reduce((sum, x, i) => sum + Math.abs(x - b[i]), 0) / a.length;
    }})()""")
    same(f"the picture (it differs by {difference})", difference < TOLERANCE, True)


def mouse(browser, kind, x, y, **more):
    browser.command("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1, **more)


def click(browser, x, y):
    mouse(browser, "mousePressed", x, y)
    mouse(browser, "mouseReleased", x, y)


def orbits_about_what_is_under_the_pointer(browser):
    x, y = browser.evaluate(PLACE.format(OBJECT.format("box")))
    touched = f"swanilda.renderer.pick({x} - swanilda.renderer.canvas.getBoundingClientRect().left, {y})"
    point = browser.evaluate(f"{touched}.point")
    yaw = browser.evaluate("swanilda.renderer.camera.yaw")
    mouse(browser, "mousePressed", x, y)
    for i in range(1, 6):
        mouse(browser, "mouseMoved", x + 8 * i, y + 2 * i, buttons=1)
    mouse(browser, "mouseReleased", x + 40, y + 10)
    same("the camera turned", abs(browser.evaluate("swanilda.renderer.camera.yaw") - yaw) > 0.1, True)
    at = "(swanilda.renderer.matrices = swanilda.renderer.camera.matrices(swanilda.renderer.aspect, 100), swanilda.renderer.screenPosition({}))"
    left = browser.evaluate("swanilda.renderer.canvas.getBoundingClientRect().left")
    now = browser.evaluate(at.format(json.dumps(point)))
    same("the pivot stays", max(abs(now[0] + left - x), abs(now[1] - y)) < 2, True)


def selects_both_ways(browser, sim):
    handle = browser.evaluate(f"{OBJECT.format('box')}.handle")
    browser.evaluate("swanilda.fit([])")
    browser.shows("swanilda.renderer.camera.motion === null", "the camera")
    click(browser, *browser.evaluate(PLACE.format(OBJECT.format("box"))))
    browser.shows(f"swanilda.store.selection.join() == '{handle}'", "the selection")
    sim.printed(f"selection: {handle}")
    chosen = "document.querySelector('[role=treeitem][aria-selected=true] .name')?.textContent"
    browser.shows(f"{chosen} == 'box'", "the tree's row")
    browser.shows("document.querySelector('.inspected').textContent == 'box'", "the inspector")
    browser.evaluate("swanilda.source.request('run', {code: \"sim.setObjectSel({sim.getObject('/base')})\"})")
    browser.shows(f"{chosen} == 'base'", "what a script selected")


def edits_properties(browser):
    browser.evaluate(f"swanilda.select({OBJECT.format('box')}.handle, false)")
    field = "document.querySelector('[data-name=alias] input')"
    browser.shows(f"{field}?.value == 'box'", "the field")
    browser.evaluate(f"{field}.value = 'crate'; {field}.dispatchEvent(new Event('change'))")
    layer = "document.querySelector('[data-name=layer] .value')"
    same("an integer", browser.evaluate(f"{layer}.value ?? {layer}.textContent"), "1")
    browser.shows(f"{TREE}.includes('crate')", "the new name")


def steps_plays_and_stops(browser):
    press = "document.querySelector('#bar button[title^=\"{}\"]').click()"
    time = "document.querySelector('.time-now').textContent"
    browser.evaluate(press.format("One step"))
    browser.shows(f"{time} == '0.050 s'", "a step")
    browser.evaluate(press.format("Start"))
    browser.shows(f"parseFloat({time}) > 0.3", "the time")
    browser.shows("document.querySelector('.line.error .text')?.textContent.includes('an error of the test')", "the error")
    browser.shows("swanilda.store.scene.state == 'paused'", "the pause after the error")
    browser.evaluate(press.format("Stop"))
    browser.shows("swanilda.store.scene.state == 'stopped'", "the end")


def console_filters(browser):
    lines = "[...document.querySelectorAll('.console-lines .text')].map(text => text.textContent)"
    browser.shows(f"{lines}.some(text => text.includes('a warning'))", "the log")
    box = "document.querySelector('#console input[type=search]')"
    browser.evaluate(f"{box}.value = 'a warning'; {box}.dispatchEvent(new Event('input'))")
    same("filtered", browser.evaluate(f"{lines}.every(text => text.includes('a warning'))"), True)
    browser.evaluate(f"{box}.value = ''; {box}.dispatchEvent(new Event('input'))")


WINDOW = """simUI = require 'simUI'
function pressed(ui) simUI.setLabelText(ui, 2, '<b>pressed</b><img src=x onerror=hacked=1>') end
simUI.create('<ui title="Panel"><button id="1" text="Press" on-click="pressed"/><label id="2" text="wait"/></ui>')"""


def windows_of_scripts_are_forms(browser):
    browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(WINDOW)}}})")
    browser.shows("document.querySelector('.window h2')?.textContent == 'Panel'", "the window")
    browser.evaluate("document.querySelector('.window .ui-button').click()")
    browser.shows("document.querySelector('.window .ui-label strong')?.textContent == 'pressed'", "the handler")


QML = """simQML = require 'simQML'
engine = simQML.createEngine()
simQML.setEventHandler(engine, 'received')
function received(engine, name, data) print('event ' .. name .. ' ' .. tostring(data.speed)) end
simQML.loadData(engine, 'Window { title: "Dials"; Text { text: "<b>QML</b>" } }')"""


def interfaces_in_qml_show_their_source(browser, sim):
    browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(QML)}}})")
    own = "[...document.querySelectorAll('.window')].find(window => window.querySelector('h2').textContent == 'Dials')"
    browser.shows(f"{own}?.textContent.includes('Text {{ text: \"<b>QML</b>\" }}')", "the source")
    same("the notice", browser.evaluate(f"{own}.textContent.includes('QML needs PySide6')"), True)
    write = "(field, text) => { field.value = text; field.dispatchEvent(new Event('input')); field.dispatchEvent(new Event('change')) }"
    browser.evaluate(f"(([name, data]) => {{ const write = {write}; write(name, 'turned'); write(data, '{{\"speed\": 3}}') }})([...{own}.querySelectorAll('input')])")
    browser.evaluate(f"{own}.querySelector('.ui-button').click()")
    sim.printed("event turned 3")


def texts_stay_texts(browser):
    lines = "[...document.querySelectorAll('.console-lines .text')].map(text => text.textContent)"
    same("a printed text", browser.evaluate(f"{lines}.includes('<img src=x onerror=hacked=1>')"), True)
    same("pictures", browser.evaluate("document.querySelectorAll('#app img').length"), 0)
    same("nothing ran", browser.evaluate("typeof hacked"), "undefined")


def keys_work(browser):
    press = "document.body.dispatchEvent(new KeyboardEvent('keydown', {{key: '{}', bubbles: true}}))"
    browser.evaluate(press.format("7"))
    browser.shows("swanilda.renderer.camera.pitch < -1.5", "from above")
    browser.evaluate(press.format("?"))
    browser.shows("document.querySelector('dialog.help').open", "the help")
    browser.evaluate("document.querySelector('dialog.help').close()")
    tree = "document.getElementById('tree')"
    browser.evaluate(f"{tree}.focus(); {tree}.dispatchEvent(new KeyboardEvent('keydown', {{key: 'Home'}}))")
    browser.shows(f"{tree}.getAttribute('aria-activedescendant')", "the tree's row")


def panels_close_where_a_window_is_made_narrow(browser):
    panels = "['side', 'console'].map(name => document.getElementById(name).hidden).join()"
    same("wide", browser.evaluate(panels), "false,false")
    browser.command("Emulation.setDeviceMetricsOverride", width=360, height=640, deviceScaleFactor=1, mobile=True)
    browser.shows(f"{panels} == 'true,true'", "the scene alone")
    browser.command("Emulation.setDeviceMetricsOverride", width=1000, height=700, deviceScaleFactor=1, mobile=False)
    browser.shows(f"{panels} == 'false,false'", "the panels")


def fits_small_screens(browser):
    browser.command("Emulation.setDeviceMetricsOverride", width=360, height=640, deviceScaleFactor=1, mobile=True)
    browser.command("Page.reload")
    browser.shows("globalThis.swanilda?.store.objects.size", "the page")
    same("width", browser.evaluate("document.documentElement.scrollWidth"), 360)
    same("the scene", browser.evaluate("document.getElementById('scene').clientWidth"), 360)
    buttons = "[...document.querySelectorAll('#bar button')].every(button => button.getBoundingClientRect().right <= 360)"
    same("the bar", browser.evaluate(buttons), True)


def console_has_no_errors(browser):
    errors = [event["params"]["entry"] for event in browser.events if event["method"] == "Log.entryAdded" and event["params"]["entry"]["level"] == "error"]
    same("errors in the browser's console", errors, [])


def notices_the_end(browser, sim):
    sim.process.kill()
    browser.shows("document.getElementById('notice').textContent.startsWith('The simulator has')", "the notice")


def says_nothing(browser):
    said = ("Runtime.exceptionThrown", "Page.javascriptDialogOpening")
    same("exceptions", [event for event in browser.events if event["method"] in said], [])


def main():
    scene = str(FOLDER / "view_scene.lua")
    with Simulator(scene, "--paused", "--no-open", "--empty", "-D", "python=/nowhere/python3", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        page_opens(browser, sim)
        looks_as_before(browser)
        is_accessible(browser)
        orbits_about_what_is_under_the_pointer(browser)
        selects_both_ways(browser, sim)
        edits_properties(browser)
        steps_plays_and_stops(browser)
        console_filters(browser)
        windows_of_scripts_are_forms(browser)
        interfaces_in_qml_show_their_source(browser, sim)
        texts_stay_texts(browser)
        keys_work(browser)
        is_accessible(browser)
        panels_close_where_a_window_is_made_narrow(browser)
        fits_small_screens(browser)
        console_has_no_errors(browser)
        notices_the_end(browser, sim)
        says_nothing(browser)


main()
