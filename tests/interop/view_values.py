"""Values of the selected object, by mouse and keyboard: the pose, what matters for a type, units, numbers that are dragged."""

import json
import math
import sys

from browser import WITH_WEBGL, Browser, program
from compare import same
from hands import box, click, drag, found, key, middle, run, type_text
from simulator import Simulator

CODE = """
function made(handle, name, parent) sim.setObjectAlias(handle, name) if parent then sim.setObjectParent(handle, parent, true) end return handle end
base = made(sim.createDummy(0.1), 'base')
sim.setObjectPose(base, {1, 2, 0, 0, 0, math.sin(math.pi / 4), math.cos(math.pi / 4)})
crate = made(sim.createPrimitiveShape(sim.primitiveshape_cuboid, {0.4, 0.3, 0.2}), 'crate', base)
sim.setObjectPosition(crate, {1, 2.5, 0.5})
turn = made(sim.createJoint(sim.joint_revolute, sim.jointmode_kinematic, 0), 'turn')
slide = made(sim.createJoint(sim.joint_prismatic, sim.jointmode_kinematic, 0), 'slide')
sim.setObjectPosition(turn, {-1, 0, 0}) sim.setObjectPosition(slide, {-1, 1, 0})
"""
COUNT = "(send => { globalThis.sets = 0; swanilda.source._send = (action, ...rest) => { if (action == 'set') sets++; return send.call(swanilda.source, action, ...rest) } })(swanilda.source._send)"


def number(browser, code):
    return float(run(browser, code))


def near(what, actual, expected, by=1e-9):
    if abs(actual - expected) > by:
        sys.exit(f"{what}: {actual!r} instead of {expected!r}")


def choose(browser, name):
    browser.evaluate(f"swanilda.select([...swanilda.store.objects.values()].find(object => object.alias == '{name}').handle)")
    browser.shows(f"{found('.inspected')}.textContent == '{name}' && {found('.essentials [data-name=alias] input')}?.value == '{name}'", name)


def fill(browser, element, text):
    """Types a value into a field in place of what is there."""
    browser.evaluate(f"{element}.scrollIntoView({{block: 'nearest'}})")
    click(browser, middle(browser, element))
    browser.evaluate(f"{element}.select()")
    type_text(browser, text)
    key(browser, "Enter")


def pose_field(name):
    return found(f".pose-block input[aria-label={name}]")


def pick(browser, label, value):
    """Another entry of a list, by keys."""
    element = found(f"select[aria-label='{label}']")
    browser.evaluate(f"(list => {{ list.value = '{value}'; list.dispatchEvent(new Event('change', {{bubbles: true}})) }})({element})")


def poses_in_the_world_and_beside_the_parent(browser):
    choose(browser, "crate")
    same("first the pose", browser.evaluate(f"{found('.properties')}.firstElementChild.className"), "pose-block")
    same("in the world", browser.evaluate(f"['x', 'y', 'z', 'gamma'].map(name => document.querySelector(`.pose-block [aria-label=${{name}}]`).value)"), ["1.0000", "2.5000", "0.5000", "0.00"])
    fill(browser, pose_field("y"), "2.75")
    browser.shows(f"Math.abs(swanilda.store.poses.get({int(number(browser, 'crate'))})[1] - 2.75) < 1e-6", "it is there")
    near("y of the world", number(browser, "sim.getObjectPosition(crate)[2]"), 2.75)
    near("x stays", number(browser, "sim.getObjectPosition(crate)[1]"), 1)
    pick(browser, "Frame of the pose", "parent")
    browser.shows("['x', 'z'].map(name => document.querySelector(`.pose-block [aria-label=${name}]`).value).join() == '0.7500,0.5000'", "beside the parent")
    fill(browser, pose_field("x"), "0.5")
    browser.shows("true", "the answer")
    near("x beside the parent", number(browser, "sim.getObjectPosition(crate, base)[1]"), 0.5)
    near("y of the world", number(browser, "sim.getObjectPosition(crate)[2]"), 2.5)
    pick(browser, "Frame of the pose", "world")


def rotations_as_angles_and_quaternions(browser):
    fill(browser, pose_field("beta"), "100")
    fill(browser, pose_field("alpha"), "30")
    shown = f"['alpha', 'beta', 'gamma'].map(name => document.querySelector(`.pose-block [aria-label=${{name}}]`).value).join()"
    browser.shows(f"{shown} == '30.00,100.00,0.00'", "the angles as they were entered")
    expected = run(browser, "m = sim.buildMatrix({0, 0, 0}, {math.rad(30), math.rad(100), 0}) n = sim.getObjectMatrix(crate) d = 0 for _, i in ipairs({1, 2, 3, 5, 6, 7, 9, 10, 11}) do d = math.max(d, math.abs(m[i] - n[i])) end print(d)")
    near("the rotation", float(expected), 0)
    pick(browser, "Rotation as", "quaternion")
    browser.shows(f"!!{pose_field('qw')}", "the quaternion")
    near("qw", float(browser.evaluate(f"{pose_field('qw')}.value")), math.cos(math.pi / 12) * math.cos(math.pi / 3.6), 1e-4)
    pick(browser, "Rotation as", "euler")
    pick(browser, "Angles", "radians")
    browser.shows(f"{pose_field('alpha')}.value == '0.5236'", "in radians")
    browser.command("Page.reload")
    browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")
    choose(browser, "crate")
    browser.shows(f"{pose_field('alpha')}.value == '-2.6180'", "the choice is kept, what was entered is not")
    pick(browser, "Angles", "degrees")


