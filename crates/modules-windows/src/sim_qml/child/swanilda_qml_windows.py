"""The windows of an interface: their pictures for the simulator, and the inputs of persons from there.

Nothing is on a screen: Qt draws into memory. A picture is sent when the simulator has asked for one and it differs from the last one.
"""
import time

from PySide6.QtCore import QBuffer, QCoreApplication, QEvent, QIODevice, QObject, QPoint, QPointF, Qt, QTimer
from PySide6.QtGui import QGuiApplication, QKeyEvent, QMouseEvent, QWheelEvent
from PySide6.QtQuick import QQuickWindow
from shiboken6 import isValid

LOOK = 100  # milliseconds between looks for new windows
GAP = 0.04  # seconds between two pictures of a window
QUALITY = 80  # of PNG: how much time goes into making it small
LARGEST = 8192  # pixels of a side
DOUBLE = 0.4, 5  # seconds and pixels between the two parts of a double click
NOTCH = 120 / 100  # Qt's units for a pixel of a page: browsers scroll by 100 pixels where Qt counts 120
BUTTONS = Qt.MouseButton.LeftButton, Qt.MouseButton.MiddleButton, Qt.MouseButton.RightButton
BITS = (1, Qt.MouseButton.LeftButton), (2, Qt.MouseButton.RightButton), (4, Qt.MouseButton.MiddleButton)
KINDS = {'down': QEvent.Type.MouseButtonPress, 'up': QEvent.Type.MouseButtonRelease, 'move': QEvent.Type.MouseMove}


class Window(QObject):
    """A window that the simulator knows by a number."""

    def __init__(self, link, number, window):
        super().__init__()
        self.link, self.number, self.window = link, number, window
        self.is_wanted = False
        self.is_dirty = True
        self.shown = None  # the last picture that was sent
        self.sent_at = 0.0
        self.state = None
        self.pressed = (0.0, QPointF())
        self.timer = QTimer(self, singleShot=True)
        self.timer.timeout.connect(self._deliver)
        window.frameSwapped.connect(self._drawn)
        for signal in (window.visibleChanged, window.widthChanged, window.heightChanged, window.windowTitleChanged):
            signal.connect(self.report)
        self.report()

    def report(self, *_):
        """Tells what has changed about the window beside its picture."""
        window = self.window
        fixed = window.minimumSize() == window.maximumSize()
        state = (window.title(), window.isVisible(), window.width(), window.height(), not fixed)
        if state != self.state:
            self.state = state
            self.link.send('window', self.number, *state)

    def want(self):
        self.is_wanted = True
        self._schedule()

    def _drawn(self):
        self.is_dirty = True
        self._schedule()

    def _schedule(self):
        if self.is_wanted and self.is_dirty and not self.timer.isActive():
            self.timer.start(max(0, round(1000 * (self.sent_at + GAP - time.monotonic()))))

    def _deliver(self):
        if not isValid(self.window) or not self.window.isVisible() or max(self.window.width(), self.window.height()) > LARGEST:
            return
        self.is_dirty = False
        image = self.window.grabWindow()
        if image.isNull() or image == self.shown:
            return
        self.shown = image
        self.is_wanted = False
        self.sent_at = time.monotonic()
        self.link.send('picture', self.number, image.width(), image.height(), png(image))

    def pointer(self, action, x, y, button, buttons, dx, dy, shift, control, alt):
        at = QPointF(x, y)
        held = Qt.MouseButton.NoButton
        for bit, one in BITS:
            if buttons & bit:
                held |= one
        keys = modifiers(shift, control, alt)
        if action == 'wheel':
            angle = QPoint(round(-dx * NOTCH), round(-dy * NOTCH))
            event = QWheelEvent(at, at, QPoint(), angle, held, keys, Qt.ScrollPhase.NoScrollPhase, False)
            return self._post(event)
        which = Qt.MouseButton.NoButton if action == 'move' else BUTTONS[button] if 0 <= button <= 2 else Qt.MouseButton.LeftButton
        if action == 'down':
            self.window.requestActivate()
        self._post(QMouseEvent(KINDS[action], at, at, which, held, keys))
        if action == 'down' and self._is_double(at):
            self._post(QMouseEvent(QEvent.Type.MouseButtonDblClick, at, at, which, held, keys))

    def _is_double(self, at):
        now = time.monotonic()
        then, place = self.pressed
        double = now - then < DOUBLE[0] and (at - place).manhattanLength() < DOUBLE[1]
        self.pressed = (0.0 if double else now, at)
        return double

    def key(self, down, key, text, shift, control, alt):
        kind = QEvent.Type.KeyPress if down else QEvent.Type.KeyRelease
        keys = modifiers(shift, control, alt)
        if down:
            self.window.requestActivate()
            override = QKeyEvent(QEvent.Type.ShortcutOverride, key, keys, text)
            self._post(override)
        self._post(QKeyEvent(kind, key, keys, text))

    def _post(self, event):
        if isValid(self.window):
            QCoreApplication.sendEvent(self.window, event)

    def resize(self, width, height):
        self.window.resize(min(width, LARGEST), min(height, LARGEST))

    def close(self):
        self.window.close()


class Windows(QObject):
    """All windows that were ever seen, by their numbers."""

    def __init__(self, link):
        super().__init__()
        self.link = link
        self.known = {}
        self.last = 0
        self.timer = QTimer(self, interval=LOOK)
        self.timer.timeout.connect(self.look)
        self.timer.start()

    def look(self):
        """Finds windows that have come and gone."""
        for number in [number for number, one in self.known.items() if not isValid(one.window)]:
            del self.known[number]
            self.link.send('gone', number)
        known = [one.window for one in self.known.values()]
        for window in QGuiApplication.topLevelWindows():
            if isinstance(window, QQuickWindow) and window.isVisible() and window not in known:
                self.last += 1
                self.known[self.last] = Window(self.link, self.last, window)
                window.requestActivate()

    def input(self, number, what, *args):
        """What the simulator says about a window; one that is gone needs nothing."""
        one = self.known.get(number)
        if one is not None and isValid(one.window):
            getattr(one, what)(*args)


def modifiers(shift, control, alt):
    keys = Qt.KeyboardModifier.NoModifier
    for held, key in ((shift, Qt.KeyboardModifier.ShiftModifier), (control, Qt.KeyboardModifier.ControlModifier), (alt, Qt.KeyboardModifier.AltModifier)):
        if held:
            keys |= key
    return keys


def png(image):
    buffer = QBuffer()
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    image.save(buffer, 'PNG', QUALITY)
    return bytes(buffer.data())
