"""The faults that are put into Lua text: one small change each, found by the tokens around it.

Strings and comments stay as they are, and so do the values of a whole file (`return M`) and declarations of constants of the language.
"""

import re
from dataclasses import dataclass

from lua_tokens import code_of

SWAPS = {
    '==': ['~='], '~=': ['=='], '<': ['<=', '>='], '<=': ['<', '>'], '>': ['>=', '<='], '>=': ['>', '<'],
    '*': ['/'], '/': ['*'], '//': ['/'], '%': ['*'], '&': ['|'], '|': ['&'],
    'and': ['or'], 'or': ['and'], 'true': ['false'], 'false': ['true'],
}
OPENING, CLOSING = frozenset('({['), frozenset(')}]')
# What can stand before a binary minus: the end of an operand.
OPERAND_ENDS = frozenset([')', ']', '}', 'nil', 'true', 'false', '...', 'end'])
BLOCK_ENDS = frozenset(['end', 'else', 'elseif', 'until'])
# A line is a statement of its own only if the one before cannot go on.
GOES_ON = frozenset('= , ( { [ + - * / % ^ .. and or not return local < > == ~= <= >= : . & |'.split())


@dataclass(frozen=True)
class Mutant:
    path: str  # below lua/library
    start: int
    end: int
    replacement: str
    line: int  # index, from 0
    function: int  # index into the functions of the file, -1: outside of all

    def apply(self, text):
        return text[:self.start] + self.replacement + text[self.end:]

    def lines(self, text):
        """The first changed line before and after, without indentation."""
        first = text.rfind('\n', 0, self.start) + 1
        last = text.find('\n', self.end)
        last = len(text) if last < 0 else last
        before = ' '.join(text[first:last].split())
        after = ' '.join((text[first:self.start] + self.replacement + text[self.end:last]).split())
        return before, after


def functions_of(tokens):
    """(start of the body, start of the last `end`) of every function, in the order of their bodies."""
    found, open_blocks = [], []
    for i, token in enumerate(tokens):
        if token.kind != 'keyword':
            continue
        if token.text == 'function':
            close = next(k for k in range(i, len(tokens)) if tokens[k].text == ')')
            open_blocks.append(tokens[close].end)
        elif token.text in ('do', 'then', 'repeat'):
            open_blocks.append(None)
        elif token.text in ('end', 'until', 'elseif', 'else'):
            start = open_blocks.pop()
            if start is not None:
                found.append((start, token.start))
            if token.text == 'else':
                open_blocks.append(None)
    return sorted(found)


def function_at(functions, place):
    inside = [i for i, (start, end) in enumerate(functions) if start <= place < end]
    return inside[-1] if inside else -1


def function_name(text, number):
    """The last part of the name of a function, None for one without or for no function."""
    if number < 0:
        return None
    start, _ = functions_of(code_of(text))[number]
    name = re.search(r'function [\w.:]*?(\w+) *\([^()]*\)$', text[:start])
    return name and name.group(1)


def is_binary(tokens, i):
    previous = tokens[i - 1]
    return previous.kind in ('name', 'number', 'string') or previous.text in OPERAND_ENDS


def end_of_expressions(tokens, i, stops):
    """Index of the first token at or after i, outside of brackets and functions, that is one of `stops`."""
    depth = 0
    while i < len(tokens):
        text = tokens[i].text
        if depth == 0 and text in stops and tokens[i].kind != 'string':
            return i
        if text in OPENING or text in ('function', 'do', 'then'):
            depth += 1
        elif text in CLOSING or text in ('end', 'elseif'):
            depth -= 1
        i += 1
    return i


def number_changes(text):
    if text.lower().startswith('0x'):
        return [hex(int(text, 16) + 1)]
    value = float(text)
    if re.fullmatch(r'\d+', text):
        return [str(int(text) + 1)] + ([str(int(text) - 1)] if int(text) > 0 else [])
    return [repr(value * 100)] if value != 0 else ['1.0']


def token_changes(_, tokens, i):
    """(start, end, replacement) for the changes of a single token."""
    token, changes = tokens[i], []
    if token.kind == 'number':
        changes = number_changes(token.text)
    elif token.kind in ('symbol', 'keyword') and token.text in SWAPS:
        is_attribute = token.text in '<>' and 'const' in (tokens[i + 1].text, tokens[i - 1].text)
        changes = [] if is_attribute or not is_binary(tokens, i) and token.text in ('&', '|') else SWAPS[token.text]
    elif token.text == '+' and token.kind == 'symbol':
        changes = ['-']
    elif token.text == '-' and token.kind == 'symbol':
        changes = ['+'] if is_binary(tokens, i) else ['']
    elif token.text == 'not' and token.kind == 'keyword':
        changes = ['']
    for text in changes:
        yield token.start, token.end, text


