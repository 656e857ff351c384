"""Ways to look at the scene, by mouse and keyboard: directions, two views, distances, paths, forces."""

import sys

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import box, click, drag, found, key, middle, press, run, with_text
from simulator import Simulator

CODE = """
function made(handle, name, parent) sim.setObjectAlias(handle, name) if parent then sim.setObjectParent(handle, parent, true) end return handle end
one = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2}), 'one')
two = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.2, 0.2, 0.2}), 'two')
sim.setObjectPosition(one, {0, 0, 0.1}) sim.setObjectPosition(two, {0.6, 0.8, 0.1})
joint = made(sim.createJoint(sim.joint_revolute, sim.jointmode_dynamic, 0), 'joint', one)
sim.setObjectPose(joint, {-0.5, 0, 1, math.sin(math.pi / 4), 0, 0, math.cos(math.pi / 4)})
bob = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}), 'bob', joint)
sim.setObjectPosition(bob, {-0.1, 0, 1}) sim.setBoolProperty(bob, 'dynamic', true) sim.setShapeMass(bob, 1)
sim.setIntProperty(joint, 'dynCtrlMode', sim.jointdynctrl_velocity) sim.setFloatProperty(joint, 'targetForce', 2)
"""
HANDLE = "[...swanilda.store.objects.values()].find(object => object.alias == '{}').handle"
PLACE = "(() => {{ const p = swanilda.renderer.screenPosition(swanilda.store.poses.get({})), c = swanilda.renderer.canvas.getBoundingClientRect(); return [p[0] + c.left, p[1] + c.top] }})()"
ANGLES = "[Math.atan2(Math.sin({0}.yaw), Math.cos({0}.yaw)), {0}.pitch].map(x => Math.round(x * 100) / 100 + 0).join()"
STILL = "swanilda.renderer.camera.motion === null"


def place(browser, name):
    browser.shows(STILL, "the camera")
    return browser.evaluate(PLACE.format(HANDLE.format(name)))


def directions_are_buttons_and_keys(browser):
    press(browser, "#bar [title='Options of the view']")
    for name, angles in (("Back", "0,0"), ("Left", "-1.57,0"), ("Top", "1.57,-1.57"), ("Front", "3.14,0")):
        click(browser, middle(browser, with_text(".presets button", name)))
        browser.shows(f"{ANGLES.format('swanilda.renderer.camera')} == '{angles}'", name)
    press(browser, "#bar [title='Options of the view']")
    browser.evaluate("document.activeElement.blur()")
    for held, angles in ((["Shift"], "-1.57,0"), ([], "1.57,0")):
        browser.command("Input.dispatchKeyEvent", type="rawKeyDown", key="#" if held else "3", code="Digit3", windowsVirtualKeyCode=51, modifiers=8 if held else 0)
        browser.shows(f"{ANGLES.format('swanilda.renderer.camera')} == '{angles}'", f"3 with {held}")
    letter = with_text(".axes text", "Z")
    click(browser, middle(browser, letter))
    browser.shows("swanilda.renderer.camera.pitch < -1.5", "the letter of an axis: from above")
    click(browser, middle(browser, letter))
    browser.shows("swanilda.renderer.camera.pitch > 1.5", "from below")
    key(browser, "Home")
    press(browser, "#bar [title='Options of the view']")
    click(browser, middle(browser, with_text(".presets button", "Home")))
    browser.shows(f"{ANGLES.format('swanilda.renderer.camera')} == '-0.95,-0.42' && {STILL}", "home")
    press(browser, "#bar [title='Options of the view']")
    browser.evaluate("document.activeElement.blur()")


def distances_are_measured(browser):
    key(browser, "7")
    browser.shows("swanilda.renderer.camera.pitch < -1.5", "from above")
    ends = [place(browser, name) for name in ("one", "two")]
    key(browser, "y")
    for end in ends:
        click(browser, end)
    browser.shows("!document.querySelector('.measure').hidden", "the distance")
    words = browser.evaluate("document.querySelector('.measure strong').textContent")
    same(f"about a metre: {words}", abs(float(words.split()[0]) - 1) < 0.05, True)
    same("nothing is selected", browser.evaluate("swanilda.store.selection.length"), 0)
    same("the parts", browser.evaluate("document.querySelectorAll('.measure span').length"), 3)
    key(browser, "Escape")
    same("the end", browser.evaluate("document.querySelector('.measure').hidden"), True)
    browser.evaluate(f"swanilda.select({HANDLE.format('one')}); swanilda.select({HANDLE.format('two')}, true)")
    key(browser, "y")
    browser.shows("document.querySelector('.measure').textContent == '1.0000 mdx 0.6000 mdy 0.8000 mdz 0.0000 m'", "between two that are selected")
    run(browser, "sim.setObjectPosition(two, {0, 0.5, 0.1})")
    browser.shows("document.querySelector('.measure strong').textContent == '0.5000 m'", "it follows them")
    key(browser, "Escape")
    browser.evaluate("swanilda.select(-1)")


