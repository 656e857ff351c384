"""The connection of an interface to the simulator: messages in frames. They are read when they come, and written by a thread.

A message is a tuple, written by marshal, behind its length of four bytes. The first entry says what it is.
"""
import marshal
import os
import queue
import sys
import threading

VERSION = 2  # of marshal: without references
LONGEST = 32 << 20  # bytes of a message that the simulator reads
MOST = 256 << 20  # bytes that wait for a simulator which reads nothing
PART = 1 << 16
LAST = 5  # seconds for what is to be written before the end


class Link:
    def __init__(self, connection):
        self.connection = connection
        self.rest = b''
        self.waiting = queue.SimpleQueue()
        self.size = 0
        self.lock = threading.Lock()
        self.writer = threading.Thread(target=self._write, daemon=True)
        self.writer.start()

    def send(self, *message):
        """Never waits: an interface goes on while the simulator is busy."""
        data = marshal.dumps(message, VERSION)
        if len(data) > LONGEST:
            raise ValueError('%d bytes are too many for one message' % len(data))
        with self.lock:
            self.size += len(data)
            if self.size > MOST:
                sys.stderr.write('The interface sends more than the simulator reads.\n')
                os._exit(3)
        self.waiting.put(len(data).to_bytes(4, 'little') + data)

    def _write(self):
        while True:
            data = self.waiting.get()
            if data is None:
                return
            with self.lock:
                self.size -= len(data) - 4
            while data:
                try:
                    data = data[os.write(self.connection, data):]
                except OSError:
                    os._exit(0)  # the simulator has ended

    def finish(self):
        """Waits until what was sent is written."""
        self.waiting.put(None)
        self.writer.join(LAST)

    def first(self):
        """Waits for the first message; None if there is none."""
        messages = []
        while not messages:
            messages = self.received()
            if messages is None:
                return None
        return messages[0]

    def received(self):
        """The messages that are there, once something has come; None at the end of the connection."""
        try:
            part = os.read(self.connection, PART)
        except OSError:
            part = b''
        if not part:
            return None
        self.rest += part
        messages = []
        while len(self.rest) >= 4:
            end = 4 + int.from_bytes(self.rest[:4], 'little')
            if len(self.rest) < end:
                break
            messages.append(marshal.loads(self.rest[4:end]))
            self.rest = self.rest[end:]
        return messages
