"""The page of the viewer as a studio: a robot is built by mouse and keys, run, pushed, saved, and run again without the page."""

import base64
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

from websockets.sync.client import connect

from access import is_accessible
from browser import WITH_WEBGL, Browser, program
from compare import same
from simulator import Simulator
from studio_page import ALIASES, CTRL, Page

STATE = "swanilda.store.scene.state"


def near(what, values, wanted, tolerance):
    same(f"{what}: {values}", all(abs(a - b) < tolerance for a, b in zip(values, wanted)), True)


def gizmo_moves_and_turns(page, box):
    page.focus_scene()
    page.key("m")
    grip = "document.querySelector('[data-handle=\"move x\"]')"
    page.shows(f"{grip}.getAttribute('d')", "the gizmo")
    is_accessible(page.browser)
    page.key("a")
    page.shows("!document.querySelector('.add-panel').hidden", "the menu")
    is_accessible(page.browser)
    page.key("Escape")
    page.evaluate("swanilda.lookAlong(Math.PI / 2, -Math.PI / 2)")
    page.rests()
    for _ in range(6):
        page.key("-")
    page.rests()
    x, y = page.place(box)
    before = page.pose(box)
    ahead = page.evaluate(f"swanilda.renderer.screenPosition([{before[0] + 0.4}, {before[1]}, {before[2]}])")
    here = page.evaluate(f"swanilda.renderer.screenPosition([{before[0]}, {before[1]}, {before[2]}])")
    along = [(b - a) for a, b in zip(here, ahead)]
    size = math.hypot(*along)
    start = [x + along[0] / size * 60, y + along[1] / size * 60]
    label = "document.querySelector('.gizmo-label:not([hidden])')?.textContent"

    def reads():
        same("the number", page.evaluate(label)[:5], "x 0.4")

    page.drag(start, [a + b for a, b in zip(start, along)], hold=reads)
    page.shows(f"Math.abs(swanilda.store.poses.get({box})[0] - {before[0] + 0.4}) < 0.01", "the move")
    near("only along x", page.pose(box)[1:3], before[1:3], 1e-6)
    page.rests()
    page.drag([a + b for a, b in zip(start, along)], [start[0] + along[0] * 0.33, start[1] + along[1] * 0.33], modifiers=CTRL)
    page.rests()
    near("in steps of 5 cm, from where it began", [page.pose(box)[0] - before[0]], [0.4 - 0.25], 0.011)
    turn(page, box)
    for _ in range(3):
        page.key("z", "Control")
    page.shows(f"Math.abs(swanilda.store.poses.get({box})[0] - {before[0]}) < 1e-6", "each drag is one step of undo")
    page.key("Escape")
    page.key("Escape")


def turn(page, box):
    page.key("r")
    ring = "document.querySelector('[data-handle=\"turn z\"]')"
    page.shows(f"{ring}.getAttribute('d')", "the ring")
    x, y = page.place(box)
    at = lambda angle: [x + 76 * math.cos(angle), y + 76 * math.sin(angle)]
    page.mouse("mousePressed", at(0), "left", 1)
    for i in range(1, 13):
        page.mouse("mouseMoved", at(-math.pi / 2 * i / 12), "left", 1)
    page.mouse("mouseReleased", at(-math.pi / 2), "left", 0)
    page.shows(f"Math.abs(Math.abs(swanilda.store.poses.get({box})[5]) - Math.SQRT1_2) < 0.02", "a quarter of a turn")


def tree_is_changed(page):
    """By the menu of a row, by dragging rows, with undo and redo."""
    page.add("Cuboid")
    page.rename("crate")
    page.add("Sphere")
    page.rename("ball")
    page.press(page.row("crate"))
    page.click(page.centre(page.row("crate")), button="right")
    page.press("[...document.querySelectorAll('.context-menu button')].find(item => item.textContent.startsWith('Duplicate'))")
    page.shows(f"{ALIASES}.length == 3", "the copy")
    page.key("z", "Control")
    page.shows(f"{ALIASES}.length == 2", "undo")
    page.key("z", "Control", "Shift")
    page.shows(f"{ALIASES}.length == 3", "redo")
    page.key("Delete")
    page.shows(f"{ALIASES}.join() == 'crate,ball'", "the copy is gone")
    page.drag_and_drop(page.centre(page.row("ball")), page.centre(page.row("crate")))
    named = "[...swanilda.store.objects.values()].find(object => object.alias == '{}')"
    page.shows(f"{named.format('ball')}.parent == {named.format('crate')}.handle", "the ball below the crate")
    page.select("crate")
    page.key("Delete")
    page.shows(f"{ALIASES}.length == 0", "it is gone with the ball")


