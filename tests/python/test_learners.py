"""Learners that are not installed are named with what installs them.

What they do with worlds is in test_sb3.py and test_rllib.py, which are skipped without torch: its wheels bring 3 GB of CUDA, 6 GB on disk, so
the environment of `cargo test` does not have it, and a mistake in swanilda.sb3 or swanilda.rllib is noticed only where somebody has:

    pip install torch stable-baselines3 'ray[rllib]' && pytest tests/python/test_sb3.py tests/python/test_rllib.py
"""

import importlib
import sys

import pytest


@pytest.mark.parametrize(("module", "library"), [("sb3", "stable_baselines3"), ("rllib", "ray")])
def test_a_learner_that_is_missing_is_named(monkeypatch, module, library):
    for name in [name for name in sys.modules if name.split(".")[0] == library]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, library, None)
    monkeypatch.delitem(sys.modules, f"swanilda.{module}", raising=False)
    with pytest.raises(ImportError, match=f"swanilda.{module} needs .*pip install"):
        importlib.import_module(f"swanilda.{module}")
