"""What scripts show to persons, in a headless Chromium: user interfaces of V-REP, dialogs, banners, floating views, scenes of simUI."""

import json
import sys

from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import Simulator

CODE = """
simUI = require 'simUI'
function report(...) print('got', ...) end
function ask()
    report(simUI.msgBox(simUI.msgbox_type.question, simUI.msgbox_buttons.yesnocancel, '<i>Home</i>?', 'now'))
    report(simUI.inputDialog('abc', 'Name', 'Run'))
    report(simUI.fileDialog(simUI.filedialog_type.load_multiple, 'Load', '/tmp', '', 'Lua', 'lua')[2])
    report(simUI.colorDialog({0.2, 0.4, 0.6}, 'Colour')[3])
    report(simUI.inputDialog('abc', 'Name', 'Again'))
end
function picked(ui, id, node) report('node', node) end
function answered(id, key) report('banner', key) simUI.bannerDestroy(id) end
simUI.bannerCreate('old <b>', {'a', 'b'}, {'Now', 'Later'}, 'answered')
simUI.create('<ui title="Solids"><scene3d id="1" on-click="picked"><camera position="0,0,6"/><entity><mesh-cuboid/>'
    .. '<material-phong diffuse="200,80,60"/><object-picker id="7"/></entity></scene3d><button text="Ask" on-click="ask"/></ui>')
sensor = sim.createVisionSensor(0, {32, 16, 0, 0}, {0.01, 5, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
local view = sim.floatingViewAdd(0.2, 0.2, 0.3, 0.3, 0)
sim.adjustView(view, sensor, 0, 'Eye')
ui = simGetUIHandle('Controls')
"""
SCRIPT = """
function sysCall_nonSimulation()
    local button, values = simGetUIEventButton(simGetUIHandle('Controls'))
    if button >= 0 then print('button', button, values[1] & 0x100, values[2], simGetUIButtonLabel(simGetUIHandle('Controls'), 4)) end
end
"""


def run(browser, code):
    return browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(code)}}})")


def click(browser, selector, text):
    found = f"[...document.querySelectorAll('{selector}')].find(element => element.textContent == {json.dumps(text)})"
    browser.shows(f"!!{found}", text)
    browser.evaluate(f"{found}.click()")


def place(browser, selector):
    return browser.evaluate(f"(({{left, top, width, height}}) => [left + width / 2, top + height / 2])(document.querySelector({json.dumps(selector)}).getBoundingClientRect())")