def shapes_are_grouped(page):
    page.add("Cuboid")
    page.add("Cylinder")
    page.rename("lid")
    page.select("Cuboid", "lid")
    page.key("g", "Control")
    page.shows(f"{ALIASES}.length == 1", "the group")
    page.key("g", "Control", "Shift")
    page.shows(f"{ALIASES}.length == 2", "the parts")
    for _ in range(5):
        page.key("z", "Control")
    page.shows(f"{ALIASES}.length == 0", "nothing is left")


SCRIPT = """sim = require 'sim'

function sysCall_init()
    robot, nose = sim.getObject('..'), sim.getObject('../nose')
    motors = {sim.getObject('../leftMotor'), sim.getObject('../rightMotor')}
    backUntil = -1
end

function sysCall_actuation()
    local now = sim.getSimulationTime()
    if sim.readProximitySensor(nose) > 0 then backUntil = now + 1 end
    local isBack = now < backUntil
    sim.setJointTargetVelocity(motors[1], isBack and -3 or 4)
    sim.setJointTargetVelocity(motors[2], isBack and -1 or 4)
end

function sysCall_sensing()
    if sim.getSimulationTime() > 2.42 and not said then
        said = true
        local p = sim.getObjectPose(robot)
        print(string.format('at 2.45: %.9f %.9f %.9f', p[1], p[2], p[6]))
    end
end
"""


def builds_a_robot(page):
    """A BubbleRob: a body, two wheels with motors, a slider, a nose, a script; no file is written, and no line of code but that of the script."""
    page.evaluate("swanilda.fit([])")
    page.add("Plane")
    page.rename("floor")
    page.write_numbers("[data-name=size]", 5, 5)
    page.tick("dynamic", False)
    page.pose_is(0, 0, 0)
    wall = page.add("Cuboid")
    page.rename("wall")
    page.write_numbers("[data-name=size]", 0.1, 1, 0.4)
    page.tick("dynamic", False)
    page.pose_is(0.6, 0, 0.2)
    body = page.add("Sphere")
    page.rename("bubbleRob")
    page.write_numbers("[data-name=size]", 0.2, 0.2, 0.2)
    page.pose_is(0, 0, 0.12)
    for side, y in (("left", 0.12), ("right", -0.12)):
        wheel_with_motor(page, side, y)
    below(page, "bubbleRob", "Force sensor")
    page.rename("link")
    page.pose_is(-0.07, 0, 0.02)
    below(page, "link", "Sphere")
    page.rename("slider")
    page.write_numbers("[data-name=size]", 0.04, 0.04, 0.04)
    below(page, "bubbleRob", "Proximity sensor, cone")
    page.rename("nose")
    page.pose_is(0.11, 0, 0.12, 0, 90, 0)
    page.write_number("[data-name=volume_range] input", 0.25)
    page.select("bubbleRob")
    script = page.add("Simulation script")
    same("the script is below what was selected", page.evaluate(f"swanilda.store.objects.get({script}).parent"), body)
    types_the_script(page, script)
    return body


def types_the_script(page, script):
    """Into the editor, key by key: it indents, closes brackets, and offers names, which nobody takes."""
    page.evaluate(f"swanilda.openScript({script})")
    page.press("document.querySelector('#script [title=\"Change the text\"]:not([hidden])')")
    page.shows("!!swanilda.script.editing.editor", "the editor")
    page.press("document.querySelector('#script .cm-content, #script textarea')")
    page.key("a", "Control")
    lines = [line.strip() for line in SCRIPT.strip().splitlines()]
    for number, line in enumerate(lines):
        if number:
            page.key("Escape")
            page.key("Enter")
        for letter in line:
            page.key(letter)
    same("the text", [line.strip() for line in page.evaluate("swanilda.script.editing.draft.text").splitlines()], lines)
    page.key("s", "Control")
    page.shows("document.querySelector('.script-status').textContent == 'Saved'", "it is saved")
    is_accessible(page.browser)
    page.evaluate("swanilda.script.editing.discard(); swanilda.showPanel('script', false)")
    page.focus_scene()


def below(page, alias, kind):
    """A new object below another one."""
    page.select(alias)
    page.click(page.centre(page.row(alias)), button="right")
    page.press("[...document.querySelectorAll('.context-menu button')].find(item => item.textContent.startsWith('Add below'))")
    before = page.evaluate("swanilda.store.selection[0]")
    page.press(f"[...document.querySelectorAll('.add-menu button')].find(item => item.textContent == {json.dumps(kind)})")
    page.shows(f"swanilda.store.selection[0] != {before}", kind)
    page.rests()
    return page.evaluate("swanilda.store.selection[0]")


