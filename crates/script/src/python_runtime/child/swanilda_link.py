"""The connection to the simulator: messages, values that can pass, functions that were passed.

A message is a tuple, written by marshal, behind its length. One side has the turn: a call is answered by its results ('r') or its error
('e'), and in between the other side may call ('c') in turn. Texts to print ('p', 'w') need no answer.
"""
import marshal
import os
import socket
import threading

dumps, loads = marshal.dumps, marshal.loads
read, write = os.read, os.write
ident = threading.get_ident

VERSION = 2  # of marshal: without references
LONGEST = 256 << 20  # bytes of a message that the simulator reads
PART = 1 << 16
SCALARS = frozenset((int, float, str, bytes, bool, type(None)))
LOOKED_THROUGH = 16  # entries of a container that may be functions
LOOKS = 30  # for an answer, before sleeping: to be woken takes longer than most answers
AT_ONCE = getattr(socket, 'MSG_DONTWAIT', 0)

fd = -1
receive_part = None
rest = b''
callers = set()  # the threads that may call the simulator
handlers = {}  # what to do with messages that are calls, by kind
functions = {}  # functions that were passed to the simulator, by name
names = {}  # and their names
forked = False


class Ended(SystemExit):
    """The simulator has ended the script."""


passing = (Ended,)  # exceptions that are no errors of functions


def open_link(connection):
    global fd, receive_part
    fd = connection
    receive_part = socket.socket(fileno=connection).recv
    callers.add(ident())
    os.register_at_fork(after_in_child=close_in_fork)


def close_in_fork():
    """A process that the script has forked has no connection."""
    global forked
    if not forked:
        os.close(fd)
    callers.clear()
    forked = True


def send(message):
    data = dumps(message, VERSION)
    if len(data) > LONGEST:
        raise ValueError('%d bytes are too many for one message' % len(data))
    data = len(data).to_bytes(4, 'little') + data
    try:
        sent = write(fd, data)
        while sent < len(data):
            data = data[sent:]
            sent = write(fd, data)
    except OSError:
        raise Ended(0) from None


def receive():
    global rest
    data = rest
    while True:
        if len(data) >= 4:
            end = 4 + int.from_bytes(data[:4], 'little')
            if len(data) >= end:
                rest = data[end:]
                return loads(data[4:end])
        part = next_part()
        if not part:
            raise Ended(0)
        data += part


def next_part():
    """What comes next of the connection; nothing at its end."""
    try:
        for _ in range(LOOKS):
            try:
                return receive_part(PART, AT_ONCE)
            except BlockingIOError:
                os.sched_yield()
        return read(fd, PART)
    except OSError:
        return b''


def may_call():
    return ident() in callers


def check_caller():
    if forked:
        raise RuntimeError('a process that a script has forked cannot call the simulator')
    if not may_call():
        raise RuntimeError("only the script's main thread can call the simulator")


def call(name, args):
    """Calls a function of the simulator."""
    if ident() not in callers:
        check_caller()
    for arg in args:
        if type(arg) not in SCALARS:
            args = [passable(arg, 0) for arg in args]
            break
    try:
        send(('c', name, args))
    except ValueError as error:
        raise ValueError('an argument of %s cannot be passed: %s' % (name, error)) from None
    while True:
        message = receive()
        kind = message[0]
        if kind == 'r':
            results = message[1]
            count = len(results)
            return results[0] if count == 1 else tuple(results) if count else None
        if kind == 'e':
            raise Exception(message[1])
        handlers[kind](*message[1:])


def serve():
    """Does what the simulator asks, until it ends the script."""
    while True:
        message = receive()
        handlers[message[0]](*message[1:])


def passable(value, depth):
    """The value with what marshal can write: lists, plain numbers, functions by name."""
    kind = type(value)
    if kind in SCALARS:
        return value
    if kind is list or kind is tuple:
        if SCALARS.issuperset(map(type, value)):
            return value
        return [passable(item, depth + 1) if place < LOOKED_THROUGH or not callable(item) else bad(item)
                for place, item in enumerate(value)]
    if kind is dict:
        return {passable(key, depth + 1): passable(item, depth + 1) for key, item in value.items()}
    if callable(value) and not hasattr(value, 'tolist'):
        return pass_function(value) if depth < 2 else bad(value)
    if kind in (bytearray, memoryview):
        return bytes(value)
    if hasattr(value, 'tolist'):  # numpy's
        return passable(value.tolist(), depth)
    for plain in (bool, int, float, str, bytes, dict, list, tuple):
        if isinstance(value, plain):
            return passable(plain.__new__(plain, value) if plain in (int, float, str) else plain(value), depth)
    if isinstance(value, (set, frozenset)):
        return passable(list(value), depth)
    return bad(value)


def bad(value):
    text = '_*baddata*_' + repr(value)
    send(('w', 2, 'a value cannot be passed to the simulator: %s\n' % text))
    return text


def pass_function(function):
    """The name under which the simulator calls a function of this process."""
    key = function
    try:
        name = names.get(key)
    except TypeError:  # not hashable
        key, name = id(function), names.get(id(function))
    if name is None:
        name = '%s_%x' % (getattr(function, '__name__', 'function'), id(function))
        name = ''.join(letter if letter.isalnum() or letter == '_' else '_' for letter in name)
        names[key], functions[name] = name, function
    return name + '@func'


def results_of(value):
    """What a function returned, as a list of results: a list is several."""
    if value is None:
        return []
    if type(value) is list:
        return passable(value, 0)
    return [passable(value, 0)]
