"""Properties in Python."""

import math
import os

import pytest

import swanilda
from swanilda import temporal


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    """Failing cases are kept in the current folder."""
    monkeypatch.chdir(tmp_path)


def failure(test, *args):
    with pytest.raises(Exception) as caught:
        test(*args)
    error = caught.value
    return error, "\n".join(getattr(error, "__notes__", [str(error)]))


def test_a_failing_case_is_shrunk_and_shown_with_its_lines():
    @swanilda.property(cases=100)
    def small(g):
        elements = g.list(lambda: g.integer(0, 9), max=5)
        assert sum(elements) < 15

    error, text = failure(small)
    assert isinstance(error, AssertionError)
    assert "elements = g.list(lambda: g.integer(0, 9), max=5)  -> [6, 9]" in text
    assert "shrunk in" in text


def test_a_failing_case_is_tried_first_the_next_time():
    limit = 1_000_000

    @swanilda.property(cases=400)
    def far(g):
        x = g.float(-100, 100)
        g.robustness(abs(x - 73.5) - 0.01)
        assert abs(x - 73.5) > 0.01 or limit == 0

    failure(far)
    assert len(os.listdir(".swanilda/failures")) == 1
    _, text = failure(far)
    assert "failed in case 1 of the search" in text
    limit = 0
    far()
    assert os.listdir(".swanilda/failures") == []


def test_values_are_those_that_were_asked_for():
    seen = []

    @swanilda.property(cases=60)
    def draws(g):
        assert -2 <= g.float(-2, 3) <= 3
        assert g.integer(4, 9) in range(4, 10)
        assert set(g.subset("abc")) <= set("abc")
        assert g.choice(["a", "b"]) in "ab"
        assert 2 <= len(g.list(lambda: g.boolean(), min=2, max=4)) <= 4
        pose = g.pose(x=(-1, 1), z=0.5, roll=(-3, 3), yaw=(-3, 3))
        assert math.isclose(sum(q * q for q in pose[3:]), 1)
        assert pose[2] == 0.5
        assert 2 <= len(g.path(x=(0, 1), points=(2, 3))) <= 3
        seen.append(g.seed())

    draws()
    assert len(seen) == 60


def test_discarded_cases_do_not_fail():
    @swanilda.property(cases=50)
    def positive(g):
        x = g.float(-1, 1)
        g.assume(x > 0)
        assert x > 0

    positive()


def test_another_failure_is_no_simpler_form_of_the_first():
    @swanilda.property(cases=300)
    def two(g):
        x = g.integer(0, 1000)
        if x >= 600:
            raise ValueError("large")
        if x == 5:
            raise TypeError("five")

    error, text = failure(two)
    assert isinstance(error, ValueError)
    assert "-> 600" in text


def test_wrong_bounds_are_named():
    @swanilda.property
    def wrong(g):
        g.float(2, 1)

    error, _ = failure(wrong)
    assert "the lower bound 2 is above the upper one, 1" in str(error)


@swanilda.property(cases=8)
def test_a_simulator_is_brought_back_before_each_case(g, sim):
    assert sim.getObject("/left", {"noError": True}) == -1
    sim.setObjectAlias(sim.createDummy(0.01), "left")
    height = g.float(0.5, 2)
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, [0.1, 0.1, 0.1])
    sim.setObjectPosition(ball, [0, 0, height])
    sim.setBoolProperty(ball, "dynamic", True)
    sim.simulator.start()
    sim.simulator.step(5)
    assert sim.getObjectPosition(ball)[2] < height


def falling(sim, height):
    ball = sim.createPrimitiveShape(sim.primitiveshape_spheroid, [0.1, 0.1, 0.1])
    sim.setObjectPosition(ball, [0, 0, height])
    sim.setBoolProperty(ball, "dynamic", True)
    sim.simulator.start()
    return ball


def test_what_holds_over_time_leads_the_search(sim):
    @swanilda.property(cases=60)
    def slow(g, sim):
        ball = falling(sim, g.float(1, 5))
        g.always(lambda: 7 + sim.getVelocity(ball)[0][2], "below 7 m/s")
        sim.simulator.step(20)

    error, text = failure(lambda: slow(sim=sim))
    assert isinstance(error, temporal.Violation)
    assert str(error).startswith("always 'below 7 m/s' does not hold at 0.")
    assert "g.float(1, 5)" in text


