"""Changing Lua text that is embedded in the command, without building it again.

The text lies in the command as it is. A changed text of the same length takes its place; comments give the room that is needed.
"""

import os
import shutil

from lua_tokens import tokenize


def fit(text, length):
    """The text with comments shortened, or lengthened, so that it has that many bytes and its lines stay where they are.

    None if there is not enough room.
    """
    missing = length - len(text.encode())
    comments = [token for token in tokenize(text) if token.kind == 'comment' and not token.text.startswith('--[=')]
    if missing >= 0:
        return text.ljust(len(text) + missing)
    for comment in sorted(comments, key=lambda c: -len(c.text)):
        shorter = cut(comment.text, -missing)
        missing += len(comment.text.encode()) - len(shorter.encode())
        text = text[:comment.start] + shorter.ljust(len(comment.text), '\0') + text[comment.end:]
        if missing >= 0:
            return text.replace('\0', '').ljust(len(text.replace('\0', '')) + missing)
    return None


def cut(comment, count):
    """A comment without up to `count` of its characters; line ends and brackets stay."""
    is_block = comment.startswith('--[[')
    body = comment[4:-2] if is_block else comment[2:]
    kept = []
    for letter in body:
        if letter == '\n' or count <= 0:
            kept.append(letter)
        else:
            count -= len(letter.encode())
    return f'--[[{"".join(kept)}]]' if is_block else '--' + ''.join(kept)


class Command:
    """A copy of the command whose embedded texts can be replaced."""

    def __init__(self, original, path):
        shutil.copyfile(original, path)
        os.chmod(path, 0o755)
        self.path = path
        with open(path, 'rb') as file:
            self.content = file.read()
        self.places = {}

    def places_of(self, text):
        """Where a text is embedded: all copies."""
        if text not in self.places:
            data, found = text.encode(), []
            place = self.content.find(data)
            while place >= 0:
                found.append(place)
                place = self.content.find(data, place + 1)
            if not found:
                raise ValueError('a Lua file is not in the command as it is in the working tree: run cargo build --release first')
            self.places[text] = found
        return self.places[text]

    def replace(self, text, by):
        """Writes `by`, of the same length, in the place of an original text."""
        with open(self.path, 'r+b') as file:
            for place in self.places_of(text):
                file.seek(place)
                file.write(by.encode())
