"""A script: its text, its functions, its output, and the calls that the simulator makes."""
import builtins
import linecache
import os
import pydoc
import sys

import swanilda_api as api
import swanilda_coverage as coverage
import swanilda_link as link
import swanilda_seed as seed
import swanilda_trace as trace

scope = {}  # the script's globals


class OwnProcess:
    """What a script changes in a process that it has for itself."""

    names = vars(builtins)  # what the modules that it imports see as well

    def import_from(self, folders):
        sys.path[:] = [path for path in folders if path not in sys.path] + [path for path in sys.path if path]

    def set_main(self, module):
        """Code that is imported finds the script as the main module."""
        sys.modules['__main__'] = module


surroundings = OwnProcess()


class Output:
    """A stream whose text goes to the simulator."""

    encoding = 'utf-8'
    errors = 'replace'
    closed = False

    def __init__(self, number):
        self.number = number

    def write(self, text):
        if not isinstance(text, str):
            raise TypeError('write() argument must be str, not %s' % type(text).__name__)
        if not link.may_call():
            os.write(self.number, text.encode('utf-8', 'replace'))
        elif text:
            link.send(('w', self.number, text.encode('utf-8', 'replace').decode('utf-8')))
        return len(text)

    def writelines(self, lines):
        for line in lines:
            self.write(line)

    def flush(self):
        pass

    def isatty(self):
        return False

    def writable(self):
        return True

    def readable(self):
        return False

    def fileno(self):
        return self.number


class State:
    """What a script keeps between its functions, as `self`."""


def print_line(*values, **options):
    """print of a script: a line in the simulator's log."""
    if options or not link.may_call():
        return builtins.print(*values, **options)
    link.send(('p', ', '.join(map(str, values)).encode('utf-8', 'replace').decode('utf-8')))


def show_help(*subjects):
    if len(subjects) == 1 and isinstance(subjects[0], (api.Method, str)):
        name = subjects[0] if isinstance(subjects[0], str) else subjects[0].__name__
        return print_line(link.call('__help__', [name]) or 'no help for %s' % name)
    pydoc.help(*subjects)


def begin_scope(filename):
    scope.update(
        __name__='__main__', __file__=filename, __builtins__=surroundings.names, self=State(), require=api.require,
        print=print_line, help=show_help, quit=lambda: link.call('quitSimulator', []),
    )
    api.script_globals = scope
    api.namespaces['sim'] = api.Namespace('sim')
    implicit = {name: api.ImplicitNamespace(name) for name in api.IMPLICIT}
    surroundings.names.update(implicit, require=api.require, sim=api.namespaces['sim'])


def as_module():
    module = type(sys)('__main__')
    module.__dict__.update(scope)
    surroundings.set_main(module)
    return module.__dict__


def functions():
    return [name for name, value in scope.items() if callable(value) and name.startswith('sysCall_')]


def listen_for_debugger():
    """With --debug-python, a debugger of Python can come at any time; nothing waits for it."""
    if 'SWANILDA_DEBUG_PYTHON' not in os.environ:
        return
    try:
        import debugpy
    except ImportError:
        raise ImportError('--debug-python needs debugpy: %s -m pip install debugpy' % sys.executable) from None
    host, port = debugpy.listen(('127.0.0.1', 0))
    print_line('debugpy listens at %s:%d' % (host, port))


def load(texts, paths, counts):
    """Runs the script: its texts, each with the name of its file, the last of which is the script's own."""
    global scope
    surroundings.import_from(paths)
    begin_scope(texts[-1][0])
    scope = api.script_globals = as_module()
    listen_for_debugger()
    if counts:
        coverage.begin(texts, paths)
    for name, text in texts:
        linecache.cache[name] = (len(text), None, text.splitlines(True), name)
        exec(compile(text, name, 'exec', dont_inherit=True), scope)
    return functions()


def find(name):
    """A function of the script, or one that it has passed to the simulator."""
    value = link.functions.get(name)
    if value is None:
        first, *others = name.split('.')
        value = scope.get(first)
        for part in others:
            value = getattr(value, part, None)
    return value if callable(value) else None


def answer(function, *args):
    """Answers a call with results or with an error."""
    try:
        message = ('r', link.results_of(function(*args)))
    except link.passing:
        raise
    except BaseException as error:
        if isinstance(error, SystemExit):
            error = RuntimeError('a script cannot end its process; sim.stopSimulation() ends the simulation')
        return link.send(('e', trace.describe(error)))
    try:
        link.send(message)
    except ValueError as error:
        link.send(('e', 'a result cannot be passed: %s' % error))


parameter_counts = {}


def required_parameters(function):
    """How many arguments a callback needs: the simulator leaves out those that are nil at the end."""
    count = parameter_counts.get(function)
    if count is None:
        code = getattr(function, '__code__', None)
        count = code.co_argcount - len(function.__defaults__ or ()) if code and not hasattr(function, '__self__') else 0
        parameter_counts[function] = count
    return count


def call(name, args):
    function = find(name)
    if function is None:
        return link.send(('n',))
    if name.startswith('sysCall_') and len(args) < required_parameters(function):
        args = args + [None] * (required_parameters(function) - len(args))
    answer(function, *args)


def evaluate(text):
    try:
        code = compile(text, 'code', 'eval')
    except SyntaxError:
        exec(compile(text, 'code', 'exec'), scope)
        return None
    value = eval(code, scope)
    # A list is one value here, which the caller asked for.
    return [value] if isinstance(value, list) else value


def execute(text, name):
    linecache.cache[name] = (len(text), None, text.splitlines(True), name)
    exec(compile(text, name, 'exec'), scope)


def set_handlers():
    link.handlers.update(
        c=call,
        l=lambda *args: answer(lambda: load(*args)),
        v=lambda text: answer(evaluate, text),
        x=lambda text, name: answer(execute, text, name),
        t=lambda: answer(trace.calls_in_progress),
        k=lambda: answer(lambda: [coverage.take()]),
    )


def run(connection):
    link.open_link(connection)
    seed.begin(int(os.environ['PYTHONHASHSEED']))
    sys.stdout, sys.stderr = Output(1), Output(2)
    sys.argv = ['']
    sys.excepthook = lambda kind, error, tb: None if issubclass(kind, link.Ended) else sys.__excepthook__(kind, error, tb)
    set_handlers()
    link.serve()
