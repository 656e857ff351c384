"""Runs a conformance case and compares what it prints, by the rules of tests/conformance.rs and tests/support/compare.rs."""

import math
import os
import re
import resource
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent / 'conformance'
WALL_LIMIT = 60  # seconds
MEMORY_LIMIT = 8 << 30  # bytes of addresses: a mutant may fill a table without end
NUMBER = re.compile(r'[-+]?(?:(?:nan|inf)|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)(?![A-Za-z_])')


class Case:
    def __init__(self, path):
        self.path = path
        self.name = str(path.relative_to(ROOT).with_suffix(''))
        text = path.read_text(errors='surrogateescape')
        self.header = {}
        for key, value in re.findall(r'^-- (\w+): (.*)$', text, re.M):
            self.header.setdefault(key, value.strip())
        self.expected = path.with_suffix('.expected').read_text(errors='replace')

    def run(self, command, cpu_limit):
        """What the case prints; None if it does not end in time."""
        with tempfile.TemporaryDirectory() as data, tempfile.TemporaryFile() as output:
            def limit():
                resource.setrlimit(resource.RLIMIT_CPU, (cpu_limit, cpu_limit))
                resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))

            arguments = [command, 'run', str(self.path), '--data-dir', data, *self.arguments()]
            try:
                subprocess.run(
                    arguments, stdin=subprocess.DEVNULL, stdout=output, stderr=output, preexec_fn=limit,
                    timeout=WALL_LIMIT, check=False,
                )
            except subprocess.TimeoutExpired:
                return None
            output.seek(0)
            return output.read().decode(errors='replace')

    def arguments(self):
        passes = self.header.get('passes', '0')
        if passes == '0':
            length = ['--no-start', '--loops', self.header.get('loops', '20')]
        else:
            length = ['--steps', passes]
        return ['--as', self.header.get('as', 'sandbox'), '--empty', '--original-errors', '--quiet', *length]

    def passes(self, command, cpu_limit=60):
        output = self.run(command, cpu_limit)
        tolerance = float(self.header.get('tol', 0))
        return output is not None and agree(self.expected, self.normalized(output), tolerance)

    def normalized(self, output):
        """Without what is not the script's own output."""
        lines = []
        for line in output.split('\n'):
            line = line.removesuffix('\r')
            is_log = re.match(r'\[[^\]]*:(warning|info)\]', line) and '/scene/' in f'/{self.name}'
            is_chatter = ':loadinfo]' in line or line.startswith(('[sandboxScript:info]', '\t')) or is_log
            if not is_chatter and line != 'stack traceback:':
                line = line.replace(f'{self.path.parent}/', '')
                lines.append(re.sub(r'0x[\da-fA-F]{6,}', '0xADDR', line))
        return '\n'.join(lines)


def discover():
    """All cases: each .lua with an .expected beside it, but those that KNOWN.md lists."""
    known = set(re.findall(r'^\| `([^`]+)` \|', (ROOT / 'KNOWN.md').read_text(), re.M))
    paths = sorted(path for path in ROOT.rglob('*.lua') if path.with_suffix('.expected').exists())
    return [case for case in map(Case, paths) if case.name not in known]


def agree(expected, actual, tolerance):
    wanted, got = (text.rstrip('\n').split('\n') for text in (expected, actual))
    return len(wanted) == len(got) and all(lines_agree(*pair, tolerance) for pair in zip(wanted, got))


def lines_agree(want, got, tolerance):
    want, got = want.rstrip(), got.rstrip()
    if want == got:
        return True
    (want_text, want_numbers), (got_text, got_numbers) = split(want), split(got)
    return want_text == got_text and all(map(lambda a, b: close(a, b, tolerance), want_numbers, got_numbers))


def close(a, b, tolerance):
    return abs(a - b) <= tolerance + 1e-12 or a == b or math.isnan(a) and math.isnan(b)


def split(line):
    """The text with every number replaced by a NUL, and the numbers."""
    numbers, text, place = [], [], 0
    while place < len(line):
        is_in_word = place > 0 and (line[place - 1].isascii() and line[place - 1].isalpha() or line[place - 1] == '_')
        # After a number comes no word, so its last character counts as a digit.
        match = None if is_in_word and not (text and text[-1] == '\0') else NUMBER.match(line, place)
        if match:
            numbers.append(float(match.group()))
            text.append('\0')
            place = match.end()
        else:
            text.append(line[place])
            place += 1
    return ''.join(text), numbers


def measure(case, command):
    """Output and processor seconds of an undisturbed run."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    output = case.run(command, WALL_LIMIT)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return output or '', after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
