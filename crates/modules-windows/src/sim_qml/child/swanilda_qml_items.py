"""Items of an interface for tests: found by their `objectName`, else by the text on them; read, clicked, set."""
import time

from PySide6.QtCore import QCoreApplication, QMetaObject, QObject, QPointF, Qt, Q_ARG, Q_RETURN_ARG
from PySide6.QtQml import QQmlEngine
from PySide6.QtQuick import QQuickItem
from shiboken6 import isValid

VALUES = 'value', 'currentText', 'checked', 'text', 'count'  # the first that an item has is what a person sees of it
RETURN = 0x01000004
REST = 0.005  # seconds that an interface gets for what an input has begun


class Refused(Exception):
    """Why something is not done."""


class Items:
    def __init__(self, windows):
        self.windows = windows
        self.found = []  # an item's number is its place

    def find(self, number, name):
        """The number of an item."""
        items = sorted(everything(self._window(number).window), key=lambda item: not is_own(item))
        for item in items:
            if item.objectName() == name:
                return self._number(item)
        for item in items:
            if item.property('text') == name and isinstance(item, QQuickItem) and item.isVisible():
                return self._number(item)
        names = ', '.join(sorted("%s '%s'" % (kind(item), item.objectName()) for item in items if item.objectName() and is_own(item)))
        there = 'it has: %s.' % names if names else 'none of its items has an objectName.'
        raise Refused("window '%s' has no item '%s'; %s" % (self._window(number).window.title(), name, there))

    def state(self, number, item):
        item = self._item(item)
        return [plain(value(item)), kind(item), enabled(item), self._window(number).window.isVisible() and visible(item)]

    def act(self, number, item, action, argument):
        item = self._item(item)
        name = item.objectName() or kind(item)
        if not self._window(number).window.isVisible():
            raise Refused("window '%s' is not visible" % self._window(number).window.title())
        if not visible(item):
            raise Refused("item '%s' is not visible" % name)
        if not enabled(item):
            raise Refused("item '%s' is disabled" % name)
        do = {'click': self._click, 'value': self._set, 'finish': self._finish, 'key': self._key}.get(action)
        if do is None:
            raise Refused("an item of QML takes no '%s'" % action)
        do(self._window(number), item, argument)
        rest()
        return True

    def rest(self, _):
        """What persons have done before has its effects."""
        rest()
        return True

    def _window(self, number):
        one = self.windows.known.get(number)
        if one is None:
            raise Refused('the window is gone')
        return one

    def _number(self, item):
        for number, other in enumerate(self.found):
            if other is item:
                return number
        self.found.append(item)
        return len(self.found) - 1

    def _item(self, number):
        if not 0 <= number < len(self.found) or not isValid(self.found[number]):
            raise Refused('the item is gone')
        return self.found[number]

    def _click(self, window, item, _):
        if not isinstance(item, QQuickItem):
            raise Refused("%s '%s' is nothing to click" % (kind(item), item.objectName()))
        at = item.mapToScene(QPointF(item.width() / 2, item.height() / 2))
        if not (0 <= at.x() < window.window.width() and 0 <= at.y() < window.window.height()):
            raise Refused("item '%s' is outside of the window" % item.objectName())
        window.pressed = (0.0, at)  # no double click
        for action, buttons in (('move', 0), ('down', 1), ('up', 0)):
            window.pointer(action, at.x(), at.y(), 0, buttons, 0, 0, False, False, False)
            QCoreApplication.processEvents()

    def _set(self, window, item, wanted):
        if has(item, 'model') and has(item, 'currentIndex') and has(item, 'currentText'):
            return self._choose(item, wanted)
        name = next((name for name in VALUES if name != 'count' and has(item, name)), None)
        if name is None:
            raise Refused("item '%s' has no value" % item.objectName())
        if name == 'checked':
            if bool(wanted) != item.property('checked'):
                self._click(window, item, None)
            return
        item.setProperty(name, wanted)
        for signal in ('moved', 'valueModified', 'textEdited'):
            emit(item, signal)

    def _choose(self, item, wanted):
        count = item.property('count')
        texts = [call(item, 'textAt', place) for place in range(count)]
        place = texts.index(wanted) if wanted in texts else wanted
        if not isinstance(place, int) or not 0 <= place < count:
            raise Refused('there is no such choice: it is one of %r' % texts)
        item.setProperty('currentIndex', place)
        emit(item, 'activated', place)

    def _finish(self, window, item, _):
        focus(window, item)
        self._press(window, RETURN, '\r')

    def _key(self, window, item, argument):
        focus(window, item)
        key, text = argument if isinstance(argument, list) else (argument, '')
        self._press(window, int(key), text or '')

    def _press(self, window, key, text):
        for down in (True, False):
            window.key(down, key, text, False, False, False)


def everything(window):
    """The window, its items as they lie in each other, and what else belongs to it."""
    seen, waiting = [], [window, window.contentItem()]
    while waiting:
        one = waiting.pop(0)
        if one is None or any(one is other for other in seen):
            continue
        seen.append(one)
        yield one
        if isinstance(one, QQuickItem):
            waiting.extend(one.childItems())
        if one is window:
            waiting.extend(child for child in one.findChildren(QObject) if child.objectName())


def is_own(item):
    """Whether the interface itself has made it, not one of Qt's types."""
    context = QQmlEngine.contextForObject(item)
    return context is not None and kind(item) != 'RootItem' and context.baseUrl().scheme() != 'qrc'


def has(item, name):
    return item.metaObject().indexOfProperty(name) >= 0


def value(item):
    for name in VALUES:
        if has(item, name) and (name != 'checked' or item.property('checkable') is not False):
            return item.property(name)
    return None


def plain(value):
    return value if isinstance(value, (bool, int, float, str)) else None


def kind(item):
    """The name of its type as QML has it."""
    name = item.metaObject().className().split('_QML')[0]
    return name.removeprefix('QQuick') if name.startswith('QQuick') else name


def visible(item):
    return not isinstance(item, QQuickItem) or item.isVisible()


def enabled(item):
    return not isinstance(item, QQuickItem) or item.isEnabled()


def focus(window, item):
    window.window.requestActivate()
    if isinstance(item, QQuickItem):
        item.forceActiveFocus(Qt.FocusReason.OtherFocusReason)


def emit(item, signal, *args):
    """Emits a signal of that name, if the item has one."""
    meta = item.metaObject()
    names = {bytes(meta.method(place).name()).decode() for place in range(meta.methodCount())}
    if signal in names:
        QMetaObject.invokeMethod(item, signal, Qt.ConnectionType.DirectConnection, *[Q_ARG(int, arg) for arg in args])


def call(item, method, place):
    return QMetaObject.invokeMethod(item, method, Qt.ConnectionType.DirectConnection, Q_RETURN_ARG(str), Q_ARG(int, place))


def rest():
    """What an input has begun goes on a little."""
    end = time.monotonic() + REST
    QCoreApplication.processEvents()
    while time.monotonic() < end:
        QCoreApplication.processEvents()
        time.sleep(0.001)
