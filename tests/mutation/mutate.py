#!/usr/bin/env python3
"""Mutation tests of the Lua library: puts one small fault at a time into a file below lua/library and looks whether a conformance case fails.

    cargo build --release
    python3 tests/mutation/mutate.py sim/path.lua               # all mutants of a file
    python3 tests/mutation/mutate.py --per-file 20 --seed 7     # a sample of each file of files.txt
    python3 tests/mutation/mutate.py --report out.json          # ... and what became of each mutant
    python3 tests/mutation/mutate.py --again out.json           # only those that survived then

Nothing is built: the library lies in the command as text, and a mutant is a copy of the command with another text of the same length
(embedded.py). Faults are those of operators.py; mutants that do not compile are left out. Of the cases, those run that reach the changed
function (reach.py), the most special and quickest first, until one fails (cases.py compares as tests/conformance.rs does). A mutant that
fails none has survived. equivalent.tsv lists mutants that no test can notice, with the reason; they do not count.

Two processes at most work, at low priority. Files are those of the working tree; the command has to be built from them.
"""

import argparse
import functools
import json
import math
import os
import random
import subprocess
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import cases
from embedded import Command, fit
from operators import function_name, mutants_of
from reach import probed, reached

HERE = Path(__file__).resolve().parent
LIBRARY = HERE.parent.parent / 'lua' / 'library'
COMMAND = HERE.parent.parent / 'target' / 'release' / 'swanilda'


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('files', nargs='*', help='below lua/library; default: those of files.txt')
    parser.add_argument('--command', default=COMMAND, help='the swanilda to copy')
    parser.add_argument('--per-file', type=int, help='mutants drawn from each file; default: all')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--cases', type=int, help='run at most so many cases against a mutant, the most special ones; default: all that reach it')
    parser.add_argument('--jobs', type=int, default=2, choices=(1, 2))
    parser.add_argument('--report', help='file to write the fate of each mutant to')
    parser.add_argument('--again', help='file written with --report: only its survivors')
    return parser.parse_args()


def listed(name):
    lines = (HERE / name).read_text().splitlines()
    return [line for line in lines if line and not line.startswith('#')]


class Bench:
    """A worker's copy of the command, and the cases."""

    def __init__(self, command, folder, texts):
        os.nice(15)
        self.texts, self.original = texts, command
        self.command = Command(command, os.path.join(folder, f'swanilda-{os.getpid()}'))
        self.cases = {case.name: case for case in cases.discover()}

    def put(self, path, text):
        self.command.replace(self.texts[path], text)

    def trace(self, name):
        """What a case reaches and its processor seconds, in a command with probes; and whether it passes without."""
        output, seconds = cases.measure(self.cases[name], self.command.path)
        return name, reached(output), seconds, self.cases[name].passes(self.original)

    def judge(self, mutant, order):
        """The first case that fails, `unfit` without room, or None: survived."""
        text = self.texts[mutant.path]
        changed = fit(mutant.apply(text), len(text.encode()))
        if changed is None:
            return 'unfit'
        self.put(mutant.path, changed)
        failing = next((n for n, limit in order if not self.cases[n].passes(self.command.path, limit)), None)
        self.put(mutant.path, text)
        return failing


BENCH = None


def set_up(*details):
    global BENCH
    BENCH = Bench(*details)


def set_up_probes(*details):
    set_up(*details)
    for path, text in BENCH.texts.items():
        BENCH.put(path, probed(path, text))


def trace(name):
    return BENCH.trace(name)


def judge(task):
    return BENCH.judge(*task)


def reach_map(options, folder, texts):
    """Case -> what it reaches and its processor seconds. Without cases that fail already."""
    names = [case.name for case in cases.discover()]
    with ProcessPoolExecutor(options.jobs, initializer=set_up_probes, initargs=(options.command, folder, texts)) as pool:
        traced = list(pool.map(trace, names))
    failing = [name for name, _, _, is_passing in traced if not is_passing]
    if failing:
        print(f'these cases fail without a mutant and are left out: {" ".join(failing)}', file=sys.stderr)
    return {name: (places, seconds) for name, places, seconds, is_passing in traced if is_passing}


@functools.cache
def text_of(case):
    return (cases.ROOT / f'{case}.lua').read_text(errors='replace')