def wheel_with_motor(page, side, y):
    below(page, "bubbleRob", "Revolute joint")
    page.rename(f"{side}Motor")
    page.pose_is(0, y, 0.04, -90, 0, 0)
    page.choose("dynCtrlMode", "velocity")
    page.write_number("[data-name=targetForce] input", 5)
    below(page, f"{side}Motor", "Cylinder")
    page.rename(f"{side}Wheel")
    page.write_numbers("[data-name=size]", 0.08, 0.08, 0.03)


def said(page):
    """What the script of the robot has printed."""
    lines = "[...document.querySelectorAll('.console-lines .text')].map(text => text.textContent).filter(text => text.startsWith('at 2.45'))"
    page.shows(f"{lines}.length", "the robot's place")
    return page.evaluate(lines)[-1]


def it_is_run_and_pushed(page, body):
    page.focus_scene()
    page.key(" ")
    trajectory = said(page)
    page.key(" ")
    page.shows(f"{STATE} == 'paused'", "a pause")
    page.evaluate("swanilda.lookAlong(-0.95, -0.42)")  # the wall is behind the robot
    page.rests()
    page.key("f")
    page.rests()
    at = page.place(body)
    height = page.pose(body)[2]
    label = "document.querySelectorAll('.gizmo-label')[1]"
    lifted = []

    def pulls():
        page.shows(f"!{label}.hidden && {label}.textContent.endsWith(' N')", "the force")
        page.shows(f"swanilda.store.poses.get({body})[2] > {height} + 0.02", "it is lifted")
        lifted.append(page.evaluate(f"{label}.textContent"))

    page.key(" ")
    page.shows(f"{STATE} == 'running'", "it goes on")
    page.drag(at, [at[0], at[1] - 150], modifiers=CTRL, hold=pulls)
    same(f"a force: {lifted}", float(lifted[0].split()[0]) > 1, True)
    page.shows(f"swanilda.store.poses.get({body})[2] < {height} + 0.01", "it falls when it is let go")
    page.key(" ", "Shift")
    page.shows(f"{STATE} == 'stopped'", "the end")
    near("it is where it began", page.pose(body)[:3], [0, 0, 0.12], 1e-6)
    return trajectory


def save(page, path):
    """By the dialog; what it says of a file that is there."""
    page.key("s", "Control")
    page.shows("document.querySelector('dialog.save').open", "the dialog")
    is_accessible(page.browser)
    page.evaluate("document.querySelector('dialog.save input').select()")
    page.type(str(path))
    page.key("Enter")


def it_is_saved(page, path):
    open_ = "document.querySelector('dialog.save').open"
    save(page, path)
    page.shows(f"!{open_}", "it is saved")
    page.shows("swanilda.store.scene.changes === 0", "nothing is left to save")
    written = path.stat().st_mtime_ns
    save(page, path)
    page.shows("document.querySelector('.save-problem').textContent.endsWith('is there already.')", "the question")
    same("nothing was written", path.stat().st_mtime_ns, written)
    page.key("Enter")
    page.shows(f"!{open_}", "it is replaced")
    same("it was written", path.stat().st_mtime_ns > written, True)


def it_does_the_same_without_the_page(path, trajectory):
    run = subprocess.run([sys.argv[1], "run", str(path), "--time", "2.6"], capture_output=True, text=True, timeout=60)
    lines = [line for line in run.stdout.splitlines() if "at 2.45" in line]
    same("the trajectory", [line[line.index("at 2.45"):] for line in lines], [trajectory])
    numbers = [float(number) for number in trajectory.split(": ")[1].split()]
    same(f"it has met the wall, and turns: {trajectory}", 0.02 < numbers[0] < 0.4 and abs(numbers[2]) > 0.05, True)


def two_pages_build_at_once(page, address):
    """What one does stays when the other one does something; undo says whose change it was, and asks before it takes it back."""
    crate = page.add("Cuboid")
    height = page.pose(crate)[2]
    with connect(address.replace("http", "ws", 1) + "stream", origin=address.rsplit("/", 2)[0]) as other:
        request = {"id": 1, "do": "edit", "edit": "rename", "arguments": {"handle": crate, "alias": "theirs"}}
        other.send(json.dumps(request))
        page.shows(f"{ALIASES}.includes('theirs')", "the name of the other page")
        page.set_pose(crate, [1, 1, height + 1, 0, 0, 0, 1])
        same("both are there", page.evaluate(f"swanilda.store.objects.get({crate}).alias"), "theirs")
        page.key("z", "Control")
        page.shows(f"swanilda.store.poses.get({crate})[2] == {height}", "the move is undone")
        same("what would be undone", page.evaluate("swanilda.store.scene.undo"), "Rename Cuboid to theirs")
        page.shows("swanilda.studio.toolbar.undo.title == 'Undo: Rename Cuboid to theirs, of another page (Ctrl+Z)'", "whose it is")
        answers_undo(page, "Cancel")
        same("it was not undone", page.evaluate(f"swanilda.store.objects.get({crate}).alias"), "theirs")
        other.send(json.dumps({"id": 2, "do": "edit", "edit": "remove", "arguments": {"handles": [crate]}}))
        page.shows(f"!swanilda.store.objects.has({crate})", "it is gone")
        other.send(json.dumps({"id": 3, "do": "undo"}))
        page.shows(f"swanilda.store.objects.get({crate})?.alias == 'theirs'", "it is there again")
    answers_undo(page, "Undo")
    page.shows(f"{ALIASES}.includes('Cuboid')", "the old name")
    page.key("z", "Control")
    page.shows(f"{ALIASES}.length == 0", "an empty scene")


