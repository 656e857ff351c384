"""What runs an interface, once there is Qt."""
import os
import sys
import traceback

from PySide6.QtCore import Property, QObject, QSocketNotifier, QtMsgType, QUrl, Signal, Slot, qInstallMessageHandler
from PySide6.QtGui import QGuiApplication
from PySide6.QtQml import QQmlApplicationEngine, QQmlComponent, QQmlEngine, qmlRegisterType
from PySide6.QtQuick import QQuickItem, QQuickWindow
from swanilda_qml_items import Items, Refused
from swanilda_qml_windows import Windows

LEVELS = {QtMsgType.QtDebugMsg: 'info', QtMsgType.QtInfoMsg: 'info', QtMsgType.QtWarningMsg: 'warning'}


class PluginWindow(QQuickWindow):
    """The window that interfaces for CoppeliaSim begin with: it is seen at once."""

    def __init__(self, parent=None):
        super().__init__(parent)
        self.setVisible(True)


class Pipe(QObject):
    """Events, both ways."""

    received = Signal(str, str, arguments=['name', 'text'])

    def __init__(self, link):
        super().__init__()
        self.link = link

    @Slot(str, str)
    def send(self, name, text):
        self.link.send('event', name, text)


class Interface:
    def __init__(self, link, bridge):
        self.link = link
        self.app = QGuiApplication(['swanilda'])
        self.app.setQuitOnLastWindowClosed(False)
        qInstallMessageHandler(lambda kind, context, text: self._say(LEVELS.get(kind, 'error'), context, text))
        qmlRegisterType(PluginWindow, 'CoppeliaSimPlugin', 1, 0, 'PluginWindow')
        self.engine = QQmlApplicationEngine()
        self.engine.setOutputWarningsToStandardError(False)
        self.engine.warnings.connect(self._warn)
        self.engine.exit.connect(lambda _: self._hide())
        self.engine.quit.connect(self._hide)
        self.problems = None  # those of a load
        self.pipe = Pipe(link)
        context = self.engine.rootContext()
        context.setContextProperty('pipe', self.pipe)
        self.component = QQmlComponent(self.engine)
        self.component.setData(bridge, QUrl('simBridge'))
        self.bridge = self.component.create()
        QQmlEngine.setObjectOwnership(self.bridge, QQmlEngine.ObjectOwnership.CppOwnership)
        context.setContextProperty('simBridge', self.bridge)
        self.windows = Windows(link)
        self.items = Items(self.windows)
        self.handlers = {
            'load': self._load, 'event': self.pipe.received.emit, 'input': self.windows.input, 'find': self._answer(self.items.find),
            'state': self._answer(self.items.state), 'act': self._answer(self.items.act), 'rest': self._answer(self.items.rest),
        }

    def serve(self):
        self.notifier = QSocketNotifier(self.link.connection, QSocketNotifier.Type.Read)
        self.notifier.activated.connect(self._receive)
        self.app.exec()

    def _receive(self, *_):
        messages = self.link.received()
        if messages is None:
            os._exit(0)
        for kind, *args in messages:
            try:
                self.handlers[kind](*args)
            except Exception:
                traceback.print_exc()
        self.windows.look()

    def _answer(self, do):
        """A question with a number, which its answer has as well. Windows that have come meanwhile are sent before."""
        def ask(number, *args):
            try:
                answer = do(*args)
                self.windows.look()
                self.link.send('answer', number, answer)
            except Refused as refused:
                self.link.send('refused', number, str(refused))
            except Exception as error:
                traceback.print_exc()
                self.link.send('refused', number, repr(error))
        return ask

    def _load(self, source, name):
        self.problems, before = [], len(self.engine.rootObjects())
        self.engine.loadData(source, QUrl.fromLocalFile(os.path.abspath(name)) if os.path.dirname(name) else QUrl(name))
        problems, self.problems = self.problems, None
        roots = self.engine.rootObjects()
        if len(roots) == before:
            self.link.send('failed', '\n'.join(problems) or 'nothing was loaded')
            return
        root = roots[-1]
        if isinstance(root, QQuickItem):
            self._frame(root)
        self.bridge.setProperty('root', root)
        self.bridge.setProperty('handlers', declared(root))
        for problem in problems:
            self.link.send('said', 'warning', problem)
        self.windows.look()
        if not self.windows.known:
            self.link.send('said', 'info', "no window is seen yet: a Window needs 'visible: true'")
        self.link.send('loaded')

    def _frame(self, item):
        """A window around an interface that has none."""
        self.frame = QQuickWindow(title='QML')
        item.setParentItem(self.frame.contentItem())
        self.frame.resize(max(int(item.width() or item.implicitWidth()), 1), max(int(item.height() or item.implicitHeight()), 1))
        self.frame.show()

    def _hide(self):
        """`Qt.quit()` closes the windows; the engine is the script's."""
        for window in self.app.topLevelWindows():
            window.hide()

    def _warn(self, warnings):
        for warning in warnings:
            text = place(warning.toString())
            if self.problems is None:
                self.link.send('said', 'warning', text)
            else:
                self.problems.append(text)

    def _say(self, level, context, text):
        if context.file and context.line > 0:
            text = '%s:%d: %s' % (place(context.file), context.line, text)
        elif 'QQmlApplicationEngine failed to load' in text:
            return  # the reasons follow
        self.link.send('said', level, text)


def place(text):
    """A file by its path."""
    return text.replace('file://', '')


def declared(root):
    """The functions that an interface has itself at its root, not those of Qt's types."""
    names, meta = [], root.metaObject()
    while meta is not None and '_QML' in meta.className():
        names += [bytes(meta.method(number).name()).decode() for number in range(meta.methodOffset(), meta.methodCount())]
        meta = meta.superClass()
    return names
