"""What lies over and beside the scene, by mouse and keyboard: keys after a click in the tree, windows, notices, sizes of panels."""

import os
import sys

from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import box, click, drag, found, key, middle, press, run, with_text
from simulator import Simulator

CODE = """
simUI = require 'simUI'
simUI.create('<ui title="Arms &amp;&amp; legs"><label text="Arms &amp;&amp; legs"/><button text="&amp;Open &amp;&amp; close"/><label text="other"/></ui>')
eye = sim.createVisionSensor(0, {32, 16, 0, 0}, {0.01, 5, 1, 0.05, 0, 0, 0, 0, 0, 0, 0})
sim.adjustView(sim.floatingViewAdd(0.9, 0.9, 0.25, 0.25, 0), eye, 0, 'Eyes && ears')
sim.setObjectAlias(sim.createDummy(0.1), 'dot')
"""
WINDOW = "[data-window]:not([data-window^='2DElement'])"
AXES = found(".axes")


def overlap(a, b):
    return all(a[k] < b[k] + b[k + 2] and b[k] < a[k] + a[k + 2] for k in (0, 1))


def keys_work_after_a_click_in_the_tree(browser):
    run(browser, CODE)
    row = with_text("#tree .name", "dot")
    browser.shows(f"!!{row}", "the row")
    click(browser, middle(browser, row))
    browser.shows("swanilda.store.objects.get(swanilda.store.selection[0])?.alias == 'dot'", "the selection")
    same("the focus", browser.evaluate("document.activeElement.id"), "tree")
    key(browser, "c")
    browser.shows("document.getElementById('console').hidden", "C")
    key(browser, "c")
    key(browser, "l")
    browser.shows("swanilda.followed?.handle == swanilda.store.selection[0]", "L")
    key(browser, "d")
    browser.shows("document.documentElement.dataset.theme == 'dark'", "D")
    key(browser, "d")
    distance = browser.evaluate("swanilda.renderer.camera.distance")
    key(browser, "f")
    browser.shows(f"swanilda.renderer.camera.distance != {distance}", "F")
    key(browser, " ")
    browser.shows("swanilda.store.scene.state == 'running'", "Space")
    key(browser, " ", "Shift")
    browser.shows("swanilda.store.scene.state == 'stopped'", "Shift and Space")
    key(browser, " ", "Control")
    browser.shows("swanilda.store.selection.length == 0", "Ctrl and Space take the row out")
    click(browser, middle(browser, found("#tree")))
    key(browser, "t")
    browser.shows("document.getElementById('side').hidden", "T")
    browser.evaluate("swanilda.showPanel('side', true)")


def titles_are_there_once(browser):
    browser.shows(f"{found(WINDOW + ' h2')}?.textContent == 'Arms & legs'", "the title")
    shown = f"[...document.querySelectorAll(\"{WINDOW} .widget\")].filter(each => each.offsetWidth && getComputedStyle(each).visibility == 'visible').map(each => each.textContent)"
    same("what is in it", browser.evaluate(shown), ["Open & close", "other"])
    browser.shows(f"{found('[data-view] h2')}?.textContent == 'Eyes & ears'", "the view's title")


def the_axes_stay_free(browser):
    axes = box(browser, AXES)
    for selector in (WINDOW, "[data-view]"):
        same(f"{selector} covers the axes", overlap(box(browser, found(selector)), axes), False)


