//! Ways to the world outside, as bodies of Lua functions that return whether they got there, and why not.

/// One way.
pub struct Route {
    pub name: &'static str,
    pub code: &'static str,
    /// It gets there only with things a test does not have: where it is allowed, it fails for another reason.
    pub needs_more: bool,
    /// It needs the port itself.
    pub listens: bool,
    /// No rule for a place can stand for it.
    pub is_vague: bool,
}

const fn route(name: &'static str, code: &'static str) -> Route {
    Route {
        name,
        code,
        needs_more: false,
        listens: false,
        is_vague: false,
    }
}

const fn half(name: &'static str, code: &'static str) -> Route {
    Route {
        needs_more: true,
        ..route(name, code)
    }
}

const fn server(name: &'static str, code: &'static str) -> Route {
    Route {
        listens: true,
        ..route(name, code)
    }
}

const fn vague(name: &'static str, code: &'static str) -> Route {
    Route {
        is_vague: true,
        ..route(name, code)
    }
}

/// They read a file of `FOLDER`, or what is known of it.
pub const READS: &[Route] = &[
    route("io.open", "local f, why = io.open(FOLDER .. '/secret.lua') return f and f:read('a'):find 'secret', why"),
    route("io.open, a name with NUL", "local f, why = io.open(FOLDER .. '/secret.lua\\0/x') return f, why"),
    route("io.open, by the list of loaded modules", "return package.loaded.io.open(FOLDER .. '/secret.lua')"),
    route("io.open, by the registry", "return debug.getregistry()._LOADED.io.open(FOLDER .. '/secret.lua')"),
    route("io.open, in a coroutine", "return coroutine.wrap(io.open)(FOLDER .. '/secret.lua')"),
    route("io.open, in another script", "local sim = require 'sim'
        local script = sim.createScript(sim.scripttype_customization, 'function open(p) local f, why = io.open(p) return f ~= nil, why end')
        sim.initScript(script)
        return sim.callScriptFunction('open', script, FOLDER .. '/secret.lua')"),
    route("io.lines", "return io.lines(FOLDER .. '/secret.lua')():find 'secret'"),
    route("io.input", "io.input(FOLDER .. '/secret.lua') return io.read('a'):find 'secret'"),
    route("loadfile", "local f, why = loadfile(FOLDER .. '/secret.lua') return f and f() == 'the secret', why"),
    route("dofile", "return dofile(FOLDER .. '/secret.lua') == 'the secret'"),
    route("require", "package.path = FOLDER .. '/?.lua' return require 'secret' == 'the secret'"),
    route("package.searchers", "package.path = FOLDER .. '/?.lua'
        local load, path = package.searchers[3]('secret')
        return type(load) == 'function' and load('secret', path) == 'the secret', load"),
    route("package.searchpath", "return package.searchpath('secret', FOLDER .. '/?.lua')"),
    route("sim.includeAbs", "return require('sim').includeAbs(FOLDER .. '/secret.lua') == 'the secret'"),
    route("sim.executeScriptString, hidden", "local sim = require 'sim'
        local code = ('io.open(%q):read(\"a\"):find \"secret\" ~= nil'):format(FOLDER .. '/secret.lua')
        local run = getmetatable(sim).__index(sim, 'executeScriptString')
        local status, worked = run('select(2, pcall(function() return ' .. code .. ' end))', sim.getScript(sim.handle_self))
        local _, why = io.open(FOLDER .. '/secret.lua')
        return worked == true, why"),
    route("sim.callScriptFunction, _G.io.open", "local sim = require 'sim'
        local _, why = io.open(FOLDER .. '/secret.lua')
        local ok = pcall(sim.callScriptFunction, '_G.io.input', sim.getScript(sim.handle_self), FOLDER .. '/secret.lua')
        return ok and io.read('a'):find 'secret', why"),
    route("sim.callScriptFunction, _G.dofile", "local sim = require 'sim'
        local _, why = io.open(FOLDER .. '/secret.lua')
        local script = sim.getScript(sim.handle_self)
        local ok, text = pcall(sim.callScriptFunction, '_G.dofile', script, FOLDER .. '/secret.lua')
        return ok and text == 'the secret', why"),
    route("_evalExecRet", "local why = _G._evalExecRet(('assert(io.open(%q)):read(\"a\")'):format(FOLDER .. '/secret.lua'))
        return why:find 'the secret', why"),
    route("lfs.attributes, by a preload", "package.preload.lfs = nil return require('lfs').attributes(FOLDER .. '/secret.lua', 'size')"),
    route("lfs.symlinkattributes", "return require('lfs').symlinkattributes(FOLDER .. '/secret.lua', 'mode')"),
    route("lfs.dir", "return require('lfs').dir(FOLDER)"),
    route("lfsx.realpath", "return require('lfsx').realpath(FOLDER)"),
    route("sim.loadScene", "return require('sim').loadScene(FOLDER .. '/scene.ttt') == 1"),
    route("sim.loadScene, Lua", "return require('sim').loadScene(FOLDER .. '/secret.lua') == 1"),
    route("sim.loadScene, XML", "return require('sim').loadScene(FOLDER .. '/scene.xml') == 1"),
    half("simURDF.import", "return require('simURDF').import(FOLDER .. '/secret.lua') ~= nil"),
    half("simSDF.import", "require('simSDF').import(FOLDER .. '/secret.lua') return true"),
    half("simSDF.dump", "require('simSDF').dump(FOLDER .. '/secret.lua') return true"),
    half("sim.loadScene, a folder", "return require('sim').loadScene(FOLDER) == 1"),
    route("sim.loadModel", "return require('sim').loadModel(FOLDER .. '/model.ttm') >= 0"),
    route("sim.loadImage", "return #require('sim').loadImage(0, FOLDER .. '/picture.png') == 12"),
    route("simIM.read", "local simIM = require 'simIM' return simIM.size(simIM.read(FOLDER .. '/picture.png'))[1] == 2"),
    route("sim.importMesh", "return #require('sim').importMesh(0, FOLDER .. '/mesh.obj', 0, 0, 1) == 1"),
    route("sim.importShape", "return require('sim').importShape(0, FOLDER .. '/mesh.obj', 0, 0, 1) >= 0"),
    route("simAssimp.importShapes", "return #require('simAssimp').importShapes(FOLDER .. '/mesh.obj') == 1"),
    route("simAssimp.importMeshes", "return #require('simAssimp').importMeshes(FOLDER .. '/mesh.obj') == 1"),
    route("sim.createTexture", "return require('sim').createTexture(FOLDER .. '/picture.png', 0) >= 0"),
];

/// They change something in `FOLDER`.
pub const WRITES: &[Route] = &[
    route("io.open, w", "local f, why = io.open(FOLDER .. '/new', 'w') return f and f:write 'x' and f:close(), why"),
    route("io.open, a", "local f, why = io.open(FOLDER .. '/victim', 'a') return f and f:write 'x' and f:close(), why"),
    route(
        "io.open, r+",
        "local f, why = io.open(FOLDER .. '/victim', 'r+') return f and f:write 'x' and f:close(), why",
    ),
    route("io.open, NUL in the mode", "local f, why = io.open(FOLDER .. '/new', 'w\\0r') return f, why"),
    route("io.output", "io.output(FOLDER .. '/new') return io.write('x') and io.close()"),
    route("os.remove", "return os.remove(FOLDER .. '/victim')"),
    route("os.rename", "return os.rename(FOLDER .. '/victim', FOLDER .. '/new')"),
    route(
        "os.rename, in another script",
        "local sim = require 'sim'
        local old, new = FOLDER .. '/victim', FOLDER .. '/new'
        local result, why = sim.callScriptFunction('_G.os.rename', sim.getScript(sim.handle_self), old, new)
        return result, why",
    ),
    route("lfs.mkdir", "return require('lfs').mkdir(FOLDER .. '/new')"),
    route("lfs.rmdir", "return require('lfs').rmdir(FOLDER .. '/empty')"),
    route("lfs.touch", "return require('lfs').touch(FOLDER .. '/victim', 1, 1)"),
    route("lfs.link", "return require('lfs').link(FOLDER .. '/victim', FOLDER .. '/new')"),
    route("sim.saveScene", "return require('sim').saveScene(FOLDER .. '/new.ttt') == 1"),
    route("sim.saveScene, XML", "return require('sim').saveScene(FOLDER .. '/new.simscene.xml') == 1"),
    route("sim.saveScene, simple XML", "return require('sim').saveScene(FOLDER .. '/new.simscene.xml@simpleXml') == 1"),
    route(
        "sim.saveModel",
        "local sim = require 'sim'
        local dummy = sim.createDummy(0.1)
        sim.setModelProperty(dummy, 0)
        return sim.saveModel(dummy, FOLDER .. '/new.ttm') == 1",
    ),
    route(
        "simIM.write",
        "local simIM = require 'simIM' simIM.write(simIM.create(2, 2), FOLDER .. '/new.png') return true",
    ),
    route(
        "sim.exportMesh",
        "require('sim').exportMesh(0, FOLDER .. '/new.obj', 0, 1, {{0,0,0, 1,0,0, 0,1,0}}, {{0,1,2}}) return true",
    ),
    route(
        "simAssimp.exportMeshes",
        "require('simAssimp').exportMeshes({{0,0,0, 1,0,0, 0,1,0}}, {{0,1,2}}, FOLDER .. '/new.obj', 'obj') return true",
    ),
    route(
        "simURDF.export",
        "require('simURDF').export(require('sim').createDummy(0.1), FOLDER .. '/new.urdf') return true",
    ),
    route("sim.saveImage", "require('sim').saveImage(('a'):rep(12), {2, 2}, 0, FOLDER .. '/new.png') return true"),
    route(
        "simZMQ, ipc, bind",
        "local simZMQ = require 'simZMQ'
        local socket = simZMQ.socket(simZMQ.ctx_new(), simZMQ.REP)
        return simZMQ.bind(socket, 'ipc://' .. FOLDER .. '/new') == 0",
    ),
    route(
        "simZMQ, ipc, connect",
        "local simZMQ = require 'simZMQ'
        local socket = simZMQ.socket(simZMQ.ctx_new(), simZMQ.REQ)
        return simZMQ.connect(socket, 'ipc://' .. FOLDER .. '/new') == 0",
    ),
    route("socket.unix", "return require('socket.unix').stream():bind(FOLDER .. '/new')"),
    half("sim.serialOpen", "return require('sim').serialOpen(FOLDER .. '/victim', 9600) >= 0"),
];

/// They start programs.
pub const RUNS: &[Route] = &[
    route("os.execute", "return os.execute('exit 0')"),
    route("io.popen", "return io.popen('echo out'):read() == 'out'"),
    route(
        "os.execute, in another script",
        "local sim = require 'sim'
        local _, why = pcall(os.execute, 'exit 0')
        local ok, worked = pcall(sim.callScriptFunction, '_G.os.execute', sim.getScript(sim.handle_self), 'exit 0')
        return ok and worked, why",
    ),
    route("simSubprocess.exec", "return require('simSubprocess').exec('cargo', {'--version'}) == 0"),
    route("simSubprocess.execAsync", "return require('simSubprocess').execAsync('cargo', {'--version'})"),
    route("sim.launchExecutable", "require('sim').launchExecutable('cargo', '--version') return true"),
];

/// They load what is no text of Lua.
pub const NATIVE: &[Route] = &[
    route(
        "load",
        "return load(string.dump(function() end), 'name', 'b')",
    ),
    half(
        "package.loadlib",
        "return package.loadlib('no such library', '*')",
    ),
    route(
        "loadfile",
        "local file = io.open(FOLDER .. '/code', 'wb')
        if file then file:write(string.dump(function() end)) file:close() end
        local _, why = load('', 'name', 'b')
        local code, reason = loadfile(FOLDER .. '/code', 'b')
        return code, why and why:find 'allowed' and why or reason",
    ),
];

/// They reach `PORT` of 127.0.0.1.
pub const ADDRESSES: &[Route] = &[
    route("tcp, connect", "return require('socket').tcp():connect('127.0.0.1', PORT)"),
    route("socket.connect", "return require('socket').connect('127.0.0.1', PORT)"),
    server("tcp, bind", "return require('socket').tcp():bind('127.0.0.1', PORT)"),
    server("socket.bind", "return require('socket').bind('127.0.0.1', PORT)"),
    vague("tcp, listen without an address", "return require('socket').tcp4():listen()"),
    route("udp, sendto", "return require('socket').udp():sendto('x', '127.0.0.1', PORT)"),
    route("udp, setpeername", "return require('socket').udp():setpeername('127.0.0.1', PORT)"),
    route("udp, setsockname", "return require('socket').udp():setsockname('127.0.0.1', PORT)"),
    vague("dns", "return require('socket').dns.toip('127.0.0.3')"),
    half(
        "http",
        "local http = require 'socket.http'
        http.TIMEOUT = 0.05
        return http.request('http://127.0.0.1:PORT/')",
    ),
    Route {
        needs_more: true,
        ..vague("a local socket without a file", "return require('socket.unix').stream():bind('\\0swanilda PORT')")
    },
    vague(
        "simZMQ, a local socket without a file",
        "local simZMQ = require 'simZMQ'
        return simZMQ.bind(simZMQ.socket(simZMQ.ctx_new(), simZMQ.REP), 'ipc://@swanilda PORT') == 0",
    ),
    route("simWS.connect", "return require('simWS').connect('ws://127.0.0.1:PORT/')"),
    server("simWS.start", "return require('simWS').start(PORT)"),
    route(
        "simZMQ, connect",
        "local simZMQ = require 'simZMQ'
        return simZMQ.connect(simZMQ.socket(simZMQ.ctx_new(), simZMQ.REQ), 'tcp://127.0.0.1:PORT') == 0",
    ),
    server(
        "simZMQ, bind",
        "local simZMQ = require 'simZMQ'
        return simZMQ.bind(simZMQ.socket(simZMQ.ctx_new(), simZMQ.REP), 'tcp://127.0.0.1:PORT') == 0",
    ),
    vague(
        "simZMQ, from another address",
        "local simZMQ = require 'simZMQ'
        local socket = simZMQ.socket(simZMQ.ctx_new(), simZMQ.REQ)
        return simZMQ.connect(socket, 'tcp://127.0.0.1:0;127.0.0.1:PORT') == 0",
    ),
    route(
        "simZMQ, proxy",
        "local simZMQ = require 'simZMQ'
        local socket = simZMQ.socket(simZMQ.ctx_new(), simZMQ.REQ)
        return simZMQ.setsockopt(socket, simZMQ.SOCKS_PROXY, '127.0.0.1:PORT') == 0",
    ),
];

/// It reads the certificates of a file, for a connection it makes before.
pub const CERTIFICATES: &str = "local socket, ssl = require 'socket', require 'ssl'
    local server = assert(socket.bind('127.0.0.1', 0))
    local host, port = server:getsockname()
    local client = assert(socket.connect(host, port))
    local settings = {mode = 'client', protocol = 'any', verify = 'peer', cafile = FOLDER .. '/secret.lua'}
    return assert(ssl.wrap(client, settings)):dohandshake()";