def what_matters_comes_first(browser):
    names = "[...document.querySelectorAll('.essentials .property')].map(row => row.dataset.name)"
    same("of a shape", browser.evaluate(names), ["alias", "applyColor.diffuse", "size", "mass", "dynamic", "respondable"])
    same("its size", browser.evaluate("[...document.querySelectorAll('.essentials [data-name=size] input')].map(field => field.value).join()"), "0.4,0.3,0.2")
    last = browser.evaluate("[...document.querySelectorAll('details.group')].slice(-3).map(group => [group.firstChild.textContent, group.open])")
    same("last", last, [["model", False], ["moving by mouse", False], ["settings of physics engines", False]])
    inert = "document.querySelector('[data-name=\"ode.softCfm\"] .unit')?.textContent ?? [...document.querySelectorAll('[data-name^=\"ode.\"] .unit')].map(unit => unit.textContent).join()"
    same("without effect", "no effect" in browser.evaluate(inert), True)
    unit = found("[data-name='ode.friction'] .unit")
    same("with effect", browser.evaluate(f"{unit}.textContent"), "")
    color = found(".essentials [data-name='applyColor.diffuse'] input")
    browser.evaluate(f"{color}.value = '#ff0000'; {color}.dispatchEvent(new Event('change'))")
    same("the colour", json.loads(run(browser, "_, c = sim.getShapeColor(crate, nil, sim.colorcomponent_ambient_diffuse) print('[' .. table.concat(c, ', ') .. ']')")), [1, 0, 0])


def units_are_those_of_the_joint(browser):
    units = "['jointPosition', 'targetVel', 'targetForce'].map(name => document.querySelector(`[data-name=${name}] .unit`).textContent)"
    choose(browser, "turn")
    same("revolute", browser.evaluate(units), ["°", "°/s", "N m"])
    fill(browser, found("[data-name=jointPosition] input"), "90")
    near("the position", number(browser, "sim.getJointPosition(turn)"), math.pi / 2, 1e-6)
    choose(browser, "slide")
    same("prismatic", browser.evaluate(units), ["m", "m/s", "N"])


def numbers_change_by_keys_and_dragging(browser):
    choose(browser, "slide")
    browser.evaluate(COUNT)
    field = found("[data-name=jointPosition] input")
    click(browser, middle(browser, field))
    key(browser, "ArrowUp", "Shift")
    key(browser, "ArrowDown")
    key(browser, "ArrowUp", "Alt")
    browser.shows(f"sets == 3 && {field}.value == '0.0910'", "keys")
    near("the position", number(browser, "sim.getJointPosition(slide)"), 0.091)
    label = found("[data-name=jointPosition] .label")
    drag(browser, middle(browser, label), (20, 0))
    browser.shows(f"{field}.value == '0.2910'", "the label was dragged")
    near("the position", number(browser, "sim.getJointPosition(slide)"), 0.291)
    same("one change", browser.evaluate("sets"), 4)
    click(browser, middle(browser, field))
    browser.command("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowUp", code="ArrowUp", windowsVirtualKeyCode=38)
    key(browser, "Escape")
    same("Escape takes it back", browser.evaluate(f"{field}.value + ' ' + sets"), "0.2910 4")


def long_numbers_are_not_cut(browser):
    """Fewer figures where there is no room, and all of them in the title and while the field is edited."""
    run(browser, "sim.setFloatArrayProperty(turn, 'maxVelAccelJerk', {25000.125, -123456.75, 1e-7}) sim.setObjectPosition(turn, {-12345678.25, 2500.5, 0})")
    choose(browser, "turn")
    browser.evaluate("document.querySelectorAll('.properties details').forEach(group => (group.open = true))")
    fields = "[...document.querySelectorAll('.properties input.number[inputmode], .pose-block input')].filter(field => field.offsetWidth)"
    browser.shows(f"{fields}.length > 40 && {fields}.every(field => field.scrollWidth <= field.clientWidth)", "all figures that are shown")
    off = f"{fields}.filter(field => Math.abs(Number(field.value) - parseFloat(field.title || field.value)) > 0.06 * Math.abs(Number(field.value)))"
    same("what is shown as another number", browser.evaluate(f"{off}.filter(field => Math.abs(parseFloat(field.title)) > 1e-3).map(field => [field.value, field.title])"), [])
    x = pose_field("x")
    short, title = browser.evaluate(f"[{x}.value, {x}.title]")
    near("x of the pose", float(short), -12345678.25, 1e5)
    same("its title", title, "-12345678.25 m")
    same("y of the pose", browser.evaluate(f"[Number({pose_field('y')}.value), {pose_field('y')}.title]"), [2500.5, ""])
    click(browser, middle(browser, x))
    same("x while it is edited", browser.evaluate(f"{x}.value"), "-1.2346e+7")
    key(browser, "Escape")
    same("afterwards", browser.evaluate(f"{x}.value"), short)


def main():
    with Simulator("--empty", "--paused", "--no-open", command="view") as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=1000, deviceScaleFactor=1, mobile=False)
        browser.open(sim.line(lambda line: line["type"] == "viewing", "the address")["url"])
        browser.shows("globalThis.swanilda?.store.connection.state == 'open' && swanilda.renderer.matrices", "the page")
        run(browser, CODE)
        browser.shows("swanilda.store.objects.size >= 4", "the objects")
        poses_in_the_world_and_beside_the_parent(browser)
        rotations_as_angles_and_quaternions(browser)
        what_matters_comes_first(browser)
        units_are_those_of_the_joint(browser)
        numbers_change_by_keys_and_dragging(browser)
        long_numbers_are_not_cut(browser)
        same("exceptions", [event for event in browser.events if event["method"] == "Runtime.exceptionThrown"], [])


main()