def frames_are_moved_folded_and_closed(browser, selector, name, by=(-150, 60)):
    before = box(browser, found(selector))
    drag(browser, [before[0] + 40, before[1] + 12], by)
    after = box(browser, found(selector))
    same(f"{name} was dragged", [round(after[k] - before[k]) for k in (0, 1)], list(by))
    key(browser, "ArrowLeft")  # what was dragged has the focus
    browser.shows(f"{found(selector)}.getBoundingClientRect().left < {after[0]}", "it moves by keys")
    same(f"{name}, what moves it", browser.evaluate("[document.activeElement.tagName, document.activeElement.getAttribute('aria-label')]"), ["BUTTON", f"Move {name}"])
    press(browser, f"{selector} .window-fold")
    browser.shows(f"{found(selector)}.getBoundingClientRect().height < 50", "it is folded")
    press(browser, f"{selector} .window-fold")
    browser.shows(f"Math.abs({found(selector)}.getBoundingClientRect().height - {after[3]}) < 1", "it is not")
    press(browser, f"{selector} [title=Close]")
    browser.shows(f"{found(selector)}.hidden", "it is closed")
    press(browser, "#bar [title='Options of the view']")
    button = with_text(".shelf button", f"Show {name}")
    click(browser, middle(browser, button))
    browser.shows(f"!{found(selector)}.hidden", "it is back")
    key(browser, "Escape")
    press(browser, "#bar [title='Options of the view']") if not browser.evaluate("swanilda.layout.menu.hidden") else None


def a_hang_is_said(browser):
    """A script that does not end: the sentence, and a button that ends it."""
    browser.evaluate("void swanilda.source.request('run', {code: 'while true do end'}).catch(() => {})")
    browser.shows("/running for|does not/.test(document.getElementById('notice').textContent)", "the sentence")
    press(browser, "#notice button")
    browser.shows("!document.getElementById('notice').textContent.includes('running for')", "the end")
    same("it goes on", browser.evaluate("swanilda.source.request('run', {code: '1 + 1'})"), "2")


def loading_is_said(browser):
    same("from the first moment", browser.evaluate("fetch('.').then(reply => reply.text()).then(text => text.includes('>Loading…<'))"), True)
    browser.evaluate("swanilda.renderer.resources.running++")
    browser.shows("document.getElementById('notice').textContent.startsWith('Loading meshes')", "the meshes")
    browser.evaluate("swanilda.renderer.resources.running--")
    browser.shows("!document.getElementById('notice').textContent.startsWith('Loading')", "the end")


def old_windows_too(browser):
    panel = "[data-window^='2DElement']"
    frames_are_moved_folded_and_closed(browser, panel, "Controls", (-450, 10))
    same("labels", browser.evaluate(f"[...document.querySelectorAll(\"{panel} .ui-label\")].map(label => label.textContent)"), ["a label & more"])


def panels_change_their_size(browser):
    """By dragging and by keys, and they remember it."""
    for panel, by, size in (("side", (90, 0), "offsetWidth"), ("console", (0, -70), "offsetHeight")):
        border, now = found(f"#{panel} .border"), f"document.getElementById('{panel}').{size}"
        before = browser.evaluate(now)
        drag(browser, middle(browser, border), by)
        same(f"{panel} is larger", browser.evaluate(now) - before, abs(sum(by)))
        same("it says so", browser.evaluate(f"{border}.ariaValueNow"), str(browser.evaluate(now)))
        browser.evaluate(f"{border}.focus()")
        key(browser, "ArrowLeft" if panel == "side" else "ArrowDown")
        same("by keys", browser.evaluate(now) - before, abs(sum(by)) - 16)
    sizes = "document.getElementById('side').offsetWidth + ' ' + document.getElementById('console').offsetHeight"
    before = browser.evaluate(sizes)
    browser.command("Page.reload")
    browser.shows(f"globalThis.swanilda?.store.connection.state == 'open' && {sizes} == '{before}'", "the sizes are kept")


def opened(browser, sim):
    browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
    browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")


def main():
    with Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)
        with Simulator(sys.argv[2], "--paused", "--no-open", command="view") as sim:
            opened(browser, sim)
            keys_work_after_a_click_in_the_tree(browser)
            titles_are_there_once(browser)
            the_axes_stay_free(browser)
            frames_are_moved_folded_and_closed(browser, WINDOW, "Arms & legs", (-500, 200))
            old_windows_too(browser)
            frames_are_moved_folded_and_closed(browser, "[data-view]", "Eyes & ears")
            loading_is_said(browser)
            panels_change_their_size(browser)
        # What a person ended does not end by itself when it is replayed.
        with Simulator("--empty", "--paused", "--no-open", "--capture", os.devnull, command="view") as sim:
            opened(browser, sim)
            a_hang_is_said(browser)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
