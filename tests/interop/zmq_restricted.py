"""What clients do not get with --no-unsafe, whichever way they take."""

from compare import same
from raw import Peer

SELF = "sim.getScript(sim.handle_self)"

# Each returns nothing but a reason, or fails.
ROUTES = [
    "select(2, io.open('/etc/passwd'))",
    "select(2, package.loaded.io.open('/etc/passwd'))",
    "select(2, require('io').open('/etc/passwd'))",
    "io.lines('/etc/passwd')()",
    "_G.dofile('/etc/passwd')",
    "select(2, loadfile('/etc/passwd'))",
    "_G._evalExecRet('assert(io.open([[/etc/passwd]]))')",
    "select(2, getmetatable(sim).__index(sim, 'executeScriptString')('select(2, io.open([[/etc/passwd]]))', " + SELF + "))",
    "select(2, _G.os.rename('/etc/passwd', '/tmp/passwd'))",
    "(function() package.preload.lfs = nil return select(2, require('lfs').attributes('/etc/passwd')) end)()",
    "(function() package.path = '/etc/?' require('passwd') end)()",
    "(function() package.path = '/etc/?' return package.searchers[3]('passwd') end)()",
    "select(2, package.searchpath('passwd', '/etc/?'))",
    "sim.saveScene('/tmp/swanilda-written.ttt')",
    "sim.saveImage(('a'):rep(12), {2, 2}, 0, '/tmp/swanilda-written.png')",
    "sim.loadScene('/etc/passwd')",
    "sim.loadImage(0, '/etc/passwd')",
    "require('simZMQ').bind(require('simZMQ').socket(require('simZMQ').ctx_new(), 3), 'ipc:///tmp/swanilda-written')",
    "require('socket').connect('127.0.0.1', 1)",
    "sim.serialOpen('/dev/null', 9600)",
    "os.execute('true')",
    "io.popen('true')",
    "sim.launchExecutable('true')",
    "require('simSubprocess').exec('true', {})",
    "package.loadlib('x', 'y')",
    "select(2, load(string.dump(function() end), 'x', 'b'))",
]

CALLED = ["_G.io.open", "_G.io.lines", "_G.dofile", "_G.os.execute", "io.popen", "_G.package.loadlib"]

SCRIPT = "sim = require 'sim' function fine() return 'fine' end function read(path) return select(2, io.open(path)) end"


def refusal(answer):
    """Why not, be it a result or an error."""
    text = answer.get("err") or str(answer["ret"])
    return "--allow-" in text or "that may be read" in text


def main():
    peer = Peer("a")
    for code in ROUTES:
        answer = peer.ask(eval="return " + code)
        same(f"{code}: {answer}", refusal(answer), True)
    script = peer.call("sim.createScript", 1, SCRIPT, 0, "lua")["ret"][0]
    peer.call("sim.initScript", script)
    same("a function of a script", peer.call("sim.callScriptFunction", "fine", script), {"ret": ["fine"]})
    same("files by a script", refusal(peer.call("sim.callScriptFunction", "read", script, "/etc/passwd")), True)
    for name in CALLED:
        answer = peer.call("sim.callScriptFunction", name, script, "/etc/passwd")
        same(f"{name} of a script: {answer}", "err" in answer or refusal(answer), True)
    same("the switch", peer.ask(eval="return sim.getBoolParam(sim.boolparam_execunsafeext)"), {"ret": [False]})
    same("chunks are run", peer.ask(eval="return load('return 1 + 1')()"), {"ret": [2]})
    same("but no compiled ones", list(peer.ask(eval=b"\x1bLua")), ["err"])
    same("what is missing is still missing", peer.call("no.such"), {"err": "No such function: no.such"})


main()