def two_views_stand_side_by_side(browser):
    width = browser.evaluate("swanilda.renderer.canvas.clientWidth")
    key(browser, "v")
    browser.shows(f"document.querySelector('.second').clientWidth > {0.45 * width} && swanilda.renderer.canvas.clientWidth < {0.55 * width}", "half of the width each")
    same("pictures differ", browser.evaluate("""new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => {
        const pixels = canvas => { const copy = new OffscreenCanvas(64, 64).getContext('2d'); copy.drawImage(canvas, 0, 0, 64, 64); return [...copy.getImageData(0, 0, 64, 64).data] };
        swanilda.renderer.stale = true; swanilda.renderer.frame(0);
        const [a, b] = [pixels(swanilda.renderer.canvas), pixels(document.querySelector('.second'))];
        done(new Set(b).size > 20 && a.some((x, i) => Math.abs(x - b[i]) > 40)) })))"""), True)
    main = browser.evaluate(ANGLES.format("swanilda.renderer.camera"))
    start = middle(browser, found(".second"))
    before = browser.evaluate(ANGLES.format("swanilda.sights.second.camera"))
    drag(browser, start, (60, 20))
    same("the second turned", browser.evaluate(ANGLES.format("swanilda.sights.second.camera")) != before, True)
    key(browser, "1")
    browser.shows(f"{ANGLES.format('swanilda.sights.second.camera')} == '3.14,0'", "keys are about the view that was touched")
    same("the first stays", browser.evaluate(ANGLES.format("swanilda.renderer.camera")), main)
    key(browser, "f")
    browser.shows("swanilda.sights.second.camera.motion === null", "everything")
    at = browser.evaluate(f"""(() => {{ const second = swanilda.sights.second, c = second.canvas.getBoundingClientRect();
        const p = second._as(renderer => (renderer.matrices = second.camera.matrices(second.aspect, 100), renderer.screenPosition(swanilda.store.poses.get({HANDLE.format('one')})))); return [p[0] + c.left, p[1] + c.top] }})()""")
    click(browser, at)
    browser.shows(f"swanilda.store.selection.length == 1", "a click selects there, too")
    key(browser, "v")
    browser.shows(f"swanilda.renderer.canvas.clientWidth == {width}", "one view")


def option(browser, text):
    press(browser, "#bar [title='Options of the view']")
    click(browser, middle(browser, f"[...document.querySelectorAll('.menu .choice')].find(label => label.textContent == '{text}')"))
    press(browser, "#bar [title='Options of the view']")
    browser.evaluate("document.activeElement.blur()")


def paths_and_forces_are_drawn(browser):
    browser.evaluate(f"swanilda.select({HANDLE.format('bob')})")
    option(browser, "Paths of what is selected")
    option(browser, "Forces of joints as colours")
    key(browser, " ")
    browser.shows(f"swanilda.sights.trails.paths.get({HANDLE.format('bob')})?.length > 5 && swanilda.sights.trails.lines.records.count > 4", "the path")
    browser.shows("parseFloat(document.querySelector('.torques span:last-child').textContent) > 0.1", "the legend")
    painted = f"(slot => [...swanilda.renderer.slots.data.slice(slot * 24 + 12, slot * 24 + 15)])(swanilda.renderer.view.entries.get({HANDLE.format('joint')}).parts[0].slot)"
    browser.shows(f"(([r, g, b]) => Math.abs(r - b) > 0.1)({painted})", "the colour")
    option(browser, "Forces of joints as colours")
    browser.shows("document.querySelector('.torques').hidden", "without")
    option(browser, "Paths of what is selected")
    same("no path", browser.evaluate("swanilda.sights.trails.lines.records.count"), 0)
    key(browser, " ", "Shift")


def contacts_are_arrows(browser):
    option(browser, "Contacts and forces")
    browser.evaluate("swanilda.store.contacts = [{handles: [0, 1], point: [0, 0, 0], normal: [0, 0, 1], force: [0, 0, 20]}]; swanilda.renderer.drawings.contactsChanged()")
    same("shafts and heads", browser.evaluate("swanilda.renderer.drawings.contacts.records.count"), 10)
    option(browser, "Contacts and forces")


def main():
    with Simulator("--empty", "--paused", "--no-open", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=900, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")
        run(browser, CODE)
        browser.shows("swanilda.store.objects.size >= 4", "the objects")
        browser.evaluate("swanilda.fit([])")
        directions_are_buttons_and_keys(browser)
        distances_are_measured(browser)
        two_views_stand_side_by_side(browser)
        paths_and_forces_are_drawn(browser)
        contacts_are_arrows(browser)
        press(browser, "#bar [title='Options of the view']")
        is_accessible(browser)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
