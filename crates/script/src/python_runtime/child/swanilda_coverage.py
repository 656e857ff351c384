"""Lines of the script and of the files it imports from its folders that have run, and the lines that can run."""
import os
import sys
import threading

ran = {}  # by file: the lines that have run
told = {}  # by file: those the simulator knows of
wanted = {}  # by file name of code: whether it is counted
own = {}  # texts of the script itself, by name
folders = ()


def is_counted(filename):
    known = wanted.get(filename)
    if known is None:
        path = os.path.abspath(filename)
        known = filename in own or any(path.startswith(folder + os.sep) for folder in folders)
        known = known and 'site-packages' not in path
        wanted[filename] = known
        if known:
            ran.setdefault(filename, set())
    return known


def begin(texts, paths):
    """Counts the lines of these texts, and of files below these folders."""
    global folders
    own.update(texts)
    folders = tuple(os.path.abspath(path) for path in paths if path)
    if hasattr(sys, 'monitoring'):
        begin_monitoring(sys.monitoring)
    else:
        sys.settrace(on_call)
        threading.settrace(on_call)


def begin_monitoring(monitoring):
    monitoring.use_tool_id(monitoring.COVERAGE_ID, 'swanilda')
    monitoring.register_callback(monitoring.COVERAGE_ID, monitoring.events.LINE, on_line)
    monitoring.set_events(monitoring.COVERAGE_ID, monitoring.events.LINE)


def on_line(code, line):
    # Each place is told once, whatever the answer: what runs often costs nothing more.
    if is_counted(code.co_filename):
        ran[code.co_filename].add(line)
    return sys.monitoring.DISABLE


def on_call(frame, event, arg):
    return on_trace if is_counted(frame.f_code.co_filename) else None


def on_trace(frame, event, arg):
    if event == 'line':
        ran[frame.f_code.co_filename].add(frame.f_lineno)
    return on_trace


def functions_of(code, found):
    """The first line, the name and the lines that can run of all functions: 0 is that of the text itself."""
    first = 0 if code.co_name == '<module>' else code.co_firstlineno
    lines = {line for _, _, line in lines_of(code) if line and line != first}
    found.append([first, code.co_name if first else None, sorted(lines)])
    for constant in code.co_consts:
        if hasattr(constant, 'co_code'):
            functions_of(constant, found)
    return found


def lines_of(code):
    if hasattr(code, 'co_lines'):
        return code.co_lines()
    import dis

    return [(0, 0, line) for _, line in dis.findlinestarts(code)]  # Python 3.9


def text_of(name):
    if name in own:
        return own[name]
    try:
        with open(name, encoding='utf-8') as file:
            return file.read()
    except (OSError, UnicodeDecodeError):
        return ''


def take():
    """By file: the lines that have run since the last time, and its functions."""
    taken = {}
    for name, lines in list(ran.items()):
        known = told.setdefault(name, set())
        new = lines - known
        known |= new
        try:
            code = compile(text_of(name), name, 'exec', dont_inherit=True)
        except SyntaxError:
            continue
        taken[name] = [sorted(new), functions_of(code, [])]
    return taken
