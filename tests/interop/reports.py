"""JUnit XML before junitparser, TAP before tap.py."""

import pathlib
import sys
import tempfile

import suite
from compare import same
from junitparser import Error, Failure, JUnitXml, Properties, Skipped
from tap.parser import Parser

PROGRAM = sys.argv[1]


def junit(path):
    report = JUnitXml.fromfile(str(path))
    same("suites", [found.name for found in report], ["drive_test.lua", "plain_test.lua"])
    same("counts", (report.tests, report.failures, report.errors, report.skipped), (6, 2, 2, 1))
    cases = {case.name: case for found in report for case in found}
    same("classes", {case.classname for case in cases.values()}, {"drive_test", "plain_test"})
    same("a pass", cases["passes"].result, [])
    kinds = [type(cases[name].result[0]) for name in ("falls", suite.HOSTILE, "breaks a script", "is to be written")]
    same("results", kinds, [Failure, Error, Error, Skipped])
    same("a message", suite.HOSTILE in cases[suite.HOSTILE].result[0].message, True)
    same("the script", "in script /script" in cases["breaks a script"].result[0].text, True)
    said = cases["falls"].system_out.split("\n")
    same("the console", said[0].endswith(suite.HOSTILE) and said[1].endswith("\ufffd \ufffd[31m \ufffd"), True)
    properties = {each.name: each.value for each in cases["falls"].child(Properties)}
    same("properties", properties, {"seed": "123456", "simulated_time": "0.200000", "steps": "4"})


def tap(text):
    lines = list(Parser().parse_text(text))
    same("what is not TAP", [line.text for line in lines if line.category == "unknown"], [])
    tests = {line.description.split("::")[1]: line for line in lines if line.category == "test"}
    same("what passed", [name for name, test in tests.items() if test.ok], ["passes"])
    same("to do", [name for name, test in tests.items() if test.todo], ["is to be written"])
    block = tests["fails"].yaml_block
    same("a line", block["line"], 4)
    same("a source", ">    4 |     assert.equal(1, 2)" in block["source"], True)


def main():
    with tempfile.TemporaryDirectory() as folder:
        told = suite.run(PROGRAM, folder, "--junit", "junit.xml", "--tap")
        junit(pathlib.Path(folder, "junit.xml"))
        tap(told)


main()
