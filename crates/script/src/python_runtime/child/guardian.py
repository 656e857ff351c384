"""First code of a script's process, and of other programs in Python: starts the process that runs the script, and ends everything with the simulator.

Standard input is the connection to the simulator. Standard output is a socket that closes when the simulator ends, however it ends.
This process only watches: it kills the script and all that the script has started, and reports how the script ended. It is in a process
group of its own, so that what ends the simulator's group leaves somebody who ends the script's.
"""
import marshal
import os
import select
import signal


def kill_group(pid):
    try:
        os.killpg(pid, signal.SIGKILL)
    except OSError:
        pass  # nobody is left


def watch(child, lifeline, wake):
    """Waits for the end of the script or of the simulator."""
    for number in (signal.SIGINT, signal.SIGHUP, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)
    while True:
        readable, _, _ = select.select([lifeline, wake], [], [])
        if lifeline in readable:
            kill_group(child)
            os.waitpid(child, 0)
            os._exit(0)
        os.read(wake, 4096)
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            kill_group(child)
            if os.WIFSIGNALED(status):
                os._exit(128 + os.WTERMSIG(status))
            os._exit(os.WEXITSTATUS(status))


def split():
    """Returns the connection in the process of the script; the guardian never returns."""
    connection, lifeline = os.dup(0), os.dup(1)
    os.setpgid(0, 0)
    null = os.open(os.devnull, os.O_RDWR)
    os.dup2(null, 0)
    os.dup2(2, 1)
    os.close(null)
    wake, waker = os.pipe()
    os.set_blocking(waker, False)
    default = signal.signal(signal.SIGCHLD, lambda *_: None)
    signal.set_wakeup_fd(waker)
    child = os.fork()
    if child == 0:
        os.setpgid(0, 0)
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, default)
        for fd in (lifeline, wake, waker):
            os.close(fd)
        return connection
    try:
        os.setpgid(child, child)
    except OSError:
        pass  # it has done so itself, or has ended
    os.close(connection)
    watch(child, lifeline, wake)


def read_exactly(fd, count):
    parts = b''
    while len(parts) < count:
        part = os.read(fd, count - len(parts))
        if not part:
            os._exit(0)
        parts += part
    return parts


def load_modules(texts):
    """Makes modules of the texts, which are named in the order of their dependencies; the last one."""
    import sys
    import types

    for name, text in texts:
        module = types.ModuleType(name)
        sys.modules[name] = module
        exec(compile(text, '<%s>' % name, 'exec'), module.__dict__)
    return module


connection = split()
main = load_modules(marshal.loads(read_exactly(connection, int.from_bytes(read_exactly(connection, 4), 'little'))))
main.run(connection)
