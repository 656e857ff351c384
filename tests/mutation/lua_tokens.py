"""Tokens of Lua text with their places. Comments and strings are single tokens, so that nothing in them is taken for code."""

import re
from dataclasses import dataclass

KEYWORDS = frozenset(
    'and break do else elseif end false for function goto if in local nil not or repeat return then true until while'.split()
)
LONG_BRACKET = re.compile(r'\[(=*)\[')
PATTERNS = (
    ('space', re.compile(r'\s+')),
    ('name', re.compile(r'[A-Za-z_]\w*')),
    ('number', re.compile(r'0[xX][\da-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?')),
    ('string', re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'', re.S)),
    ('symbol', re.compile(r'\.\.\.|\.\.|==|~=|<=|>=|//|<<|>>|::|[-+*/%^#&~|<>=(){}\[\];:,.]')),
)


@dataclass(frozen=True)
class Token:
    kind: str  # comment, string, name, keyword, number or symbol
    text: str
    start: int
    line: int  # index, from 0

    @property
    def end(self):
        return self.start + len(self.text)


def long_bracket_end(text, start):
    """Where the long bracket that begins at `start` ends, or None if none begins there."""
    opening = LONG_BRACKET.match(text, start)
    if not opening:
        return None
    closing = ']' + opening.group(1) + ']'
    return text.index(closing, opening.end()) + len(closing)


def comment_end(text, start):
    line_end = text.find('\n', start)
    return long_bracket_end(text, start + 2) or (len(text) if line_end < 0 else line_end)


def next_token(text, start):
    """Kind and end of the token at `start`."""
    if text.startswith('--', start):
        return 'comment', comment_end(text, start)
    long_end = long_bracket_end(text, start)
    if long_end:
        return 'string', long_end
    for kind, pattern in PATTERNS:
        match = pattern.match(text, start)
        if match:
            is_keyword = kind == 'name' and match.group() in KEYWORDS
            return 'keyword' if is_keyword else kind, match.end()
    raise ValueError(f'not Lua at line {text.count(chr(10), 0, start) + 1}: {text[start:start + 20]!r}')


def tokenize(text):
    """All tokens but space, in order."""
    tokens, place, line = [], 0, 0
    while place < len(text):
        kind, end = next_token(text, place)
        if kind != 'space':
            tokens.append(Token(kind, text[place:end], place, line))
        line += text.count('\n', place, end)
        place = end
    return tokens


def code_of(text):
    """The tokens that are not comments."""
    return [token for token in tokenize(text) if token.kind != 'comment']
