"""The sources of a crate with faults in it, each behind a switch that a variable of the environment turns on."""

import bisect
import re
from pathlib import Path

import tree_sitter_rust
from tree_sitter import Language, Parser

PARSER = Parser(Language(tree_sitter_rust.language()))
SWITCH = re.compile(rb'crate::fault\((\d+)u32\)')
# That of an arm of a match which is left out.
ARM = re.compile(rb' if !crate::fault\((\d+)u32\)')
# The error of a match that has become incomplete.
INCOMPLETE = 'E0004'
# What the root of the crate gets: the switch, and the tests beside the crate, which then are a part of its own.
HEAD = b'#![allow(warnings, clippy::all, missing_docs)]\n'
FAULT = b'''
#[doc(hidden)]
#[inline(never)]
pub fn fault(number: u32) -> bool {
    static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let read = || std::env::var("SWANILDA_FAULT").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    let chosen = *CHOSEN.get_or_init(read);
    if chosen == 0 { reached(number); }
    chosen == number
}

fn reached(number: u32) {
    use std::sync::atomic::{AtomicBool, Ordering};
    static SEEN: [AtomicBool; 1 << 14] = [const { AtomicBool::new(false) }; 1 << 14];
    if SEEN[number as usize % SEEN.len()].swap(true, Ordering::Relaxed) { return; }
    let Ok(path) = std::env::var("SWANILDA_FAULTS_REACHED") else { return };
    if let Ok(mut file) = std::fs::File::options().create(true).append(true).open(path) {
        let _ = std::io::Write::write_all(&mut file, format!("{number}\\n").as_bytes());
    }
}
'''


def base_of(field):
    """What a structure takes the fields from that it does not name."""
    return next((child for child in field.parent.children if child.type == 'base_field_initializer'), None)


def switch(number):
    return b'crate::fault(%du32)' % number


class Source:
    """A file with its faults."""

    def __init__(self, path, mutants):
        self.path, self.bytes = path, path.read_bytes()
        self.starts = [0] + [at + 1 for at, byte in enumerate(self.bytes) if byte == 10]
        # By the node that changes: numbers and mutants.
        self.by_node = {}
        tree = PARSER.parse(self.bytes)
        self.root = tree.root_node
        self.missed = [number for number, mutant in mutants.items() if not self.place(number, mutant)]

    def offset(self, at):
        line = self.bytes[self.starts[at['line'] - 1]:].split(b'\n', 1)[0].decode()
        return self.starts[at['line'] - 1] + len(line[:at['column'] - 1].encode())

    def place_named(self, number, mutant):
        text = mutant['text'].encode()
        start = self.bytes.index(text)
        node = self.root.descendant_for_byte_range(start, start + len(text))
        is_whole = (node.start_byte, node.end_byte) == (start, start + len(text))
        self.by_node.setdefault((node.start_byte, node.end_byte, node.type), []).append((number, mutant))
        return is_whole

    def place(self, number, mutant):
        if mutant['genre'] == 'Named':
            return self.place_named(number, mutant)
        start, end = self.offset(mutant['span']['start']), self.offset(mutant['span']['end'])
        kind = mutant['genre']
        end = start + 1 if kind in ('MatchArm', 'StructField') else end
        node = self.root.descendant_for_byte_range(start, end)
        if kind == 'FnValue':
            while node and node.type != 'block':
                node = node.parent
        elif kind in ('BinaryOperator', 'UnaryOperator'):
            node = node.parent if node else None
            wanted = ('binary_expression', 'compound_assignment_expr') if kind == 'BinaryOperator' else ('unary_expression',)
            node = node if node and node.type in wanted else None
        elif kind == 'MatchArm':
            while node and node.type != 'match_arm':
                node = node.parent
        elif kind == 'StructField':
            while node and node.type not in ('field_initializer', 'shorthand_field_initializer'):
                node = node.parent
            node = node if node and base_of(node) else None
        elif node and node.parent and node.parent.type == 'match_pattern':
            pass
        else:
            node = None
        if node is None or any(child.type == 'let_condition' for child in node.children):
            return False
        self.by_node.setdefault((node.start_byte, node.end_byte, node.type), []).append((number, mutant))
        return True

    def render(self, without):
        self.faults = {key: kept for key, every in self.by_node.items() if (kept := [one for one in every if one[0] not in without])}
        self.positions = sorted(key[0] for key in self.faults)
        return self.text(self.root)

    def holds(self, node):
        at = bisect.bisect_left(self.positions, node.start_byte)
        return at < len(self.positions) and self.positions[at] < node.end_byte

    def inner(self, node):
        """The text of a node with the faults of its children."""
        if not node.child_count or not self.holds(node):
            return self.bytes[node.start_byte:node.end_byte]
        parts, at = [], node.start_byte
        for child in node.children:
            parts += [self.bytes[at:child.start_byte], self.text(child)]
            at = child.end_byte
        return b''.join(parts + [self.bytes[at:node.end_byte]])

    def plain(self, node):
        """The text of a node without faults: another one is on where it stands."""
        return self.bytes[node.start_byte:node.end_byte]

    def text(self, node):
        every = self.faults.get((node.start_byte, node.end_byte, node.type), [])
        inner = self.inner(node)
        for number, mutant in every:
            inner = getattr(self, mutant['genre'])(node, inner, number, mutant['replacement'].encode())
        return inner

    def FnValue(self, node, inner, number, value):
        head = b'{ if %s { return %s; } ' % (switch(number), value)
        return head + inner[1:]

    def BinaryOperator(self, node, inner, number, value):
        left, right = self.plain(node.child_by_field_name('left')), self.plain(node.child_by_field_name('right'))
        return b'(if %s { %s %s %s } else { %s })' % (switch(number), left, value, right, inner)

    def UnaryOperator(self, node, inner, number, value):
        return b'(if %s { %s } else { %s })' % (switch(number), self.plain(node.children[-1]), inner)

    def MatchArm(self, node, inner, number, value):
        pattern = node.child_by_field_name('pattern')
        guard = pattern.child_by_field_name('condition')
        rest = self.bytes[pattern.end_byte:node.start_byte]
        whole = inner[len(self.text(pattern)):]
        if guard:
            head = self.bytes[pattern.start_byte:guard.start_byte] + b'!%s && (%s)' % (switch(number), self.text(guard))
        else:
            head = self.text(pattern) + b' if !%s' % switch(number)
        return head + rest + whole

    def MatchArmGuard(self, node, inner, number, value):
        return b'(if %s { %s } else { %s })' % (switch(number), value, inner)

    Named = MatchArmGuard

    def StructField(self, node, inner, number, value):
        base = base_of(node)
        other = self.bytes[base.start_byte + 2:base.end_byte]
        name = node.child_by_field_name('field') or node.children[-1]
        name = self.bytes[name.start_byte:name.end_byte]
        old = node.child_by_field_name('value')
        old = self.text(old) if old else name
        return b'%s: if %s { (%s).%s } else { %s }' % (name, switch(number), other, name, old)


