"""The plugin: tests in Lua in pytest's report, and the fixture."""

pytest_plugins = "pytester"

LUA = """
local sim = require 'sim'
it('passes', function() assert.is_true(sim.createDummy(0.1) > 0) end)
it('fails', function() assert.equal(1, 2) end)
it('is to be written')
"""


def test_tests_in_lua_are_in_the_report(pytester):
    pytester.makefile(".lua", a_test=LUA)
    pytester.makepyfile("def test_fixture(sim): assert sim.simulator.step and sim.createDummy(0.1) > 0")
    result = pytester.runpytest_subprocess("--swanilda")
    result.assert_outcomes(passed=2, failed=1, skipped=1)
    result.stdout.fnmatch_lines(["*fails*", "*xpected*"])


def test_without_the_option_there_are_none(pytester):
    pytester.makefile(".lua", a_test=LUA)
    result = pytester.runpytest_subprocess()
    assert result.ret == 5


def test_a_broken_file_is_an_error(pytester):
    pytester.makefile(".lua", b_test="this is not Lua")
    result = pytester.runpytest_subprocess("--swanilda")
    assert result.ret != 0
