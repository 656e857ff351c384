"""Finds which cases run which function of the library: only these can notice a fault in it.

Each function says once, in each Lua state, that it was called. The calls are put into the embedded texts, in the room that their
comments leave.
"""

import re

from embedded import fit
from lua_tokens import code_of, tokenize
from operators import functions_of

SAID = re.compile(r'@reached (\S+) (-?\d+)@')
PROBE = (
    "local r_p,r_s=print,{}local function r_(n)if not r_s[n]then r_s[n]=1 r_p('@reached %s '..n..'@')end end r_(-1)"
)


def without_comments(text):
    """The same lines without comments."""
    for token in reversed([t for t in tokenize(text) if t.kind == 'comment']):
        text = text[:token.start] + '\n' * token.text.count('\n') + text[token.end:]
    return text


def probed(path, text):
    """The text of a file whose functions say that they are called, as long as before."""
    plain = without_comments(text)
    length = len(text.encode())
    functions = functions_of(code_of(plain))
    for number, (start, _) in reversed(list(enumerate(functions))):
        plain = f'{plain[:start]} r_({number}) {plain[start:]}'
    first = code_of(plain)[0].start
    result = fit(f'{plain[:first]}{PROBE % path} {plain[first:]}', length)
    if result is None:
        raise ValueError(f'{path}: comments leave too little room to find out who calls its functions')
    return result


def reached(output):
    return {(path, int(number)) for path, number in SAID.findall(output)}