class Schemata:
    """All files of a crate that get faults."""

    def __init__(self, root, crate, mutants):
        self.root, self.crate, self.without = root, root / 'crates' / crate, set()
        numbered = dict(enumerate(mutants, 1))
        self.numbered = numbered
        self.library = self.crate / 'src' / 'lib.rs'
        paths = {root / mutant['file'] for mutant in mutants} | {self.library}
        of_file = lambda path: {n: m for n, m in numbered.items() if root / m['file'] == path}
        self.sources = {path: Source(path, of_file(path)) for path in paths}
        for source in self.sources.values():
            self.without.update(source.missed)

    def tried(self):
        return {number: mutant for number, mutant in self.numbered.items() if number not in self.without}

    def write(self):
        for path, source in self.sources.items():
            text = source.render(self.without)
            path.write_bytes(HEAD + text + FAULT + self.beside() if path == self.library else text)

    def beside(self):
        """The tests in the folder beside the sources, as modules."""
        tests = sorted((self.crate / 'tests').glob('*.rs'))
        name = self.crate.name.replace('-', '_')
        own = b'#[cfg(test)] extern crate self as %s;\n' % name.encode()
        module = lambda path: f'#[cfg(test)] #[path = "{path}"] mod beside_{path.stem};\n'.encode()
        return own + b''.join(map(module, tests)) if tests else b''

    def restore(self):
        for path, source in self.sources.items():
            path.write_bytes(source.bytes)

    def leave_out(self, numbers):
        self.without.update(numbers)

    def wrong(self, errors):
        """The faults that these errors of the compiler are about: those before them in the text; of an incomplete match that of its last arm."""
        numbers = set()
        for error in errors:
            if (error.get('code') or {}).get('code') == INCOMPLETE:
                spans, switch = [span for help in error['children'] for span in help['spans']], ARM
            else:
                spans, switch = [span for span in error['spans'] if span['is_primary']], SWITCH
            numbers.update(number for span in spans if (number := self.before(span, switch)) is not None)
        return numbers - self.without

    def before(self, span, switch):
        path = Path(self.root, span['file_name'])
        if path not in self.sources:
            return None
        found = [match for match in switch.finditer(path.read_bytes()) if match.start() <= span['byte_start']]
        return int(found[-1].group(1)) if found else None