def condition_changes(_, tokens, i):
    """Conditions that always hold or never do; a loop that never runs."""
    if tokens[i].text not in ('if', 'elseif', 'while') or tokens[i].kind != 'keyword':
        return
    last = end_of_expressions(tokens, i + 1, ('then', 'do')) - 1
    condition = tokens[i + 1].start, tokens[last].end
    if last == i + 1 and tokens[last].text in ('true', 'false'):
        return
    yield *condition, 'false'
    if tokens[i].text != 'while':
        yield *condition, 'true'


def return_changes(_, tokens, i):
    """No value, or all but the last, from a function."""
    if tokens[i].text != 'return' or tokens[i].kind != 'keyword':
        return
    after = end_of_expressions(tokens, i + 1, BLOCK_ENDS | {';'})
    values = [t.text for t in tokens[i + 1:after]]
    if after >= len(tokens) or values in ([], ['nil'], ['false']):  # callers see no difference between the two
        return
    yield tokens[i + 1].start, tokens[after - 1].end, 'nil'
    comma, place = None, i + 1
    while True:
        place = end_of_expressions(tokens, place, (',',))
        if place >= after:
            break
        comma, place = place, place + 1
    if comma:
        yield tokens[comma].start, tokens[after - 1].end, ''


def loop_changes(text, tokens, i):
    """A numeric loop that ends one earlier."""
    if tokens[i].text != 'for' or tokens[i + 2].text != '=':
        return
    comma = end_of_expressions(tokens, i + 3, (',',))
    last = end_of_expressions(tokens, comma + 1, ('do', ',')) - 1
    start, end = tokens[comma + 1].start, tokens[last].end
    yield start, end, text[start:end] + ' - 1' if last == comma + 1 else f'({text[start:end]}) - 1'


def is_statement(tokens, first, last):
    """Whether tokens[first:last] are a whole call or assignment on a line of its own."""
    texts = [t.text for t in tokens[first:last]]
    depth = sum((t in OPENING) - (t in CLOSING) for t in texts)
    is_plain = tokens[first].kind == 'name' and depth == 0 and texts[-1] not in GOES_ON
    if not is_plain or {'function', 'then', 'do', 'end', 'return'} & set(texts):
        return False
    if first > 0 and tokens[first - 1].text in GOES_ON or last < len(tokens) and tokens[last].text in GOES_ON:
        return False
    depth = 0
    for token in tokens[:first]:  # inside of a table or of arguments a line is no statement
        depth += (token.text in OPENING and token.kind == 'symbol') - (token.text in CLOSING and token.kind == 'symbol')
    return depth == 0 and ('=' in texts or texts[-1] == ')' or tokens[last - 1].kind == 'string')


def statement_lines(tokens):
    """(first token, after the last) of each line that is a statement."""
    first = 0
    while first < len(tokens):
        last = first
        while last < len(tokens) and tokens[last].line == tokens[first].line:
            last += 1
        if is_statement(tokens, first, last):
            yield first, last
        first = last


def statement_changes(text, tokens, functions):
    """Statements left out, and calls in the wrong order."""
    lines = list(statement_lines(tokens))
    for n, (first, last) in enumerate(lines):
        start, end = tokens[first].start, tokens[last - 1].end
        if function_at(functions, start) >= 0:
            yield start, end, ''
        if n + 1 == len(lines) or lines[n + 1][0] != last:
            continue
        following = text[tokens[last].start:tokens[lines[n + 1][1] - 1].end]
        if '=' not in text[start:end] + following:
            yield start, tokens[lines[n + 1][1] - 1].end, following + text[end:tokens[last].start] + text[start:end]


def mutants_of(path, text):
    """All mutants of a file, by place."""
    tokens = code_of(text)
    functions = functions_of(tokens)
    changes = list(statement_changes(text, tokens, functions))
    for i in range(len(tokens)):
        for operator in (token_changes, condition_changes, return_changes, loop_changes):
            changes += operator(text, tokens, i)
    mutants = {
        Mutant(path, start, end, new, text.count('\n', 0, start), function_at(functions, start))
        for start, end, new in changes if text[start:end] != new
    }
    return sorted(mutants, key=lambda m: (m.start, m.end, m.replacement))
