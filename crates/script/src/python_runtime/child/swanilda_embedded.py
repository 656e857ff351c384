"""A script in the simulator's own process: calls in place of messages.

Functions of the script run on the simulator's thread. Its `sysCall_thread` has a thread of its own, which exchanges messages with the
simulator's as a script's process does.
"""
import ctypes
import queue
import threading

import swanilda_link as link
import swanilda_script as script
import swanilda_trace as trace

GRACE = 0.1  # seconds for the thread to end by itself


class Embedded:
    def __init__(self, calls, surroundings):
        self.calls = calls
        self.short = {}  # by the name of a function: whether it returns at once
        self.owner = link.ident()
        self.answer = None  # the script's, to what the simulator asked
        self.reply = None  # the simulator's, to what the script called
        self.thread = None
        self.to_thread, self.from_thread = queue.SimpleQueue(), queue.SimpleQueue()
        self.ended = False
        self.depth = 0  # of what the simulator asks
        script.surroundings = surroundings
        trace.foreign.add(surroundings.file)
        script.set_handlers()
        link.callers.add(self.owner)
        link.send, link.receive = self.send, self.receive
        link.passing = (link.Ended, KeyboardInterrupt)

    # ---- for the script

    def send(self, message):
        data = link.dumps(message, link.VERSION)
        if link.ident() != self.owner:
            self.check_end()
            self.from_thread.put(data)
        elif message[0] in 'ren':
            self.answer = data
        else:
            self.check_end()
            serve = self.calls.serve_at_once if self.is_short(message) else self.calls.serve
            self.reply = serve(data)

    def is_short(self, message):
        kind, name = message[:2]
        if kind != 'c':
            return True
        if name not in self.short:
            self.short[name] = self.calls.is_short(name)
        return self.short[name]

    def receive(self):
        if link.ident() == self.owner:
            return link.loads(self.reply)
        data = self.to_thread.get()
        self.check_end()
        return link.loads(data)

    def check_end(self):
        if self.ended and self.depth == 0 and link.ident() == self.owner:
            raise RuntimeError('the script has ended')
        if self.ended:
            raise link.Ended(0)

    # ---- for the simulator

    def ask(self, data):
        """Does what the simulator asks; returns the answer."""
        message = link.loads(data)
        self.depth += 1
        try:
            link.handlers[message[0]](*message[1:])
        finally:
            self.depth -= 1
        answer, self.answer = self.answer, None
        return answer

    def hand_over(self, data):
        """The call of the thread's function, which starts it; or an answer to what it called."""
        if self.thread and self.thread.is_alive():
            self.to_thread.put(data)
        else:
            self.thread = threading.Thread(target=self.run_thread, args=(link.loads(data),), name='sysCall_thread', daemon=True)
            self.thread.start()

    def run_thread(self, message):
        link.callers.add(link.ident())
        try:
            link.handlers[message[0]](*message[1:])
        except link.Ended:
            pass
        finally:
            link.callers.discard(link.ident())

    def take(self, seconds):
        """What the thread says; None when it says nothing meanwhile."""
        try:
            return self.from_thread.get(timeout=seconds)
        except queue.Empty:
            return None

    def close(self):
        """Ends the thread: where it calls the simulator, and otherwise between two of its instructions."""
        self.ended = True
        script.surroundings.close()
        thread = self.thread
        if not thread or not thread.is_alive():
            return
        self.to_thread.put(None)
        thread.join(GRACE)
        if thread.is_alive():
            ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread.ident), ctypes.py_object(link.Ended))
            thread.join(GRACE)