def mouse(browser, kind, at):
    browser.command("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button="left", clickCount=1)


def buttons_of_old_scenes(browser, sim):
    panel = "[data-window=\"2DElement-2060006\"]"
    browser.shows(f"document.querySelector('{panel} h2')?.textContent == 'Controls'", "the user interface")
    run(browser, f"sim.createScript(sim.scripttype_customization, [==[{SCRIPT}]==])")
    click(browser, f"{panel} button", "Start")
    sim.printed("button, 1, 0, 0, 0.5")
    at = place(browser, f"{panel} [data-widget='2']")
    mouse(browser, "mousePressed", at)
    sim.printed("button, 2, 256, 0, 0.5")
    mouse(browser, "mouseReleased", at)
    browser.shows(f"document.querySelector(`{panel} [data-widget='2']`)?.ariaPressed == 'true'", "the button stays down")
    field = f"document.querySelector('{panel} input[type=range]')"
    browser.evaluate(f"{field}.value = 250; {field}.dispatchEvent(new Event('input'))")
    sim.printed("button, 3, 0, 250, 0.5")
    field = f"document.querySelector('{panel} input[type=text]')"
    browser.evaluate(f"{field}.value = '0.75'; {field}.dispatchEvent(new Event('change'))")
    sim.printed("button, 4, 0, 0, 0.75")
    same("a label", browser.evaluate(f"[...document.querySelectorAll('{panel} .ui-label')].map(label => label.textContent)"), ["a label & more"])


def dialogs_wait_for_answers(browser, sim):
    dialog = "document.querySelector('dialog.question')"
    click(browser, ".window .ui-button", "Ask")
    browser.shows(f"{dialog}?.querySelector('h2').textContent == '<i>Home</i>?'", "the question")
    same("the focus", browser.evaluate("document.activeElement.textContent"), "Cancel")
    click(browser, "dialog.question button", "Yes")
    sim.printed("got, 2")
    browser.shows(f"{dialog}?.querySelector('input')?.value == 'abc'", "the entry")
    browser.evaluate(f"{dialog}.querySelector('input').value = '<b>x'")
    click(browser, "dialog.question button", "OK")
    sim.printed("got, <b>x")
    browser.shows(f"{dialog}?.querySelector('textarea')?.value == '/tmp'", "the files")
    browser.evaluate(f"{dialog}.querySelector('textarea').value = '/tmp/a.lua\\n/tmp/b.lua'")
    click(browser, "dialog.question button", "OK")
    sim.printed("got, /tmp/b.lua")
    browser.shows(f"{dialog}?.querySelector('input[type=color]')?.value == '#336699'", "the colour")
    click(browser, "dialog.question button", "OK")
    sim.printed("got, 0.6")
    browser.shows(f"{dialog}?.querySelector('h2').textContent == 'Again'", "the last one")
    browser.evaluate(f"{dialog}.dispatchEvent(new Event('cancel', {{cancelable: true}}))")
    sim.printed("got, nil")
    browser.shows(f"!{dialog}", "the end")


def banners_have_buttons(browser, sim):
    browser.shows("document.querySelector('.banner span')?.textContent == 'old <b>'", "the banner")
    click(browser, ".banner button", "Later")
    sim.printed("got, banner, b")
    browser.shows("!document.querySelector('.banner')", "no banner")


def solids_are_drawn_and_picked(browser, sim):
    canvas = "document.querySelector('.scene3d')"
    browser.shows(f"!!{canvas}", "the scene")
    colour = f"[...{canvas}.getContext('2d').getImageData(160, 120, 1, 1).data]"
    same("red in the middle", browser.evaluate(f"(([r, g, b]) => r > 80 && r > 1.5 * b)({colour})"), True)
    at = place(browser, ".scene3d")
    mouse(browser, "mousePressed", at)
    mouse(browser, "mouseReleased", at)
    sim.printed("got, node, 7")


MODEL = """
require 'configUi'
ConfigUI('Feeder', {speed = {type = 'float', name = 'Speed', default = 1, minimum = 0, maximum = 5}}, function(config) print('speed', config.speed) end)
"""


def models_open_their_settings(browser, sim):
    code = f"model = sim.createDummy(0.1) script = sim.createScript(sim.scripttype_customization, [==[{MODEL}]==]) sim.setObjectParent(script, model) sim.initScript(script)"
    run(browser, code + " sim.setObjectSel({model})")
    browser.shows("!!document.querySelector('.inspected-tools [title=\"Settings of the model\"]')", "the symbol")
    browser.evaluate("document.querySelector('.inspected-tools [title=\"Settings of the model\"]').click()")
    browser.shows("[...document.querySelectorAll('.window:not(.view) .ui-label')].some(label => label.textContent.startsWith('Speed'))", "the window")


def large_tables_have_few_rows(browser):
    run(browser, "big = simUI.create('<ui title=\"Big\"><table id=\"1\"/><tree id=\"2\"/></ui>') simUI.setColumnCount(big, 2, 1) simUI.addTreeItem(big, 2, 1, {'leaf'}, 0) simUI.setColumnCount(big, 1, 2) simUI.setRowCount(big, 1, 10000) "
        "simUI.setItem(big, 1, 0, 0, 'first') simUI.setItem(big, 1, 9999, 0, 'last')")
    rows = "[...document.querySelectorAll('[data-window] .ui-table td')].map(cell => cell.textContent)"
    browser.shows(f"{rows}.includes('first')", "the first row")
    same("few rows", browser.evaluate("document.querySelectorAll('[data-window] .ui-table tr').length < 200"), True)
    browser.evaluate("(scroller => scroller.scrollTop = scroller.scrollHeight)(document.querySelector('[data-window] .ui-table'))")
    browser.shows(f"{rows}.includes('last')", "the last row")
    same("a tree", browser.evaluate("[...document.querySelectorAll('[data-window] [role=treeitem]')].map(item => item.textContent)"), ["leaf"])


def views_show_sensors(browser):
    browser.shows("document.querySelector('[data-view] h2')?.textContent == 'Eye'", "the view")
    run(browser, "sim.handleVisionSensor(sensor)")
    browser.shows("(({width, height}) => width == 32 && height == 16)(document.querySelector('[data-view] canvas'))", "its image")


def main():
    with Simulator(sys.argv[2], "--paused", "--no-open", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open'", "the page")
        buttons_of_old_scenes(browser, sim)
        run(browser, CODE)
        banners_have_buttons(browser, sim)
        views_show_sensors(browser)
        solids_are_drawn_and_picked(browser, sim)
        dialogs_wait_for_answers(browser, sim)
        large_tables_have_few_rows(browser)
        models_open_their_settings(browser, sim)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
