"""What clients do not get with --no-unsafe."""

from compare import same
from raw import Peer

MISSING = [
    "load", "loadfile", "dofile", "loadstring", "io.open", "io.popen", "io.lines", "os.execute", "os.remove", "os.rename",
    "package.loadlib", "debug.getregistry", "debug.getupvalue", "sim.executeScriptString", "sim.launchExecutable",
    "simExecuteScriptString",
]

REACHING = ["_evalExec", "_evalExecRet", "os.execute", "os.remove", "io.open", "load", "dofile", "package.loadlib", "require"]

SCRIPT = "sim = require 'sim' function fine() return 'fine' end"


def main():
    peer = Peer("a")
    for name in MISSING:
        same(name, peer.call(name), {"err": f"No such function: {name}"})
    same("the switch", peer.ask(eval="return sim.getBoolParam(sim.boolparam_execunsafeext)"), {"ret": [False]})
    same("not in the list either", "launchExecutable" in peer.ask(func="zmqRemoteApi.info", args=["sim"])["ret"][0], False)
    script = peer.call("sim.createScript", 1, SCRIPT, 0, "lua")["ret"][0]
    peer.call("sim.initScript", script)
    same("a function of a script", peer.call("sim.callScriptFunction", "fine", script), {"ret": ["fine"]})
    for function in ("sim.callScriptFunction", "simCallScriptFunction"):
        for name in REACHING:
            same(f"{name} of a script", list(peer.call(function, name, script, "1")), ["err"])
            same(f"{name} of a script, second", list(peer.call(function, script, name, "1")), ["err"])
            same(f"{name} of a script, as bytes", list(peer.call(function, name.encode(), script, "1")), ["err"])
    for module in ("lfs", "lfsx", "simSubprocess"):
        same(module, peer.call("zmqRemoteApi.require", module), {"err": "not for remote clients (--no-unsafe)."})
    same("chunks are run", peer.ask(eval="return 1 + 1"), {"ret": [2]})
    same("but no compiled ones", list(peer.ask(eval=b"\x1bLua")), ["err"])
    same("files by name", list(peer.ask(eval="return require('io').open('/etc/passwd')")), ["err"])
    same("files by another module", list(peer.ask(eval="return package.loaded.io.open('/etc/passwd')")), ["err"])


main()
