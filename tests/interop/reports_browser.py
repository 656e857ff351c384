"""The HTML report in a headless Chromium."""

import pathlib
import sys
import tempfile

import suite
from browser import Browser, program
from compare import same

SHOWN = "[...document.querySelectorAll('details.test')].filter(test => test.checkVisibility()).length"


def until_shown(browser):
    browser.shows("document.readyState == 'complete' && document.querySelectorAll('details.test').length", "the page")


def counts(browser):
    same("the title", browser.evaluate("document.title"), "4 of 6 tests failed")
    told = "[...document.querySelectorAll('.counts b')].map(each => each.parentNode.textContent.trim()).join()"
    same("the counts", browser.evaluate(told), "2 failed,2 errors,1 pending,1 passed")
    files = "[...document.querySelectorAll('h2')].map(each => each.firstChild.textContent.trim()).join()"
    same("the files", browser.evaluate(files), "drive_test.lua,plain_test.lua")


def hostile_texts(browser):
    name = "document.querySelectorAll('.name')[1].textContent"
    same("a name", browser.evaluate(name), suite.HOSTILE)
    said = "document.querySelector('.console pre').textContent"
    same("a console", suite.HOSTILE in browser.evaluate(said), True)
    same("scripts", browser.evaluate("document.scripts.length"), 1)


def console_unfolds(browser):
    console = "document.querySelector('.console')"
    visible = f"{console}.querySelector('pre').checkVisibility()"
    same("folded", browser.evaluate(visible), False)
    browser.evaluate(f"{console}.scrollIntoView()")
    browser.evaluate(f"{console}.querySelector('summary').click()")
    browser.shows(visible, "the console")


def plots(browser):
    widths = "[...document.images].map(image => image.naturalWidth).join()"
    browser.shows("[...document.images].every(image => image.complete)", "the plot")
    same("the plot", browser.evaluate(widths), "900")


def filters(browser):
    same("all", browser.evaluate(SHOWN), 6)
    box = "document.getElementById('find')"  # `find` alone is a function of browsers
    find = box + ".value = '{}'; " + box + ".dispatchEvent(new Event('input'))"
    browser.evaluate(find.format("NEEDLE"))
    same("found in a console", browser.evaluate(SHOWN), 1)
    same("told", browser.evaluate("shown.value"), "1 of 6 shown")
    same("files without tests", browser.evaluate("document.querySelector('section').checkVisibility()"), False)
    browser.evaluate(find.format(""))
    browser.evaluate("document.querySelector('input[value=failed]').click()")
    same("without the failed ones", browser.evaluate(SHOWN), 4)
    browser.evaluate("document.querySelector('input[value=failed]').click()")
    browser.evaluate("unfold.click()")
    same("unfolded", browser.evaluate("document.querySelectorAll('details.test[open]').length"), 6)


def is_dark_when_wanted(browser):
    background = "getComputedStyle(document.body).backgroundColor"
    same("light", browser.evaluate(background), "rgb(255, 255, 255)")
    browser.command("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
    same("dark", browser.evaluate(background), "rgb(13, 17, 23)")


def works_without_javascript(browser):
    browser.command("Emulation.setScriptExecutionDisabled", value=True)
    browser.command("Page.reload")
    until_shown(browser)
    same("everything", browser.evaluate(SHOWN), 6)
    same("no filter", browser.evaluate("document.querySelector('.controls').checkVisibility()"), False)


def says_and_loads_nothing(browser, page):
    told = ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded", "Page.javascriptDialogOpening")
    same("the console", [event for event in browser.events if event["method"] in told], [])
    sent = [event for event in browser.events if event["method"] == "Network.requestWillBeSent"]
    urls = {event["params"]["request"]["url"] for event in sent}
    same("requests", {url for url in urls if not url.startswith("data:")}, {page})


def main():
    with tempfile.TemporaryDirectory() as folder, Browser(program() or sys.exit("there is no Chromium")) as browser:
        suite.run(sys.argv[1], folder, "--html", "page.html")
        for domain in ("Page", "Runtime", "Log", "Network"):
            browser.command(f"{domain}.enable")
        page = pathlib.Path(folder, "page.html").as_uri()
        browser.open(page)
        until_shown(browser)
        counts(browser)
        hostile_texts(browser)
        console_unfolds(browser)
        plots(browser)
        filters(browser)
        is_dark_when_wanted(browser)
        works_without_javascript(browser)
        says_and_loads_nothing(browser, page)


main()
