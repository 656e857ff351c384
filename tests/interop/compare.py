"""Comparisons that end the program with what differs."""

import sys


def same(what, actual, expected):
    if actual != expected:
        sys.exit(f"{what}: {actual!r} instead of {expected!r}")


def near(what, actual, expected):
    if abs(actual - expected) > 1e-9:
        sys.exit(f"{what}: {actual!r} instead of {expected!r}")
