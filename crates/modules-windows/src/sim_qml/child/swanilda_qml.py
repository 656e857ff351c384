"""An interface in QML, in a process of its own: an engine, the events between it and the simulator, its windows."""
import os
import sys

from swanilda_qml_link import Link

SETTINGS = {
    'QT_QPA_PLATFORM': 'offscreen',
    'QT_QUICK_BACKEND': 'software',
    'QSG_RENDER_LOOP': 'basic',
    'QML_DISABLE_DISK_CACHE': '1',  # nothing is left behind
    'QT_LOGGING_RULES': 'qt.qpa.*=false',
}

# What an interface knows as `simBridge`. `pipe` is a Python object.
BRIDGE = b"""
import QtQml
QtObject {
    id: bridge
    property var root: null
    property var handlers: []
    signal eventReceived(string name, var data)
    signal eventReceivedRaw(string name, string data)
    function sendEvent(name, data) { pipe.send(String(name), JSON.stringify(data === undefined ? null : data)) }
    function sendEventRaw(name, data) { pipe.send(String(name), String(data)) }
    property var incoming: Connections {
        target: pipe
        function onReceived(name, text) {
            bridge.eventReceivedRaw(name, text)
            const data = JSON.parse(text)
            bridge.eventReceived(name, data)
            if (bridge.handlers.includes(name)) bridge.root[name](data)
        }
    }
}
"""


def run(connection):
    """Serves the simulator until it closes the connection. Its first message has the modules that need Qt."""
    link = Link(connection)
    parts = link.first()
    if parts is None:
        return
    os.environ.update(SETTINGS)
    try:
        import PySide6.QtQuick
        from PySide6.QtCore import qVersion
    except ImportError as error:
        link.send('lacks', '%s: %s' % (sys.executable, error))
        link.finish()
        return
    link.send('hello', [int(part) for part in qVersion().split('.')[:3]])
    last = sys.modules['__main__'].load_modules(parts)
    last.Interface(link, BRIDGE).serve()
