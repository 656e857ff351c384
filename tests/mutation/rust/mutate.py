#!/usr/bin/env python3
"""Mutation tests of the crates: which small faults the tests of a crate notice.

    cargo install cargo-mutants --locked
    pip install tree-sitter tree-sitter-rust
    python3 tests/mutation/rust/mutate.py wire                          # all mutants of a crate
    python3 tests/mutation/rust/mutate.py scene --files src/pose src/joint
    python3 tests/mutation/rust/mutate.py perception --sample 60 --seed 7
    python3 tests/mutation/rust/mutate.py wire --report wire.json       # ... and what became of each mutant
    python3 tests/mutation/rust/mutate.py kinematics --sample 0         # only the faults of named.tsv

cargo-mutants says which faults there are. All of them are built into one program, each behind a switch (schemata.py), so that a crate is compiled
a few times instead of once for each fault. Then the tests of the crate run once with each fault switched on; a fault that no test reaches has survived
at once. Faults that do not compile, or that lie in macros and constants, are not tried. The sources are as before when this ends; commit first.
"""

import argparse
import collections
import json
import os
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from schemata import Schemata

ROOT = Path(__file__).resolve().parent.parent.parent.parent
# Attempts to leave out the faults that do not compile.
BUILDS = 25
# So many programs with tests at once.
PROCESSES = 2


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('crate', help='below crates')
    parser.add_argument('--files', nargs='*', default=['src'], help='beginnings of names below the crate')
    parser.add_argument('--sample', type=int, help='so many mutants at most, drawn at random; default: all')
    parser.add_argument('--seed', type=int, default=1)
    parser.add_argument('--skip', nargs='*', default=[], help='tests that take too long')
    parser.add_argument('--report', help='file to write the fate of each mutant to')
    return parser.parse_args()


def listed(crate, files, sample, seed):
    """The mutants that cargo-mutants knows in these files, or some of them."""
    command = ['cargo', 'mutants', '--list', '--json', '--dir', str(ROOT), '--package', f'swanilda-{crate}']
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    wanted = tuple(f'crates/{crate}/{name}' for name in files)
    found = [mutant for mutant in found if mutant['file'].startswith(wanted)]
    if sample is not None and sample < len(found):
        found = sorted(random.Random(seed).sample(found, sample), key=lambda mutant: (mutant['file'], mutant['span']['start']['line']))
    return found


def named(crate):
    """The faults of named.tsv: they always count."""
    lines = Path(__file__).with_name('named.tsv').read_text().splitlines()
    faults = [line.split('\t') for line in lines if line and not line.startswith('#')]
    return [{'genre': 'Named', 'file': f'crates/{crate}/{name}', 'text': text, 'replacement': value, 'name': f'{name}: {text} is {value}'}
            for of, name, text, value in faults if of == crate]


def compiled(crate):
    """Errors of the compiler, and the programs with the tests."""
    command = ['cargo', 'test', '--no-run', '--package', f'swanilda-{crate}', '--lib', '--message-format', 'json']
    output = subprocess.run(command, cwd=ROOT, capture_output=True, text=True).stdout
    messages = [json.loads(line) for line in output.splitlines() if line.startswith('{')]
    errors = [message['message'] for message in messages if message.get('message', {}).get('level') == 'error']
    programs = [message['executable'] for message in messages if message.get('executable')]
    return errors, programs


def build(crate, schemata):
    """The program with all faults that compile."""
    for _ in range(BUILDS):
        schemata.write()
        errors, programs = compiled(crate)
        if programs:
            return programs[0]
        wrong = schemata.wrong(errors)
        print(f'{len(wrong)} do not compile', file=sys.stderr, flush=True)
        if not wrong:
            sys.exit('\n'.join(error.get('rendered') or error['message'] for error in errors[:5]))
        schemata.leave_out(wrong)
    sys.exit('too many faults do not compile')


def run(program, crate, number, seconds, environment=None):
    """Whether the tests pass with that fault."""

    def limit():
        os.setpriority(os.PRIO_PROCESS, 0, max(10, os.getpriority(os.PRIO_PROCESS, 0)))
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))

    variables = dict(os.environ, SWANILDA_FAULT=str(number), RUST_BACKTRACE='0', **(environment or {}))
    try:
        done = subprocess.run([*program, '--quiet'], cwd=ROOT / 'crates' / crate, env=variables, stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL, preexec_fn=limit, timeout=30 * seconds + 60)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def reached(program, crate):
    """The faults that lie where a test gets to, and how long the tests take, seconds of the processor."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / 'reached'
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        if not run(program, crate, 0, 600, {'SWANILDA_FAULTS_REACHED': str(path)}):
            sys.exit('the tests fail without a fault')
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        numbers = {int(line) for line in path.read_text().split()} if path.exists() else set()
    return numbers, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def fates(program, crate, schemata):
    found, seconds = reached(program, crate)
    print(f'{len(schemata.tried())} faults, {len(found)} reached, {seconds:.1f} s for all tests', file=sys.stderr, flush=True)
    started = time.monotonic()

    def passes(number):
        return number not in found or run(program, crate, number, int(5 * seconds) + 1)

    tried = sorted(schemata.tried().items())
    with ThreadPoolExecutor(PROCESSES) as pool:
        for count, ((_, mutant), survived) in enumerate(zip(tried, pool.map(passes, (number for number, _ in tried)))):
            mutant['fate'] = 'survived' if survived else 'caught'
            if survived:
                print(mutant['name'], flush=True)
            if count % 50 == 49:
                print(f'{count + 1} in {time.monotonic() - started:.0f} s', file=sys.stderr, flush=True)


def table(crate, mutants):
    by_file = collections.defaultdict(list)
    for mutant in mutants:
        if 'fate' in mutant:
            by_file[mutant['file'].split('/src/')[1]].append(mutant['fate'])
    for name, fate in sorted(by_file.items()):
        caught = fate.count('caught')
        print(f'| `{crate}/{name}` | {len(fate)} | {caught} | {100 * caught / len(fate):.0f} % |')


def main():
    options = arguments()
    mutants = named(options.crate)
    if options.sample != 0:
        mutants += listed(options.crate, options.files, options.sample, options.seed)
    schemata = Schemata(ROOT, options.crate, mutants)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit('ended'))
    try:
        program = build(options.crate, schemata)
    finally:
        schemata.restore()
    # The next build replaces the program.
    with tempfile.TemporaryDirectory() as folder:
        kept = Path(folder) / 'tests'
        os.link(program, kept) if os.stat(program).st_dev == os.stat(folder).st_dev else kept.write_bytes(Path(program).read_bytes())
        kept.chmod(0o755)
        fates([str(kept)] + [word for test in options.skip for word in ('--skip', test)], options.crate, schemata)
    if options.report:
        Path(options.report).write_text(json.dumps(mutants, indent=1))
    table(options.crate, mutants)


if __name__ == '__main__':
    main()
