--[[
Starts programs, where that is allowed (`--allow-run`).

    exec(programPath, args, input = '', opts = {})      runs a program and waits for it; ctrl-c ends it with an error.
                                                        Returns exit code, output and error output, at most 256 MiB of each
    execAsync(programPath, args, opts = {})             starts a program, which inherits the simulator's output. Returns a handle
    isRunning(handle)                                   whether it still runs
    wait(handle, timeout = 5.0)                         waits that many seconds; returns its exit code, or nil if it still runs
    kill(handle)                                        kills it; the handle becomes invalid
    getpid(handle)                                      the process id

args is a list of strings. opts: useSearchPath (true) looks a name up in PATH, workingDir is a folder, openNewConsole is for Windows.

A handle belongs to the script that created it. When the script ends, its programs are killed.
A program that ends by a signal is an error: the process crashed. So is one that cannot be started: waitForStarted timed out.
]]

local _, native = ...

return native
