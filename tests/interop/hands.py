"""Mouse and keyboard on a page, as a person uses them."""

import json

CODES = {" ": ("Space", 32), "Enter": ("Enter", 13), "Escape": ("Escape", 27), "Tab": ("Tab", 9), "ArrowLeft": ("ArrowLeft", 37), "ArrowUp": ("ArrowUp", 38), "ArrowRight": ("ArrowRight", 39), "ArrowDown": ("ArrowDown", 40), "Delete": ("Delete", 46), "F2": ("F2", 113)}
MODIFIERS = {"Alt": 1, "Control": 2, "Meta": 4, "Shift": 8}


def mouse(browser, kind, at, button="left", **more):
    browser.command("Input.dispatchMouseEvent", type=kind, x=at[0], y=at[1], button=button, clickCount=1, **more)


def click(browser, at, **more):
    mouse(browser, "mouseMoved", at, "none")
    mouse(browser, "mousePressed", at, **more)
    mouse(browser, "mouseReleased", at, **more)


def drag(browser, start, by, steps=5):
    mouse(browser, "mouseMoved", start, "none")
    mouse(browser, "mousePressed", start)
    for i in range(1, steps + 1):
        mouse(browser, "mouseMoved", [start[k] + by[k] * i / steps for k in (0, 1)], buttons=1)
    mouse(browser, "mouseReleased", [start[k] + by[k] for k in (0, 1)])


def key(browser, name, *held):
    """One key, with others held."""
    code, number = CODES.get(name, ("Key" + name.upper(), ord(name.upper())) if name.isalnum() and len(name) == 1 else ("", 0))
    modifiers = sum(MODIFIERS[each] for each in held)
    text = {"text": name} if len(name) == 1 and not modifiers & 7 else {"text": "\r"} if name == "Enter" else {}
    common = {"key": name, "code": code, "windowsVirtualKeyCode": number, "modifiers": modifiers}
    browser.command("Input.dispatchKeyEvent", type="keyDown" if text else "rawKeyDown", **common, **text)
    browser.command("Input.dispatchKeyEvent", type="keyUp", **common)


def type_text(browser, text):
    browser.command("Input.insertText", text=text)


def box(browser, element):
    """Left, top, width and height of an element, an expression in JavaScript."""
    return browser.shows(f"(element => element && element.getBoundingClientRect().width && (({{left, top, width, height}}) => [left, top, width, height])(element.getBoundingClientRect()))({element})", element)


def middle(browser, element):
    left, top, width, height = box(browser, element)
    return [left + width / 2, top + height / 2]


def found(selector):
    return f"document.querySelector({json.dumps(selector)})"


def with_text(selector, text):
    return f"[...document.querySelectorAll({json.dumps(selector)})].find(element => element.textContent == {json.dumps(text)})"


def press(browser, selector):
    """A click on the middle of what is seen."""
    browser.evaluate(f"{found(selector)}?.scrollIntoView({{block: 'nearest'}})")
    click(browser, middle(browser, found(selector)))


def run(browser, code):
    return browser.evaluate(f"swanilda.source.request('run', {{code: {json.dumps(code)}}})")
