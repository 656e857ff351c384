"""A page of the viewer as people use it to build: by mouse and keys."""

import json

from hands import MODIFIERS, key, middle, mouse, type_text

CTRL = MODIFIERS["Control"]
ALIASES = "[...swanilda.store.objects.values()].map(object => object.alias)"


class Page:
    """A page with a mouse and a keyboard."""

    def __init__(self, browser):
        self.browser = browser
        self.evaluate, self.shows = browser.evaluate, browser.shows

    def mouse(self, kind, at, button="left", buttons=0, modifiers=0):
        mouse(self.browser, kind, at, button, buttons=buttons, modifiers=modifiers)

    def click(self, at, modifiers=0, button="left"):
        self.mouse("mousePressed", at, button, 1, modifiers)
        self.mouse("mouseReleased", at, button, 0, modifiers)

    def drag(self, start, end, modifiers=0, steps=12, hold=None):
        """`hold`: what to do with the button still down."""
        self.mouse("mousePressed", start, "left", 1, modifiers)
        for i in range(1, steps + 1):
            self.mouse("mouseMoved", [a + (b - a) * i / steps for a, b in zip(start, end)], "left", 1, modifiers)
        if hold:
            hold()
        self.mouse("mouseReleased", end, "left", 0, modifiers)

    def drag_and_drop(self, start, end):
        """As browsers do it with what can be dragged."""
        self.browser.command("Input.setInterceptDrags", enabled=True)
        self.mouse("mousePressed", start, "left", 1)
        for i in range(1, 5):
            self.mouse("mouseMoved", [start[0] + 4 * i, start[1] + i], "left", 1)
        dragged = lambda: next((event["params"]["data"] for event in self.browser.events if event["method"] == "Input.dragIntercepted"), None)
        data = self.browser.until(lambda: dragged() or self.evaluate("0"), "the drag")
        for kind in ("dragEnter", "dragOver", "drop"):
            self.browser.command("Input.dispatchDragEvent", type=kind, x=end[0], y=end[1], data=data)
        self.mouse("mouseReleased", end, "left", 0)
        self.browser.command("Input.setInterceptDrags", enabled=False)

    def key(self, name, *held):
        key(self.browser, name, *held)

    def type(self, text):
        type_text(self.browser, text)

    def centre(self, element):
        """Where the middle of an element is."""
        return middle(self.browser, element)

    def press(self, element, modifiers=0):
        self.click(self.centre(element), modifiers)

    def press_button(self, title):
        self.press(f"[...document.querySelectorAll('button')].find(button => button.title.startsWith({json.dumps(title)}))")

    def focus_scene(self):
        self.evaluate("document.getElementById('scene').focus()")

    def rests(self):
        """Until the picture shows what is there."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        self.shows("!swanilda.renderer.stale && swanilda.renderer.camera.motion === null", "rest")

    def add(self, text):
        """A new object by the menu, and its handle."""
        before = self.evaluate("swanilda.store.objects.size")
        self.press_button("Add an object")
        self.press(f"[...document.querySelectorAll('.add-menu button')].find(item => item.textContent == {json.dumps(text)})")
        self.shows(f"swanilda.store.objects.size > {before} && swanilda.store.selection.length == 1", text)
        self.rests()
        return self.evaluate("swanilda.store.selection[0]")

    def rename(self, alias):
        self.focus_scene()
        self.key("F2")
        self.shows("document.activeElement.classList.contains('rename')", "the field of the name")
        self.type(alias)
        self.key("Enter")
        self.shows(f"{ALIASES}.includes({json.dumps(alias)})", alias)

    def place(self, handle):
        """Where an object is on the page."""
        found = f"swanilda.renderer.screenPosition(swanilda.store.poses.get({handle}))"
        return self.evaluate(f"(([x, y], box) => [x + box.left, y + box.top])({found}, swanilda.renderer.canvas.getBoundingClientRect())")

    def pose(self, handle):
        return list(self.evaluate(f"Array.from(swanilda.store.poses.get({handle}))"))

    def lua(self, code):
        """What a line of Lua says."""
        return self.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(code)}}})")

    def row(self, alias):
        return f"[...document.querySelectorAll('[role=treeitem]')].find(row => row.querySelector('.name').textContent == {json.dumps(alias)})"

    def set_pose(self, handle, pose):
        self.evaluate(f"swanilda.studio.edits.ask('move', {{handles: [{handle}], poses: [{json.dumps(pose)}]}})")
        self.shows(f"swanilda.store.poses.get({handle}).every((x, i) => Math.abs(x - {json.dumps(pose)}[i]) < 1e-5)", "the pose")

    def inspects(self):
        """Until the properties are those of the selected object."""
        self.shows("swanilda.inspector.handle === swanilda.store.selection.at(-1) && swanilda.inspector.rows.size > 0", "the properties")

    def write_number(self, field, number):
        """A number into a field of the properties, by the keyboard."""
        self.inspects()
        found = f"document.querySelector('#inspector-pane {field}')"
        self.shows(f"!!{found}", field)
        self.evaluate(f"{found}.focus(); {found}.select()")
        self.type(str(number))
        self.key("Enter")
        self.shows(f"Math.abs(Number(document.querySelector('#inspector-pane {field}').value) - {number}) < 1e-3", f"{field} {number}")

    def write_numbers(self, row, *numbers):
        for i, number in enumerate(numbers):
            self.write_number(f"{row} input:nth-of-type({i + 1})", number)

    def pose_is(self, *numbers):
        """Metres and degrees, in the world."""
        for name, number in zip(("x", "y", "z", "alpha", "beta", "gamma"), numbers):
            self.write_number(f".pose-block input[aria-label={name}]", number)

    def tick(self, name, wanted):
        self.inspects()
        box = f"document.querySelector('[data-name={name}] input')"
        if self.evaluate(f"{box}.checked") != wanted:
            self.evaluate(f"{box}.scrollIntoView()")
            self.press(box)
        self.shows(f"{box}.checked === {json.dumps(wanted)}", name)

    def choose(self, name, word):
        """By the first letter of the word."""
        self.inspects()
        self.evaluate(f"document.querySelector('[data-name={name}] select').focus()")
        self.key(word[0])
        chosen = f"(list => list.options[list.selectedIndex].text)(document.querySelector('[data-name={name}] select'))"
        self.shows(f"{chosen} === {json.dumps(word)}", word)

    def select(self, *aliases):
        for i, alias in enumerate(aliases):
            self.rests()
            self.press(self.row(alias), CTRL if i else 0)
        self.shows(f"swanilda.store.selection.length == {len(aliases)}", "the selection")