def answers_undo(page, answer):
    """To the question about what another page has done."""
    page.focus_scene()
    page.key("z", "Control")
    page.shows("document.querySelector('dialog.confirm')?.textContent.startsWith('Another page has done this: Rename Cuboid to theirs.')", "the question")
    page.press(f"[...document.querySelectorAll('dialog.confirm button')].find(button => button.textContent == '{answer}')")
    page.shows("document.querySelector('dialog.confirm') === null", "the answer")


def files_are_dropped(page):
    """A robot with its mesh, as a folder would bring them."""
    urdf = '<robot name="cart"><link name="base"><visual><geometry><mesh filename="meshes/part.stl"/></geometry></visual></link></robot>'
    stl = "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"
    files = {"cart/cart.urdf": urdf, "cart/meshes/part.stl": stl}
    made = ", ".join(f"[{json.dumps(name)}, new File([{json.dumps(text)}], 'x')]" for name, text in files.items())
    page.evaluate(f"swanilda.studio.files._load([{made}], [2, 1, 0])")
    page.shows(f"{ALIASES}.includes('base_visual')", "the robot")
    near("where it was dropped", page.pose(page.evaluate("swanilda.store.selection[0]"))[:2], [2, 1], 1e-6)
    page.evaluate("swanilda.studio.files._load([['notes.txt', new File(['x'], 'notes.txt')]])")
    page.shows("document.getElementById('notice').textContent.startsWith('None of these files')", "the sentence")
    page.key("z", "Control")
    page.shows(f"{ALIASES}.length == 0", "undo")


def shows_it(page):
    for path, colour in (("bubbleRob", "0.95, 0.55, 0.15"), ("bubbleRob/leftWheel", "0.25, 0.27, 0.3"), ("bubbleRob/rightWheel", "0.25, 0.27, 0.3"), ("wall", "0.45, 0.6, 0.75")):
        page.lua(f"sim.setShapeColor(sim.getObject('/{path}'), nil, sim.colorcomponent_ambient_diffuse, {{{colour}}})")
    page.select("bubbleRob")
    page.key("f")
    page.rests()
    page.evaluate("swanilda.lookAlong(2.4, -0.5)")
    page.focus_scene()
    page.key("m")
    picture(page, "studio.webp")
    page.key("Escape")


def picture(page, name):
    """For the documents: `PICTURES=docs/images`."""
    if folder := os.environ.get("PICTURES"):
        page.rests()
        data = page.browser.command("Page.captureScreenshot", format="webp", quality=85)["data"]
        pathlib.Path(folder, name).write_bytes(base64.b64decode(data))


def main():
    with Simulator("--paused", "--no-open", "--empty", command="view", replayed=False) as sim, Browser(program() or sys.exit("there is no Chromium"), WITH_WEBGL) as browser:
        for domain in ("Page", "Runtime", "Log"):
            browser.command(f"{domain}.enable")
        address = os.environ.get("PAGE") or sim.line(lambda line: line["type"] == "viewing", "the address")["url"]
        browser.command("Emulation.setDeviceMetricsOverride", width=1200, height=800, deviceScaleFactor=1, mobile=False)
        browser.open(address)
        page = Page(browser)
        page.shows("globalThis.swanilda?.studio.edits.possible", "the page")
        box = page.add("Cuboid")
        same("it stands on the ground", abs(page.pose(box)[2] - 0.05) < 1e-6, True)
        gizmo_moves_and_turns(page, box)
        page.key("z", "Control")
        page.shows(f"{ALIASES}.length == 0", "an empty scene")
        tree_is_changed(page)
        shapes_are_grouped(page)
        two_pages_build_at_once(page, address)
        files_are_dropped(page)
        body = builds_a_robot(page)
        shows_it(page)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "robot.ttt")
            trajectory = it_is_run_and_pushed(page, body)
            it_is_saved(page, path)
            it_does_the_same_without_the_page(path, trajectory)


main()