def test_what_has_to_come_about_is_missed_at_the_end(sim):
    @swanilda.property(cases=60)
    def low(g, sim):
        ball = falling(sim, g.float(1, 20))
        g.eventually(lambda: 0.2 - sim.getObjectPosition(ball)[2], name="lands")
        sim.simulator.step(30)

    error, text = failure(lambda: low(sim=sim))
    assert "eventually 'lands' has not come about until the end at 1.5 s (by" in str(error)
    # 9.81 / 2 * 1.5 s ** 2 = 11.04 m: the shortest number above that.
    assert "-> 12" in text or "-> 11.3" in text


def test_properties_without_a_simulator_watch_nothing():
    @swanilda.property
    def lost(g):
        g.always(lambda: True)

    error, _ = failure(lost)
    assert "it needs one as an argument" in str(error)


CASES_OVER_TIME = [
    (lambda w, t: w.always(lambda: 0.5 - t(), "early"), "always 'early' does not hold at 0.55 s (by 0.05)"),
    (lambda w, t: w.always(lambda: t() < 0.42), "always does not hold at 0.45 s"),
    (lambda w, t: w.eventually(lambda: t() > 3, 0.5), "has not come about within 0.5 s"),
    (lambda w, t: w.eventually(lambda: t() - 3), "until the end at 1 s (by 2)"),
    (lambda w, t: w.eventually(lambda: t() > 3, 4), "at 1 s, before 4 s have passed"),
    (lambda w, t: w.holds_until(lambda: t() < 0.42, lambda: t() > 0.6), "until does not hold at 0.45 s"),
    (lambda w, t: w.holds_until(lambda: True, lambda: False, 0.3), "was not ended within 0.3 s"),
    (lambda w, t: w.holds_until(lambda: True, lambda: False), "was not ended until the end at 1 s"),
    (lambda w, t: w.leads_to(lambda: t() > 0.3, lambda: t() > 0.9, 0.2, "go"), "leads to 'go' was begun at 0.35 s and has led"),
    (lambda w, t: w.always(lambda: "yes"), "returns a boolean or a number, not 'yes'"),
]


@pytest.mark.parametrize(("watched", "message"), CASES_OVER_TIME)
def test_violations_say_when(simulator, watched, message):
    simulator.start()
    with pytest.raises((AssertionError, TypeError)) as caught, temporal.Watch(simulator) as watch:
        watched(watch, lambda: simulator.time)
        simulator.step(20)
    assert message in str(caught.value)
    assert simulator.step(5) == 5, "the watch is over"


ROBUSTNESS = [
    (lambda w, t: w.always(lambda: 3 - t()), 2),
    (lambda w, t: w.eventually(lambda: t() - 0.25), 0.75),
    (lambda w, t: w.holds_until(lambda: 1.5 - t(), lambda: t() - 0.475), 0.025),
    # The least of max(0.2 - t, (t + 0.3) - 0.4) is where these are equal.
    (lambda w, t: w.leads_to(lambda: t() - 0.2, lambda: t() - 0.4, 0.3), 0.05),
]


@pytest.mark.parametrize(("watched", "robustness"), ROBUSTNESS)
def test_robustness_says_how_far_from_false_it_was(simulator, watched, robustness):
    simulator.start()
    with temporal.Watch(simulator) as watch:
        watched(watch, lambda: simulator.time)
        simulator.step(20)
    assert watch.robustness == pytest.approx(robustness, abs=1e-9)


def test_strategies_of_hypothesis_are_drawn_by_it():
    strategies = pytest.importorskip("hypothesis.strategies")

    @swanilda.property(cases=50, x=strategies.integers(0, 1000))
    def small(x):
        assert x < 100

    with pytest.raises(AssertionError) as caught:
        small()
    assert "x=100" in "\n".join(caught.value.__notes__)


def test_what_is_no_strategy_is_named():
    pytest.importorskip("hypothesis")
    with pytest.raises(TypeError, match="case is neither an option"):
        swanilda.property(case=3)(lambda: None)
