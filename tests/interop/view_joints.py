"""The joints of a model as sliders, by mouse and keyboard."""

import math
import sys

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import box, click, drag, found, key, middle, run
from simulator import Simulator

CODE = """
function made(handle, name, parent, x) sim.setObjectAlias(handle, name) sim.setObjectParent(handle, parent, true) sim.setObjectPosition(handle, {x, 0, 0.5}) return handle end
arm = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.1, 0.1, 0.1}), 'arm', -1, 0)
sim.setModelProperty(arm, 0) sim.setObjectProperty(arm, 0) sim.setBoolProperty(arm, 'modelBase', true)
function joint(name, kind, mode, control, parent, x, low, range)
    local handle = made(sim.createJoint(kind, mode, 0), name, parent, x)
    sim.setJointInterval(handle, false, {low, range})
    if control then sim.setIntProperty(handle, 'dynCtrlMode', control) end
    local link = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.05, 0.05, 0.05}), name .. '_link', handle, x)
    sim.setShapeMass(link, 1) sim.setBoolProperty(link, 'dynamic', control ~= nil) sim.setBoolProperty(link, 'respondable', false)
    return handle, link
end
turn, link = joint('turn', sim.joint_revolute, sim.jointmode_kinematic, nil, arm, 0.2, -1, 2)
lift, link = joint('lift', sim.joint_prismatic, sim.jointmode_dynamic, sim.jointdynctrl_position, link, 0.4, 0, 0.5)
sim.setFloatProperty(lift, 'targetForce', 1000)
"""


def value(browser, code):
    return float(run(browser, code))


def near(what, actual, expected, by):
    if abs(actual - expected) > by:
        sys.exit(f"{what}: {actual!r} instead of {expected!r}")


def slider(browser, name):
    row = f"[...document.querySelectorAll('.joint')].find(row => row.querySelector('.joint-name').textContent == '{name}')"
    browser.shows(f"!!{row}", name)
    return f"{row}.querySelector('input')"


def place(browser, element, part):
    left, top, width, height = box(browser, element)
    return [left + 8 + (width - 16) * part, top + height / 2]


def a_model_shows_its_joints(browser):
    browser.evaluate("swanilda.select([...swanilda.store.objects.values()].find(object => object.alias == 'arm').handle)")
    lift = slider(browser, "lift")
    browser.shows(f"{lift}.ariaLabel == 'Target position of lift'", "what it is driven to")
    same("limits", browser.evaluate(f"[{lift}.min, {lift}.max].map(Number)"), [0, 0.5])
    same("one that nothing drives", browser.evaluate(f"{slider(browser, 'turn')}.ariaLabel"), "Position of turn")


def sliders_move_joints(browser):
    turn = slider(browser, "turn")
    browser.evaluate(f"{turn}.scrollIntoView({{block: 'nearest'}})")
    browser.evaluate("(send => { globalThis.gestures = []; swanilda.source._send = (action, members) => { if (action == 'set') gestures.push(members.gesture); return send.call(swanilda.source, action, members) } })(swanilda.source._send)")
    start = place(browser, turn, 0.5)
    drag(browser, start, [place(browser, turn, 0.75)[0] - start[0], 0])
    browser.shows(f"Math.abs({turn}.value - 0.5) < 0.03", "the slider")
    browser.shows(f"Math.abs(swanilda.store.objects.get({int(value(browser, 'turn'))}).jointPosition - {turn}.value) < 1e-6", "the joint")
    now = f"{turn}.closest('.joint').querySelector('output').textContent"
    degrees = math.degrees(value(browser, "sim.getJointPosition(turn)"))
    browser.shows(f"Math.abs(parseFloat({now}) - {degrees}) < 0.01", "in degrees")
    same("the unit", browser.evaluate(now).split()[1], "°")
    same("what is dragged at once is one change", browser.evaluate("new Set(gestures).size == 1 && gestures[0] > 0"), True)
    before = value(browser, "sim.getJointPosition(turn)")
    key(browser, "ArrowLeft")  # the slider has the focus
    browser.shows(f"{turn}.value < {before} - 0.01", "a key")
    browser.evaluate("document.activeElement.blur()")


def targets_are_followed_while_it_runs(browser):
    lift = slider(browser, "lift")
    browser.evaluate(f"{lift}.scrollIntoView({{block: 'nearest'}})")
    click(browser, place(browser, lift, 0.5))
    browser.shows(f"parseFloat({lift}.closest('.joint').querySelector('output').textContent) > 0.2", "it is there at once")
    near("while it stands", value(browser, "sim.getJointPosition(lift)"), 0.25, 0.03)
    browser.evaluate("document.activeElement.blur()")
    key(browser, " ")
    browser.shows("swanilda.store.scene.time > 0.2", "it runs")
    near("it stays", value(browser, "sim.getJointPosition(lift)"), 0.25, 0.04)
    click(browser, place(browser, lift, 0.8))
    near("the target", value(browser, "sim.getJointTargetPosition(lift)"), 0.4, 0.03)
    browser.shows(f"parseFloat({lift}.closest('.joint').querySelector('output').textContent) > 0.35", "it goes there")
    run(browser, "sim.setJointTargetPosition(lift, 0.1)")
    browser.evaluate("document.activeElement.blur()")
    browser.shows(f"Math.abs({lift}.value - 0.1) < 1e-6", "what scripts ask for is shown")


def main():
    with Simulator("--empty", "--paused", "--no-open", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=1000, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")
        run(browser, CODE)
        browser.shows("swanilda.store.objects.size >= 5", "the objects")
        a_model_shows_its_joints(browser)
        sliders_move_joints(browser)
        targets_are_followed_while_it_runs(browser)
        is_accessible(browser)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
