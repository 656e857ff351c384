"""For pytest: the fixture `sim`, and with `--swanilda` the tests of `*_test.lua` files."""

import pytest


def pytest_addoption(parser):
    group = parser.getgroup("swanilda")
    group.addoption("--swanilda", action="store_true", help="also run tests in Lua: files *_test.lua")
    group.addoption("--swanilda-timeout", type=float, default=60.0, metavar="SECONDS", help="wall-clock limit of a test in Lua")


@pytest.fixture
def simulator():
    """A new simulator with the default scene."""
    import swanilda

    with swanilda.Simulator() as simulator:
        yield simulator


@pytest.fixture
def sim(simulator):
    """The module `sim` of a new simulator; `sim.simulator` is the simulator."""
    module = simulator.require("sim")
    module.__dict__["simulator"] = simulator
    return module


def pytest_collect_file(file_path, parent):
    if parent.config.getoption("--swanilda") and file_path.name.endswith("_test.lua"):
        return LuaFile.from_parent(parent, path=file_path)


class LuaFile(pytest.File):
    """A file of tests in Lua. All of them run when the first is due."""

    def collect(self):
        from swanilda import _swanilda

        for index, name, line in _swanilda.list_tests(self.path):
            item = LuaTest.from_parent(self, name=name)
            item.index, item.line = index, line
            yield item

    def outcomes(self):
        if not hasattr(self, "_outcomes"):
            from swanilda import _swanilda

            timeout = self.config.getoption("--swanilda-timeout")
            self._outcomes = {row[0]: row for row in _swanilda.run_tests(self.path, timeout)}
        return self._outcomes


class LuaFailure(Exception):
    """A test in Lua has failed."""


class LuaTest(pytest.Item):
    def runtest(self):
        outcomes = self.parent.outcomes()
        _, _, status, message, trace = outcomes.get(self.index) or outcomes[0]
        if status == "pending":
            pytest.skip(message or "pending")
        if status != "passed":
            raise LuaFailure(f"{message}\n{trace}".strip())

    def repr_failure(self, excinfo):
        if isinstance(excinfo.value, LuaFailure):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, (self.line or 1) - 1, self.name