def cases_of(options, found, texts, mutant):
    """Cases that reach a mutant, the likeliest first to notice, each with its limit of processor seconds.

    Those that mention the function come first; for a change outside of functions, those that reach many functions of the file. Else the
    quick ones that reach little.
    """
    name = function_name(texts[mutant.path], mutant.function)

    def rank(case):
        places, seconds = found[case]
        in_file = sum(path == mutant.path for path, _ in places)
        is_mentioned = name is not None and name in text_of(case)
        return not is_mentioned, -in_file if mutant.function < 0 else 0, seconds * len(places), case

    reaching = [case for case, (places, _) in found.items() if (mutant.path, mutant.function) in places]
    return [(case, math.ceil(1 + 10 * found[case][1])) for case in sorted(reaching, key=rank)[:options.cases]]


def compiling(options, folder, texts, mutants):
    """The mutants that are Lua: asked of the command, all at once."""
    for number, mutant in enumerate(mutants):
        Path(folder, f'{number}.lua').write_text(mutant.apply(texts[mutant.path]))
    script = Path(folder, 'compile.lua')
    script.write_text(
        f"for i = 0, {len(mutants) - 1} do print('@' .. i .. (loadfile('{folder}/' .. i .. '.lua') and ' ok' or ' no')) end"
    )
    arguments = [options.command, 'run', script, '--as', 'sandbox', '--empty', '--no-start', '--loops', '1', '--quiet']
    output = subprocess.run(arguments, capture_output=True, text=True, timeout=60, check=False).stdout
    if output.count('@') != len(mutants):
        sys.exit(f'{options.command} does not compile the mutants: is it swanilda? It said:\n{output[:500]}')
    return [m for number, m in enumerate(mutants) if f'@{number} ok' in output]


def chosen(options, texts):
    """The mutants to judge, before those that do not compile are left out."""
    equivalent = {tuple(line.split('\t')[:3]) for line in listed('equivalent.tsv')}
    again = options.again and {tuple(row[:3]) for row in json.loads(Path(options.again).read_text()) if row[3] is None}
    for path, text in texts.items():
        mutants = [m for m in mutants_of(path, text) if (path, *m.lines(text)) not in equivalent]
        if again:
            mutants = [m for m in mutants if (path, *m.lines(text)) in again]
        if options.per_file and options.per_file < len(mutants):
            generator = random.Random(f'{options.seed} {path}')
            mutants = sorted(generator.sample(mutants, options.per_file), key=lambda m: m.start)
        yield from mutants


def check_method(options, folder, texts, found):
    """An unchanged copy has to pass, and one with a syntax error to fail: else no verdict means anything."""
    set_up(options.command, folder, texts)
    path, name = next((p, case) for p in texts for case, (places, _) in found.items() if (p, -1) in places)
    if not BENCH.cases[name].passes(BENCH.command.path):
        sys.exit(f'{name} fails with an unchanged copy of the command: copies do not run here')
    BENCH.put(path, '=' + texts[path][1:])
    if BENCH.cases[name].passes(BENCH.command.path):
        sys.exit(f'{name} passes with a syntax error in {path}: its text is not where the command takes it from')


def show(path, text, mutants, verdicts):
    """Survivors and the share caught, of one file."""
    survivors = [m for m, verdict in zip(mutants, verdicts) if verdict is None]
    for mutant in survivors:
        before, after = mutant.lines(text)
        print(f'{path}:{mutant.line + 1}: survived\n  - {before}\n  + {after}')
    count = len(mutants) - verdicts.count('unfit')
    caught = count - len(survivors)
    print(f'{path}: {caught} of {count} caught, {100 * caught / max(1, count):.0f} %', flush=True)


def judge_all(options, folder, texts, mutants, found):
    """Rows for the report: file, line before and after, verdict, number of the line."""
    with ProcessPoolExecutor(options.jobs, initializer=set_up, initargs=(options.command, folder, texts)) as pool:
        for path, text in texts.items():
            mine = [m for m in mutants if m.path == path]
            verdicts = list(pool.map(judge, [(m, cases_of(options, found, texts, m)) for m in mine]))
            show(path, text, mine, verdicts)
            yield from ([path, *m.lines(text), v, m.line + 1] for m, v in zip(mine, verdicts))


def main():
    options = arguments()
    texts = {path: (LIBRARY / path).read_text() for path in options.files or listed('files.txt')}
    with tempfile.TemporaryDirectory(dir='/dev/shm' if os.path.isdir('/dev/shm') else None) as folder:
        mutants = compiling(options, folder, texts, list(chosen(options, texts)))
        found = reach_map(options, folder, texts)
        check_method(options, folder, texts, found)
        rows = list(judge_all(options, folder, texts, mutants, found))
    if options.report:
        Path(options.report).write_text(json.dumps(rows, indent=0))
    return 0


if __name__ == '__main__':
    sys.exit(main())
